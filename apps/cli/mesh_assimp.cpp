// See mesh_assimp.h.
#include "mesh_assimp.h"

#include <assimp/Importer.hpp>
#include <assimp/config.h>

namespace elastoon {

namespace {

/// Deeper nodes are a mistake of the file, or a ring.
constexpr int kMostDepth = 1000;

/// assimp puts pieces of the file into its messages: one line of them, to be read on a terminal.
std::string tidied(const std::string& message) {
    constexpr std::size_t kMost = 160;
    std::string tidy;
    for (const char c : message.substr(0, kMost)) {
        tidy += c >= ' ' && c <= '~' ? c : '?';
    }
    return message.size() > kMost ? tidy + "..." : tidy;
}

struct Soup {
    std::vector<Vec3> points;
    std::vector<TriangleMesh::Triangle> triangles;
};

/// False where a face names a point that is none.
bool addMesh(const aiMesh& mesh, const aiMatrix4x4& world, Soup& soup) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D point = world * mesh.mVertices[i];
        soup.points.emplace_back(point.x, point.y, point.z);
    }
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
        const aiFace& face = mesh.mFaces[i];
        for (unsigned j = 0; j < face.mNumIndices; ++j) {
            if (face.mIndices[j] >= mesh.mNumVertices) {
                return false;
            }
        }
        // A fan holds the right volume whatever the polygon's outline. Points and lines have none.
        for (unsigned j = 2; j < face.mNumIndices; ++j) {
            soup.triangles.push_back(
                {first + face.mIndices[0], first + face.mIndices[j - 1], first + face.mIndices[j]});
        }
    }
    return true;
}

bool addNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, int depth, Soup& soup) {
    const aiMatrix4x4 world = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene.mNumMeshes || !addMesh(*scene.mMeshes[node.mMeshes[i]], world, soup)) {
            return false;
        }
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        if (depth >= kMostDepth || !addNode(scene, *node.mChildren[i], world, depth + 1, soup)) {
            return false;
        }
    }
    return true;
}

} // namespace

Result<TriangleMesh> meshOf(const aiScene& scene) {
    Soup soup;
    if (scene.mRootNode != nullptr && !addNode(scene, *scene.mRootNode, aiMatrix4x4(), 0, soup)) {
        return Error{"the mesh file is damaged: it refers to points or parts that are not there", ""};
    }
    return welded(soup.points, soup.triangles);
}

Result<TriangleMesh> readWithAssimp(const std::string& path) {
    Assimp::Importer importer;
    // Else a file without faces gets a drawing of its bones.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    // No processing steps: they are more code to fail, and welding and fans are enough here.
    const aiScene* scene = importer.ReadFile(path, 0);
    if (scene == nullptr) {
        return Error{"is not a mesh file that can be read: " + tidied(importer.GetErrorString()), ""};
    }
    return meshOf(*scene);
}

} // namespace elastoon
