// libFuzzer target: bytes as what assimp made of a file, sound or not, or as the answer of the process it ran in; the
// result is a mesh whose numbers hold, or an error. scripts/fuzz.sh runs it.
//
// assimp itself is not fuzzed here: within seconds this would find again that its version 5.2 goes round for ever on
// .ply files cut short. Our program runs it in a process of its own; tests/mesh_file_test.cpp has damaged files.
#include "bytes.h"
#include "elastoon/shape.h"
#include "mesh_assimp.h"

#include <assimp/scene.h>

#include <cmath>
#include <string>

namespace elastoon {
namespace {

aiMesh* meshFrom(Bytes& bytes) {
    auto* mesh = new aiMesh;
    mesh->mNumVertices = bytes.next() % 16;
    mesh->mVertices = new aiVector3D[mesh->mNumVertices];
    for (unsigned i = 0; i < mesh->mNumVertices; ++i) {
        for (unsigned axis = 0; axis < 3; ++axis) {
            // Beyond its range a float is infinite, as assimp's own are; C++ leaves the conversion open.
            const double x = coordinate(bytes);
            mesh->mVertices[i][axis] = std::fabs(x) < 1e38 || std::isnan(x) ? static_cast<float>(x) : HUGE_VALF;
        }
    }
    mesh->mNumFaces = bytes.next() % 32;
    mesh->mFaces = new aiFace[mesh->mNumFaces];
    for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
        aiFace& face = mesh->mFaces[i];
        face.mNumIndices = bytes.next() % 6;
        face.mIndices = new unsigned[face.mNumIndices];
        for (unsigned j = 0; j < face.mNumIndices; ++j) {
            const std::uint8_t index = bytes.next();
            face.mIndices[j] = index == 255                            ? 0xffffffffU
                               : index < 240 && mesh->mNumVertices > 0 ? index % mesh->mNumVertices
                                                                       : index;
        }
    }
    return mesh;
}

aiNode* nodeFrom(Bytes& bytes, unsigned meshes, int depth) {
    auto* node = new aiNode;
    if (bytes.next() % 2 == 1) {
        for (unsigned i = 0; i < 16; ++i) {
            node->mTransformation[i / 4][i % 4] = static_cast<float>(static_cast<std::int8_t>(bytes.next())) / 4.0F;
        }
    }
    node->mNumMeshes = bytes.next() % 3;
    node->mMeshes = new unsigned[node->mNumMeshes];
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
        node->mMeshes[i] = bytes.next() % (meshes + 1); // now and then one that is not there
    }
    const unsigned children = depth < 4 ? bytes.next() % 3 : 0;
    node->mChildren = new aiNode*[children];
    for (; node->mNumChildren < children; ++node->mNumChildren) {
        node->mChildren[node->mNumChildren] = nodeFrom(bytes, meshes, depth + 1);
    }
    return node;
}

void checkMesh(const TriangleMesh& mesh) {
    demand(!mesh.triangles.empty(), "a mesh without triangles");
    for (const TriangleMesh::Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
            demand(corner < mesh.points.size(), "a corner that is none");
        }
    }
    for (const Vec3& point : mesh.points) {
        demand(std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z),
               "a point that is not finite");
    }
    const auto back = unpacked(packed(mesh));
    demand(back.ok() && back.value().triangles == mesh.triangles, "what was packed did not come back");
    const auto hull = Shape::hull(mesh.points);
    if (!hull) {
        demand(!hull.error().message.empty(), "an error without a message");
        return;
    }
    const std::string note = hullNote("shape", "file", mesh, hull.value()->volume());
    demand(note.find("nan") == std::string::npos && note.find('\n') == std::string::npos, "a note that says nothing");
}

void checkResult(const Result<TriangleMesh>& mesh) {
    if (mesh) {
        checkMesh(mesh.value());
    } else {
        demand(!mesh.error().message.empty(), "an error without a message");
    }
}

void runOn(Bytes& bytes) {
    if (bytes.next() % 4 == 0) {
        std::string answer;
        while (bytes.any()) {
            answer.push_back(static_cast<char>(bytes.next()));
        }
        checkResult(unpacked(answer));
        return;
    }
    aiScene scene;
    const unsigned meshes = 1 + bytes.next() % 2;
    scene.mMeshes = new aiMesh*[meshes];
    for (; scene.mNumMeshes < meshes; ++scene.mNumMeshes) {
        scene.mMeshes[scene.mNumMeshes] = meshFrom(bytes);
    }
    scene.mRootNode = nodeFrom(bytes, meshes, 0);
    checkResult(meshOf(scene));
}

} // namespace
} // namespace elastoon

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    elastoon::Bytes bytes(data, size);
    elastoon::runOn(bytes);
    return 0;
}
