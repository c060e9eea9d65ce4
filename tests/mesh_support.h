// One solid as bytes of every kind of mesh file, written by hand.
#pragma once

#include "mesh_file.h"

#include <cstring>
#include <sstream>
#include <string>
#include <vector>

namespace elastoon {

struct PolygonMesh {
    std::vector<Vec3> points;
    std::vector<std::vector<std::uint32_t>> faces;

    [[nodiscard]] std::vector<TriangleMesh::Triangle> triangles() const {
        std::vector<TriangleMesh::Triangle> fans;
        for (const auto& face : faces) {
            for (std::size_t i = 2; i < face.size(); ++i) {
                fans.push_back({face[0], face[i - 1], face[i]});
            }
        }
        return fans;
    }
};

/// An L, two long and two high with limbs one wide, one deep: 3 m^3. Its hull fills the corner: 3.5 m^3.
inline PolygonMesh ellPrism() {
    const std::vector<Vec3> outline{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    PolygonMesh mesh;
    mesh.points = outline;
    for (const Vec3& point : outline) {
        mesh.points.push_back(point + Vec3(0, 0, 1));
    }
    mesh.faces = {{0, 5, 4, 3, 2, 1}, {6, 7, 8, 9, 10, 11}};
    for (std::uint32_t i = 0; i < 6; ++i) {
        const std::uint32_t next = (i + 1) % 6;
        mesh.faces.push_back({i, next, next + 6, i + 6});
    }
    return mesh;
}

template <class T>
void appendRaw(std::string& bytes, const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline void appendFloats(std::string& bytes, const Vec3& point) {
    for (int i = 0; i < 3; ++i) {
        appendRaw(bytes, static_cast<float>(point[i]));
    }
}

inline std::string asObj(const PolygonMesh& mesh) {
    std::ostringstream text;
    for (const Vec3& p : mesh.points) {
        text << "v " << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (const auto& face : mesh.faces) {
        text << "f";
        for (const std::uint32_t corner : face) {
            text << " " << corner + 1;
        }
        text << "\n";
    }
    return text.str();
}

inline std::string asStlText(const PolygonMesh& mesh) {
    std::ostringstream text;
    text << "solid ell\n";
    for (const auto& triangle : mesh.triangles()) {
        text << " facet normal 0 0 0\n  outer loop\n";
        for (const std::uint32_t corner : triangle) {
            const Vec3& p = mesh.points[corner];
            text << "   vertex " << p.x << " " << p.y << " " << p.z << "\n";
        }
        text << "  endloop\n endfacet\n";
    }
    text << "endsolid ell\n";
    return text.str();
}

inline std::string asStlBinary(const PolygonMesh& mesh) {
    std::string bytes(80, ' ');
    const auto triangles = mesh.triangles();
    appendRaw(bytes, static_cast<std::uint32_t>(triangles.size()));
    for (const auto& triangle : triangles) {
        appendFloats(bytes, Vec3(0.0));
        for (const std::uint32_t corner : triangle) {
            appendFloats(bytes, mesh.points[corner]);
        }
        appendRaw(bytes, std::uint16_t{0});
    }
    return bytes;
}

inline std::string plyHeader(const PolygonMesh& mesh, const std::string& format) {
    std::ostringstream text;
    text << "ply\nformat " << format << " 1.0\nelement vertex " << mesh.points.size()
         << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.faces.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    return text.str();
}

inline std::string asPlyText(const PolygonMesh& mesh) {
    std::ostringstream text;
    text << plyHeader(mesh, "ascii");
    for (const Vec3& p : mesh.points) {
        text << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (const auto& face : mesh.faces) {
        text << face.size();
        for (const std::uint32_t corner : face) {
            text << " " << corner;
        }
        text << "\n";
    }
    return text.str();
}

inline std::string asPlyBinary(const PolygonMesh& mesh) {
    std::string bytes = plyHeader(mesh, "binary_little_endian");
    for (const Vec3& p : mesh.points) {
        appendFloats(bytes, p);
    }
    for (const auto& face : mesh.faces) {
        appendRaw(bytes, static_cast<std::uint8_t>(face.size()));
        for (const std::uint32_t corner : face) {
            appendRaw(bytes, corner);
        }
    }
    return bytes;
}

inline std::string chunkOf(const char* kind, std::string bytes, char filler) {
    bytes.append((4 - bytes.size() % 4) % 4, filler);
    std::string chunk;
    appendRaw(chunk, static_cast<std::uint32_t>(bytes.size()));
    return chunk.append(kind, 4).append(bytes);
}

/// In a node that is `scale` times as large.
inline std::string asGlb(const PolygonMesh& mesh, double scale = 1.0) {
    std::string buffer;
    for (const Vec3& p : mesh.points) {
        appendFloats(buffer, p);
    }
    const std::size_t positions = buffer.size();
    const auto triangles = mesh.triangles();
    for (const auto& triangle : triangles) {
        for (const std::uint32_t corner : triangle) {
            appendRaw(buffer, static_cast<std::uint16_t>(corner));
        }
    }
    std::ostringstream json;
    json << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[)" << scale
         << "," << scale << "," << scale
         << R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         << R"({"bufferView":0,"componentType":5126,"count":)" << mesh.points.size()
         << R"(,"type":"VEC3","min":[0,0,0],"max":[2,2,1]},{"bufferView":1,"componentType":5123,"count":)"
         << 3 * triangles.size() << R"(,"type":"SCALAR"}],"bufferViews":[{"buffer":0,"byteLength":)" << positions
         << R"(},{"buffer":0,"byteOffset":)" << positions << R"(,"byteLength":)" << buffer.size() - positions
         << R"(}],"buffers":[{"byteLength":)" << buffer.size() << "}]}";
    const std::string chunks =
        chunkOf("JSON", json.str(), ' ') + chunkOf(std::string("BIN\0", 4).c_str(), buffer, '\0');
    std::string file = "glTF";
    appendRaw(file, std::uint32_t{2});
    appendRaw(file, static_cast<std::uint32_t>(12 + chunks.size()));
    return file + chunks;
}

} // namespace elastoon
