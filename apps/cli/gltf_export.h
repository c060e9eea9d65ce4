// A scene's motion as a binary glTF 2.0 file (.glb) with animation, for Blender, engines and browsers.
#pragma once

#include "elastoon/scene.h"
#include "elastoon/timeline.h"

#include <string>

namespace elastoon {

/// One node for each body and obstacle, by the scene's names. A body's translation, rotation and scale are animated
/// with keys at k / fps, at the end, and where its motion changes; between keys a player goes straight. At the keys the
/// node's matrix is the pose, exactly: the stretch lies along the shape's own axes, so one node carries it.
Status writeGlb(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                const std::string& path);

} // namespace elastoon
