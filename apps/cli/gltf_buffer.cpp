// See gltf_buffer.h.
#include "gltf_buffer.h"

#include <algorithm>

namespace elastoon {

namespace {

constexpr std::size_t kAlignment = 4;

void align(std::vector<unsigned char>& bytes) {
    bytes.resize((bytes.size() + kAlignment - 1) / kAlignment * kAlignment, 0);
}

std::vector<std::uint32_t> flat(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<std::uint32_t> indices;
    for (const auto& triangle : triangles) {
        indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    return indices;
}

} // namespace

int GltfBuffer::addAccessor(Section section, int component, int type, std::size_t count, const void* data,
                            std::size_t size) {
    std::vector<unsigned char>& bytes = bytes_[section];
    align(bytes);
    tinygltf::Accessor accessor;
    accessor.bufferView = section; // finish() makes it the view's index
    accessor.byteOffset = bytes.size();
    accessor.componentType = component;
    accessor.count = count;
    accessor.type = type;
    const auto* begin = static_cast<const unsigned char*>(data);
    bytes.insert(bytes.end(), begin, begin + size);
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
}

void GltfBuffer::setBounds(int accessor, const float* values, std::size_t components, std::size_t count) {
    std::vector<double> low(values, values + components);
    std::vector<double> high = low;
    for (std::size_t i = 0; i < components * count; ++i) {
        const double value = static_cast<double>(values[i]);
        low[i % components] = std::min(low[i % components], value);
        high[i % components] = std::max(high[i % components], value);
    }
    model_.accessors[static_cast<std::size_t>(accessor)].minValues = low;
    model_.accessors[static_cast<std::size_t>(accessor)].maxValues = high;
}

int GltfBuffer::addVertices(const std::vector<std::array<float, 3>>& values, bool bounds) {
    const int accessor = addAccessor(Vertices, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size(),
                                     values.data(), values.size() * sizeof(values[0]));
    if (bounds) {
        setBounds(accessor, values.front().data(), 3, values.size());
    }
    return accessor;
}

int GltfBuffer::addIndices(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::vector<std::uint32_t> indices = flat(triangles);
    constexpr std::uint32_t kMostShort = 65534; // 65535 is kept for primitive restart
    if (*std::max_element(indices.begin(), indices.end()) > kMostShort) {
        return addAccessor(Indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR, indices.size(),
                           indices.data(), indices.size() * sizeof(indices[0]));
    }
    std::vector<std::uint16_t> shorter(indices.size());
    std::transform(indices.begin(), indices.end(), shorter.begin(),
                   [](std::uint32_t index) { return static_cast<std::uint16_t>(index); });
    return addAccessor(Indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_SCALAR, shorter.size(),
                       shorter.data(), shorter.size() * sizeof(shorter[0]));
}

int GltfBuffer::addMotion(const std::vector<float>& values, bool bounds) {
    const int accessor = addAccessor(Motion, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, values.size(),
                                     values.data(), values.size() * sizeof(values[0]));
    if (bounds) {
        setBounds(accessor, values.data(), 1, values.size());
    }
    return accessor;
}

int GltfBuffer::addMotion(const std::vector<std::array<float, 3>>& values) {
    return addAccessor(Motion, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, values.size(), values.data(),
                       values.size() * sizeof(values[0]));
}

int GltfBuffer::addMotion(const std::vector<std::array<float, 4>>& values) {
    return addAccessor(Motion, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, values.size(), values.data(),
                       values.size() * sizeof(values[0]));
}

void GltfBuffer::finish() {
    tinygltf::Buffer buffer;
    std::array<int, 3> view_of_section{-1, -1, -1};
    for (const Section section : {Vertices, Indices, Motion}) {
        if (bytes_[section].empty()) {
            continue;
        }
        align(buffer.data);
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = buffer.data.size();
        view.byteLength = bytes_[section].size();
        view.byteStride = section == Vertices ? sizeof(std::array<float, 3>) : 0; // needed where accessors share a view
        view.target = section == Vertices  ? TINYGLTF_TARGET_ARRAY_BUFFER
                      : section == Indices ? TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER
                                           : 0;
        view_of_section[section] = static_cast<int>(model_.bufferViews.size());
        model_.bufferViews.push_back(view);
        buffer.data.insert(buffer.data.end(), bytes_[section].begin(), bytes_[section].end());
    }
    for (tinygltf::Accessor& accessor : model_.accessors) {
        accessor.bufferView = view_of_section[static_cast<std::size_t>(accessor.bufferView)];
    }
    if (!buffer.data.empty()) {
        model_.buffers.push_back(std::move(buffer));
    }
}

} // namespace elastoon
