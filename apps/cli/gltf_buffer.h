// The binary part of a .glb file: three stretches of bytes (vertices, indices, motion) and the accessors into them.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <vector>

namespace elastoon {

class GltfBuffer {
public:
    explicit GltfBuffer(tinygltf::Model& model) : model_(model) {}

    /// Each adds data and an accessor, and returns the accessor's index. `bounds`: give the accessor min and max.
    int addVertices(const std::vector<std::array<float, 3>>& values, bool bounds);
    int addIndices(const std::vector<std::array<std::uint32_t, 3>>& triangles);
    int addMotion(const std::vector<float>& values, bool bounds);
    int addMotion(const std::vector<std::array<float, 3>>& values);
    int addMotion(const std::vector<std::array<float, 4>>& values);

    /// Puts the bytes into the model. Call it once, after the last add.
    void finish();

private:
    enum Section : std::uint8_t { Vertices, Indices, Motion };

    int addAccessor(Section section, int component, int type, std::size_t count, const void* data, std::size_t size);
    void setBounds(int accessor, const float* values, std::size_t components, std::size_t count);

    tinygltf::Model& model_;
    std::array<std::vector<unsigned char>, 3> bytes_;
};

} // namespace elastoon
