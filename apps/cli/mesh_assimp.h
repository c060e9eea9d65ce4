// What the mesh reader asks of assimp.
#pragma once

#include "mesh_file.h"

#include <assimp/scene.h>

namespace elastoon {

/// The surface in a scene of assimp's, which need not be sound.
[[nodiscard]] Result<TriangleMesh> meshOf(const aiScene& scene);

/// As readMesh, in this process.
[[nodiscard]] Result<TriangleMesh> readWithAssimp(const std::string& path);

} // namespace elastoon
