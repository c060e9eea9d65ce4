// See mesh_file.h.
#include "mesh_file.h"

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <filesystem>

namespace elastoon {

namespace {

void collect(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, std::vector<Vec3>& points) {
    const aiMatrix4x4 world = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        for (unsigned j = 0; j < mesh.mNumVertices; ++j) {
            const aiVector3D point = world * mesh.mVertices[j];
            points.emplace_back(point.x, point.y, point.z);
        }
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        collect(scene, *node.mChildren[i], world, points);
    }
}

} // namespace

Result<std::vector<Vec3>> readMeshPoints(const std::string& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return Error{"the mesh file cannot be read; is the path right? (It is taken from the scene's folder.)", path};
    }
    Assimp::Importer importer;
    const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
    if (scene == nullptr || scene->mRootNode == nullptr) {
        return Error{std::string("is not a mesh file that can be read: ") + importer.GetErrorString(), path};
    }
    std::vector<Vec3> points;
    collect(*scene, *scene->mRootNode, aiMatrix4x4(), points);
    if (points.empty()) {
        return Error{"the mesh file holds no points", path};
    }
    return points;
}

} // namespace elastoon
