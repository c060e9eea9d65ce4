// Points of a mesh file (.obj, .stl, .ply, .glb and whatever else assimp reads), for its convex hull.
#pragma once

#include "elastoon/math.h"
#include "elastoon/result.h"

#include <string>
#include <vector>

namespace elastoon {

/// All vertices, with the transforms of the file's nodes applied. An unreadable file or one without points is an error.
Result<std::vector<Vec3>> readMeshPoints(const std::string& path);

} // namespace elastoon
