// The scene file: JSON in, a checked Scene out, or one message with the file and the JSON path. docs/scene.md.
#pragma once

#include "elastoon/export.h"
#include "elastoon/result.h"
#include "elastoon/world.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elastoon ELASTOON_API {

struct SceneShape {
    std::string name;
    ShapePtr shape;
    std::string mesh_file; ///< as the scene gives it; empty unless type is mesh
};

struct SceneBody {
    std::string name;
    std::size_t shape = 0; ///< index into Scene::shapes
    BodyDef def;
    Vec3 color{0.0}; ///< sRGB 0..1
};

/// sRGB of an obstacle that names no colour.
inline constexpr Vec3 kDefaultObstacleColor{0.72, 0.70, 0.67};

struct SceneObstacle {
    std::string name;
    ObstacleDef def;
    std::optional<std::size_t> shape; ///< index into Scene::shapes; none for a plane
    Vec3 color{0.0};                  ///< sRGB 0..1
};

struct SceneCamera {
    Vec3 eye{0.0};
    Vec3 target{0.0};
    double fov_degrees = 35.0; ///< vertical
};

struct SceneStrobe {
    double every = 0.1;  ///< s between ghosts, > 0
    Vec3 spread{0.0};    ///< m/s: a ghost of time t is drawn t * spread aside, so that motion in place can be read
    double from = 0.0;   ///< s
    double to = -1.0;    ///< s; negative: the scene's end
};

struct Scene {
    std::string name;
    std::string file;  ///< where it was read from; empty for text
    Vec3 gravity{0.0, -9.81, 0.0};
    double duration = 6.0; ///< s
    std::vector<SceneShape> shapes;
    std::vector<SceneBody> bodies;
    std::vector<SceneObstacle> obstacles;
    std::optional<SceneCamera> camera;
    SceneStrobe strobe;
};

/// Reads the points of a mesh file, in m. The file's path is already resolved against the scene's folder.
using MeshReader = std::function<Result<std::vector<Vec3>>(const std::string& path)>;

/// Parses scene text. `file` is used in messages and to resolve mesh files. Every key, type and range is checked, and
/// the start of every body against the obstacles. Without a mesh reader, a mesh shape is an error.
Result<Scene> parseScene(std::string_view text, const std::string& file = {}, const MeshReader& read_mesh = {});
/// Reads and parses a scene file.
Result<Scene> readScene(const std::string& file, const MeshReader& read_mesh = {});

/// A world made from a scene, and which id each body and obstacle of the scene got, in the scene's order.
struct StagedScene {
    World world;
    std::vector<BodyId> bodies;
    std::vector<ObstacleId> obstacles;
};
Result<StagedScene> stage(const Scene& scene, const ParallelFor& parallel_for = {});

} // namespace elastoon ELASTOON_API
