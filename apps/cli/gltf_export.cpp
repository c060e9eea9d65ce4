// See gltf_export.h.
#include "gltf_export.h"

#include "drawn_mesh.h"
#include "gltf_buffer.h"
#include "gltf_ground.h"
#include "gltf_motion.h"
#include "output_file.h"
#include "picture.h"
#include "recording.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

namespace elastoon {

namespace {

constexpr double kRoughness = 0.6;
constexpr double kEmptySceneSize = 10.0; // m

std::string hexOf(const Vec3& color) {
    const auto byte = [](double value) { return std::lround(255.0 * std::clamp(value, 0.0, 1.0)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(color.r), byte(color.g), byte(color.b));
}

/// What of a node is animated.
enum class Moves : std::uint8_t { Nothing, Rigidly, Stretching };

/// Builds the model part by part; write() ends it.
class GltfScene {
public:
    GltfScene(const Scene& scene, const StagedScene& staged, MotionSpan span)
        : scene_(scene), staged_(staged), span_(std::move(span)), buffer_(model_) {
        model_.asset.version = "2.0";
        model_.asset.generator = "Elastoon";
        animation_.name = scene.name.empty() ? "motion" : scene.name;
    }

    void addBodies(const std::vector<const Track*>& tracks);
    void addObstacles();
    Status write(const std::string& path);

private:
    /// Accessors of a drawn shape, shared by all meshes of it.
    struct Geometry {
        int positions = -1, normals = -1;
        std::vector<std::pair<Tint, int>> parts; // and its indices
    };

    int addNode(const std::string& name, int mesh, const MotionKeys& keys, Moves moves);
    void addChannel(int node, const char* path, int input, int output);
    const Geometry& geometryOf(std::size_t shape, bool patterned);
    int meshOf(std::size_t shape, const Vec3& color, bool patterned);
    int materialOf(const std::string& name, const Vec3& color, bool double_sided = false);
    int planeMesh(std::size_t obstacle);
    /// As it is at the start of the span.
    [[nodiscard]] MovingFrame frameOf(std::size_t obstacle) const {
        return frameAt(scene_.obstacles[obstacle].def, 0.0, span_.start);
    }
    [[nodiscard]] WorldPlane planeOf(std::size_t obstacle) const;
    [[nodiscard]] std::vector<WorldPlane> stillPlanesBut(std::size_t obstacle) const;

    const Scene& scene_;
    const StagedScene& staged_;
    MotionSpan span_;
    tinygltf::Model model_;
    GltfBuffer buffer_;
    tinygltf::Animation animation_;
    ActionBounds bounds_;
    std::set<std::string> names_;
    std::map<std::pair<std::size_t, bool>, Geometry> geometries_;
    std::map<std::tuple<std::size_t, std::string, bool>, int> meshes_;
    std::map<std::pair<std::string, bool>, int> materials_;
};

void GltfScene::addChannel(int node, const char* path, int input, int output) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation_.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation_.samplers.push_back(sampler);
    animation_.channels.push_back(channel);
}

int GltfScene::addNode(const std::string& name, int mesh, const MotionKeys& keys, Moves moves) {
    tinygltf::Node node;
    node.name = name;
    for (int i = 2; !names_.insert(node.name).second; ++i) {
        node.name = fmt::format("{} ({})", name, i);
    }
    node.mesh = mesh;
    // The start stands in the node too, for readers that do not animate.
    node.translation.assign(keys.translations.front().begin(), keys.translations.front().end());
    node.rotation.assign(keys.rotations.front().begin(), keys.rotations.front().end());
    node.scale.assign(keys.scales.front().begin(), keys.scales.front().end());
    model_.nodes.push_back(node);
    const int index = static_cast<int>(model_.nodes.size()) - 1;
    if (moves != Moves::Nothing) {
        const int times = buffer_.addMotion(keys.times, true);
        addChannel(index, "translation", times, buffer_.addMotion(keys.translations));
        addChannel(index, "rotation", times, buffer_.addMotion(keys.rotations));
        if (moves == Moves::Stretching) {
            addChannel(index, "scale", times, buffer_.addMotion(keys.scales));
        }
    }
    return index;
}

int GltfScene::materialOf(const std::string& name, const Vec3& color, bool double_sided) {
    const auto [entry, is_new] =
        materials_.try_emplace({name, double_sided}, static_cast<int>(model_.materials.size()));
    if (is_new) {
        const Color linear = linearFromSrgb(color);
        tinygltf::Material material;
        material.name = name;
        material.doubleSided = double_sided;
        material.pbrMetallicRoughness.baseColorFactor = {linear.r, linear.g, linear.b, 1.0};
        material.pbrMetallicRoughness.metallicFactor = 0.0;
        material.pbrMetallicRoughness.roughnessFactor = kRoughness;
        model_.materials.push_back(material);
    }
    return entry->second;
}

const GltfScene::Geometry& GltfScene::geometryOf(std::size_t shape, bool patterned) {
    const auto [entry, is_new] = geometries_.try_emplace({shape, patterned});
    Geometry& geometry = entry->second;
    if (is_new) {
        const DrawnMesh drawn = drawnMesh(*scene_.shapes[shape].shape, patterned);
        geometry.positions = buffer_.addVertices(drawn.positions, true);
        geometry.normals = buffer_.addVertices(drawn.normals, false);
        for (std::size_t tint = 0; tint < kTintCount; ++tint) {
            std::vector<std::array<std::uint32_t, 3>> triangles;
            for (std::size_t i = 0; i < drawn.triangles.size(); ++i) {
                if (drawn.tints[i] == static_cast<Tint>(tint)) {
                    triangles.push_back(drawn.triangles[i]);
                }
            }
            if (!triangles.empty()) {
                geometry.parts.emplace_back(static_cast<Tint>(tint), buffer_.addIndices(triangles));
            }
        }
    }
    return geometry;
}

int GltfScene::meshOf(std::size_t shape, const Vec3& color, bool patterned) {
    const auto [entry, is_new] =
        meshes_.try_emplace({shape, hexOf(color), patterned}, static_cast<int>(model_.meshes.size()));
    if (is_new) {
        constexpr std::array<const char*, kTintCount> kTintNames{"main", "light", "accent"};
        const Geometry& geometry = geometryOf(shape, patterned);
        tinygltf::Mesh mesh;
        mesh.name = fmt::format("{} {}", scene_.shapes[shape].name, hexOf(color));
        for (const auto& [tint, indices] : geometry.parts) {
            tinygltf::Primitive primitive;
            primitive.attributes = {{"POSITION", geometry.positions}, {"NORMAL", geometry.normals}};
            primitive.indices = indices;
            primitive.mode = TINYGLTF_MODE_TRIANGLES;
            const char* tint_name = kTintNames[static_cast<std::size_t>(tint)];
            primitive.material = materialOf(fmt::format("{} {}", hexOf(color), tint_name), tintColor(tint, color));
            mesh.primitives.push_back(primitive);
        }
        model_.meshes.push_back(mesh);
    }
    return entry->second;
}

void GltfScene::addBodies(const std::vector<const Track*>& tracks) {
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const SceneBody& body = scene_.bodies[i];
        const MotionKeys keys = motionOf(*tracks[i], span_);
        const double reach = tracks[i]->shape()->boundingRadius();
        for (std::size_t k = 0; k < keys.times.size(); ++k) {
            const auto& p = keys.translations[k];
            bounds_.add(Vec3(p[0], p[1], p[2]),
                        reach * static_cast<double>(std::max(keys.scales[k][0], keys.scales[k][1])));
        }
        addNode(body.name, meshOf(body.shape, body.color, true), keys, Moves::Stretching);
    }
}

WorldPlane GltfScene::planeOf(std::size_t obstacle) const {
    const MovingFrame frame = frameOf(obstacle);
    const Vec3 normal = frame.orientationAt(span_.start) * staged_.world.planeNormal(staged_.obstacles[obstacle]);
    return {frame.originAt(span_.start), normal};
}

/// What hides parts of this plane for good: other planes, where none of them moves.
std::vector<WorldPlane> GltfScene::stillPlanesBut(std::size_t obstacle) const {
    std::vector<WorldPlane> planes;
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
        if (i != obstacle && !scene_.obstacles[i].shape && !scene_.obstacles[i].def.moves() &&
            !scene_.obstacles[obstacle].def.moves()) {
            planes.push_back(planeOf(i));
        }
    }
    return planes;
}

int GltfScene::planeMesh(std::size_t obstacle) {
    const MovingFrame frame = frameOf(obstacle);
    const Vec3 normal = staged_.world.planeNormal(staged_.obstacles[obstacle]);
    const auto single = [](const Vec3& v) {
        return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    std::vector<std::array<float, 3>> positions;
    for (const Vec3& corner : visiblePiece(planeOf(obstacle), bounds_, stillPlanesBut(obstacle))) {
        positions.push_back(single(frame.frameFromWorld(span_.start, corner)));
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t i = 2; i < positions.size(); ++i) {
        triangles.push_back({0, i - 1, i});
    }
    const SceneObstacle& plane = scene_.obstacles[obstacle];
    tinygltf::Primitive primitive;
    primitive.attributes = {{"POSITION", buffer_.addVertices(positions, true)},
                            {"NORMAL", buffer_.addVertices({positions.size(), single(normal)}, false)}};
    primitive.indices = buffer_.addIndices(triangles);
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = materialOf(hexOf(plane.color) + " plane", plane.color, true);
    tinygltf::Mesh mesh;
    mesh.name = plane.name;
    mesh.primitives = {primitive};
    model_.meshes.push_back(mesh);
    return static_cast<int>(model_.meshes.size()) - 1;
}

void GltfScene::addObstacles() {
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
        const SceneObstacle& obstacle = scene_.obstacles[i];
        if (obstacle.shape) {
            bounds_.add(frameOf(i).originAt(span_.start), scene_.shapes[*obstacle.shape].shape->boundingRadius());
        }
    }
    if (bounds_.empty) {
        bounds_.add(Vec3(0.0), 0.5 * kEmptySceneSize);
    }
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
        const SceneObstacle& obstacle = scene_.obstacles[i];
        const int mesh = obstacle.shape ? meshOf(*obstacle.shape, obstacle.color, false) : planeMesh(i);
        addNode(obstacle.name, mesh, motionOf(obstacle.def, span_),
                obstacle.def.moves() ? Moves::Rigidly : Moves::Nothing);
    }
}

Status GltfScene::write(const std::string& path) {
    buffer_.finish();
    if (!animation_.channels.empty()) {
        model_.animations.push_back(animation_);
    }
    tinygltf::Scene scene;
    scene.name = scene_.name;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
        scene.nodes.push_back(static_cast<int>(i));
    }
    model_.scenes.push_back(scene);
    model_.defaultScene = 0;
    std::ostringstream stream;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model_, stream, false, true)) {
        return Error{"the glTF writer refused the scene", path};
    }
    return writeWhole(path, stream.str());
}

} // namespace

Status writeGlb(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps,
                const std::string& path) {
    auto frames = frameTimes(fps, timeline.end() - timeline.start());
    if (!frames) {
        return frames.error();
    }
    const auto tracks = tracksOf(staged, timeline);
    if (!tracks) {
        return tracks.error();
    }
    GltfScene gltf(scene, staged, {timeline.start(), timeline.end(), std::move(frames).value()});
    gltf.addBodies(tracks.value());
    gltf.addObstacles();
    return gltf.write(path);
}

} // namespace elastoon
