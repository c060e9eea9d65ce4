// See scene.h: the contract's scene file, key by key. docs/scene.md.
#include "elastoon/scene.h"

#include "check_input.h"
#include "scene_json.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace elastoon {

namespace {

constexpr double kLongest = 86400.0;

constexpr std::array<std::string_view, 7> kShapeTypes{"sphere", "box", "cylinder", "cone", "capsule", "hull", "mesh"};

/// Colours for objects that name none; in turn.
constexpr std::array<std::array<int, 3>, 6> kPalette{
    {{228, 87, 46}, {23, 120, 165}, {242, 175, 41}, {42, 157, 124}, {150, 88, 166}, {214, 73, 118}}};

Vec3 paletteColor(std::size_t index) {
    const auto& c = kPalette[index % kPalette.size()];
    return Vec3(c[0], c[1], c[2]) / 255.0;
}

class SceneReader {
public:
    SceneReader(const std::string& file, const MeshReader& read_mesh) : json_(file), read_mesh_(read_mesh) {
        scene_.file = file;
    }
    Result<Scene> read(const Json& root);

private:
    void readShapes(const Json& shapes);
    Result<ShapePtr> makeShape(const Json& value, const std::string& path, SceneShape& into);
    Result<ShapePtr> makeHull(const Json& value, const std::string& path);
    Result<ShapePtr> makeMesh(const Json& value, const std::string& path, SceneShape& into);
    void readStyles(const Json& styles);
    Style readStyle(const Json& value, const std::string& path);
    Style styleOf(const Json& value, const std::string& path);
    void readBodies(const Json& bodies);
    void readObstacles(const Json& obstacles);
    void readPath(const Json& keys, const std::string& path, ObstacleDef& def);
    void readPlane(const Json& value, const std::string& path, SceneObstacle& obstacle);
    void readCamera(const Json& camera);
    void readStrobe(const Json& strobe);
    void checkStarts();

    std::string nameFor(const Json& value, const std::string& path, const std::string& otherwise,
                        std::set<std::string>& taken);
    std::size_t shapeIndex(const Json& value, const std::string& path);
    double size(const Json& value, const std::string& path, std::string_view key);
    template <class Read>
    void optional(const Json& value, const std::string& path, std::string_view key, Read&& read) {
        if (const Json* found = JsonReader::member(value, key)) {
            read(*found, path + pathPart(key));
        }
    }

    JsonReader json_;
    const MeshReader& read_mesh_;
    Scene scene_;
    std::vector<std::string> style_names_;
    std::vector<Style> styles_;
};

Result<Scene> SceneReader::read(const Json& root) {
    if (!root.is_object()) {
        return Error{"a scene must be a JSON object: { \"elastoon\": 1, ... }", scene_.file};
    }
    if (const Json* version = json_.required(root, "", "elastoon")) {
        if (!version->is_number_integer() || *version != 1) {
            json_.fail("/elastoon", "must be 1, the version of scene files that this program reads");
        }
    }
    json_.object(
        root, "",
        {"elastoon", "name", "gravity", "duration", "shapes", "styles", "bodies", "obstacles", "camera", "strobe"});
    if (json_.failed()) {
        return *json_.error();
    }
    optional(root, "", "name", [&](const Json& v, const std::string& p) { scene_.name = json_.text(v, p); });
    optional(root, "", "gravity",
             [&](const Json& v, const std::string& p) { scene_.gravity = json_.vector(v, p, kMostGravity); });
    optional(root, "", "duration",
             [&](const Json& v, const std::string& p) { scene_.duration = json_.number(v, p, 0.0, kLongest, "s"); });
    optional(root, "", "shapes", [&](const Json& v, const std::string&) { readShapes(v); });
    optional(root, "", "styles", [&](const Json& v, const std::string&) { readStyles(v); });
    optional(root, "", "obstacles", [&](const Json& v, const std::string&) { readObstacles(v); });
    optional(root, "", "bodies", [&](const Json& v, const std::string&) { readBodies(v); });
    optional(root, "", "camera", [&](const Json& v, const std::string&) { readCamera(v); });
    optional(root, "", "strobe", [&](const Json& v, const std::string&) { readStrobe(v); });
    if (!json_.failed()) {
        checkStarts();
    }
    if (json_.failed()) {
        return *json_.error();
    }
    return std::move(scene_);
}

double SceneReader::size(const Json& value, const std::string& path, std::string_view key) {
    const Json* found = json_.required(value, path, key);
    return found == nullptr ? 1.0 : json_.number(*found, path + pathPart(key), Shape::kMinSize, Shape::kMaxSize, "m");
}

void SceneReader::readShapes(const Json& shapes) {
    if (!shapes.is_object()) {
        json_.fail("/shapes", "must be an object: { \"name\": { \"type\": ... }, ... }");
        return;
    }
    for (const auto& [name, value] : shapes.items()) {
        const std::string path = "/shapes" + pathPart(name);
        SceneShape shape{name, nullptr, {}};
        Result<ShapePtr> made = makeShape(value, path, shape);
        if (!made) {
            const Error& error = made.error();
            json_.fail(path, error.where.empty() ? error.message : error.where + ": " + error.message);
        }
        if (json_.failed()) {
            return;
        }
        shape.shape = std::move(made).value();
        scene_.shapes.push_back(std::move(shape));
    }
}

Result<ShapePtr> SceneReader::makeShape(const Json& value, const std::string& path, SceneShape& into) {
    const Json* type = value.is_object() ? json_.required(value, path, "type") : nullptr;
    if (type == nullptr) {
        json_.fail(path, "must be an object with a \"type\"");
        return ShapePtr{};
    }
    switch (json_.choice(*type, path + "/type", kShapeTypes)) {
    case 0:
        json_.object(value, path, {"type", "radius"});
        return Shape::sphere(size(value, path, "radius"));
    case 1: {
        json_.object(value, path, {"type", "size"});
        const Json* full = json_.required(value, path, "size");
        return Shape::box(full == nullptr ? Vec3(1.0) : json_.vector(*full, path + "/size", Shape::kMaxSize));
    }
    case 5:
        return makeHull(value, path);
    case 6:
        return makeMesh(value, path, into);
    default:
        break;
    }
    json_.object(value, path, {"type", "radius", "length"});
    const double radius = size(value, path, "radius");
    const double length = size(value, path, "length");
    if (json_.failed()) {
        return ShapePtr{};
    }
    return *type == "cylinder" ? Shape::cylinder(radius, length)
           : *type == "cone"   ? Shape::cone(radius, length)
                               : Shape::capsule(radius, length);
}

Result<ShapePtr> SceneReader::makeHull(const Json& value, const std::string& path) {
    json_.object(value, path, {"type", "points"});
    const Json* given = json_.required(value, path, "points");
    std::vector<Vec3> points;
    if (given != nullptr && json_.array(*given, path + "/points")) {
        for (std::size_t i = 0; i < given->size() && !json_.failed(); ++i) {
            points.push_back(json_.vector((*given)[i], path + "/points" + pathPart(i), Shape::kMaxSize));
        }
    }
    return json_.failed() ? Result<ShapePtr>(ShapePtr{}) : Shape::hull(points);
}

Result<ShapePtr> SceneReader::makeMesh(const Json& value, const std::string& path, SceneShape& into) {
    json_.object(value, path, {"type", "file"});
    const Json* file = json_.required(value, path, "file");
    into.mesh_file = file == nullptr ? "" : json_.text(*file, path + "/file");
    if (json_.failed()) {
        return ShapePtr{};
    }
    if (!read_mesh_) {
        return Error{"mesh files cannot be read here; give the points as a \"hull\"", ""};
    }
    const std::size_t slash = scene_.file.find_last_of('/');
    const bool absolute = into.mesh_file.starts_with('/');
    const std::string folder = absolute || slash == std::string::npos ? "" : scene_.file.substr(0, slash + 1);
    auto points = read_mesh_(folder + into.mesh_file);
    if (!points) {
        return points.error();
    }
    auto hull = Shape::hull(points.value());
    return hull ? hull : Result<ShapePtr>(Error{hull.error().message, folder + into.mesh_file});
}

void SceneReader::readStyles(const Json& styles) {
    if (!styles.is_object()) {
        json_.fail("/styles", "must be an object: { \"name\": { \"restitution\": ... }, ... }");
        return;
    }
    for (const auto& [name, value] : styles.items()) {
        style_names_.push_back(name);
        styles_.push_back(readStyle(value, "/styles" + pathPart(name)));
    }
}

Style SceneReader::readStyle(const Json& value, const std::string& path) {
    std::vector<std::string_view> keys;
    for (const StyleParameter& parameter : styleParameters()) {
        keys.push_back(parameter.name);
    }
    Style style;
    if (!json_.object(value, path, keys)) {
        return style;
    }
    for (const StyleParameter& parameter : styleParameters()) {
        optional(value, path, parameter.name, [&](const Json& given, const std::string& place) {
            double number = kDerived;
            if (!parameter.choices.empty()) {
                number = static_cast<double>(json_.choice(given, place, parameter.choices));
            } else if (!(parameter.may_be_derived && given == "auto")) {
                number = json_.number(given, place, parameter.minimum, parameter.maximum, parameter.unit);
            }
            setParameter(style, parameter, number);
        });
    }
    return style;
}

/// A style of the scene, or one that comes with the library; the scene's own comes first.
Style SceneReader::styleOf(const Json& value, const std::string& path) {
    const std::string name = json_.text(value, path);
    const auto found = std::find(style_names_.begin(), style_names_.end(), name);
    if (found != style_names_.end()) {
        return styles_[static_cast<std::size_t>(found - style_names_.begin())];
    }
    const std::optional<Style> style = styleNamed(name);
    if (!style) {
        std::vector<std::string_view> known(style_names_.begin(), style_names_.end());
        const std::vector<std::string_view> built_in = styleNames();
        known.insert(known.end(), built_in.begin(), built_in.end());
        json_.fail(path, "there is no style \"" + name + "\"" + suggestion(name, known) + "; known: " + listOf(known));
    }
    return style.value_or(Style{});
}

std::string SceneReader::nameFor(const Json& value, const std::string& path, const std::string& otherwise,
                                 std::set<std::string>& taken) {
    std::string name = otherwise;
    optional(value, path, "name", [&](const Json& v, const std::string& p) {
        name = json_.text(v, p);
        if (name.empty()) {
            json_.fail(p, "must not be empty");
        }
    });
    if (!taken.insert(name).second) {
        json_.fail(path + "/name", "the name \"" + name + "\" is taken by another one in this list");
    }
    return name;
}

std::size_t SceneReader::shapeIndex(const Json& value, const std::string& path) {
    const std::string name = json_.text(value, path);
    std::vector<std::string_view> known;
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
        if (scene_.shapes[i].name == name) {
            return i;
        }
        known.push_back(scene_.shapes[i].name);
    }
    json_.fail(path, "there is no shape \"" + name + "\" in /shapes" + suggestion(name, known));
    return 0;
}

void SceneReader::readBodies(const Json& bodies) {
    if (!json_.array(bodies, "/bodies")) {
        return;
    }
    std::set<std::string> taken;
    for (std::size_t i = 0; i < bodies.size() && !json_.failed(); ++i) {
        const std::string path = "/bodies" + pathPart(i);
        const Json& value = bodies[i];
        if (!json_.object(value, path, {"name", "shape", "style", "position", "velocity", "rotation", "color"})) {
            return;
        }
        SceneBody body;
        body.name = nameFor(value, path, "body" + std::to_string(i + 1), taken);
        body.color = paletteColor(i);
        if (const Json* shape = json_.required(value, path, "shape")) {
            body.shape = shapeIndex(*shape, path + "/shape");
        }
        optional(value, path, "style", [&](const Json& v, const std::string& p) { body.def.style = styleOf(v, p); });
        optional(value, path, "position",
                 [&](const Json& v, const std::string& p) { body.def.position = json_.vector(v, p, kMostPosition); });
        optional(value, path, "velocity",
                 [&](const Json& v, const std::string& p) { body.def.velocity = json_.vector(v, p, kMostSpeed); });
        optional(value, path, "rotation",
                 [&](const Json& v, const std::string& p) { body.def.rotation = json_.rotation(v, p); });
        optional(value, path, "color", [&](const Json& v, const std::string& p) { body.color = json_.color(v, p); });
        if (!json_.failed()) {
            body.def.shape = scene_.shapes[body.shape].shape;
            scene_.bodies.push_back(std::move(body));
        }
    }
}

void SceneReader::readPlane(const Json& value, const std::string& path, SceneObstacle& obstacle) {
    Vec3 normal(0.0, 1.0, 0.0);
    double offset = 0.0;
    if (!json_.object(value, path, {"name", "type", "normal", "offset", "velocity", "color"})) {
        return;
    }
    if (json_.text(value["type"], path + "/type") != "plane") {
        json_.fail(path + "/type", "must be \"plane\"; a solid obstacle has a \"shape\" instead");
    }
    if (const Json* given = json_.required(value, path, "normal")) {
        normal = json_.vector(*given, path + "/normal", kMostPosition);
        if (!(glm::length(normal) > 1e-9)) {
            json_.fail(path + "/normal", "must be a direction, not zero; up is [0, 1, 0]");
            return;
        }
    }
    optional(value, path, "offset", [&](const Json& v, const std::string& p) {
        offset = json_.number(v, p, -kMostPosition, kMostPosition, "m");
    });
    obstacle.def = ObstacleDef::plane(glm::normalize(normal), offset);
}

void SceneReader::readPath(const Json& keys, const std::string& path, ObstacleDef& def) {
    if (!json_.array(keys, path)) {
        return;
    }
    double last = 0.0;
    for (std::size_t i = 0; i < keys.size() && !json_.failed(); ++i) {
        const std::string at = path + pathPart(i);
        if (!json_.object(keys[i], at, {"time", "position", "rotation"})) {
            return;
        }
        PathKey key;
        // What a key does not say stays as it is.
        key.position = i == 0 ? def.position : def.path.back().position;
        key.rotation = i == 0 ? def.rotation : def.path.back().rotation;
        if (!keys[i].contains("time")) {
            json_.fail(at, "must have a \"time\"");
            return;
        }
        key.time = json_.number(keys[i]["time"], at + "/time", 0.0, kMostStep);
        if (!json_.failed() && !(key.time > last)) {
            json_.fail(at + "/time", "must be above " + shortNumber(last) + ", the key before it");
        }
        last = key.time;
        optional(keys[i], at, "position",
                 [&](const Json& v, const std::string& p) { key.position = json_.vector(v, p, kMostPosition); });
        optional(keys[i], at, "rotation",
                 [&](const Json& v, const std::string& p) { key.rotation = json_.rotation(v, p); });
        def.path.push_back(key);
    }
}

void SceneReader::readObstacles(const Json& obstacles) {
    if (!json_.array(obstacles, "/obstacles")) {
        return;
    }
    std::set<std::string> taken;
    for (std::size_t i = 0; i < obstacles.size() && !json_.failed(); ++i) {
        const std::string path = "/obstacles" + pathPart(i);
        const Json& value = obstacles[i];
        SceneObstacle obstacle;
        obstacle.color = kDefaultObstacleColor;
        if (value.is_object() && value.contains("type")) {
            readPlane(value, path, obstacle);
        } else if (json_.object(value, path,
                                {"name", "shape", "position", "rotation", "velocity", "angular_velocity", "path",
                                 "path_repeats", "color"})) {
            if (!value.contains("shape")) {
                json_.fail(path, "must have a \"shape\", or \"type\": \"plane\"");
                return;
            }
            obstacle.shape = shapeIndex(value["shape"], path + "/shape");
        }
        if (json_.failed()) {
            return;
        }
        obstacle.name = nameFor(value, path, "obstacle" + std::to_string(i + 1), taken);
        optional(value, path, "position", [&](const Json& v, const std::string& p) {
            obstacle.def.position = json_.vector(v, p, kMostPosition);
        });
        optional(value, path, "rotation",
                 [&](const Json& v, const std::string& p) { obstacle.def.rotation = json_.rotation(v, p); });
        optional(value, path, "velocity",
                 [&](const Json& v, const std::string& p) { obstacle.def.velocity = json_.vector(v, p, kMostSpeed); });
        optional(value, path, "angular_velocity", [&](const Json& v, const std::string& p) {
            constexpr double kRadiansPerDegree = 0.017453292519943295;
            obstacle.def.angular_velocity = kRadiansPerDegree * json_.vector(v, p, kMostSpin / kRadiansPerDegree);
        });
        optional(value, path, "path", [&](const Json& v, const std::string& p) { readPath(v, p, obstacle.def); });
        optional(value, path, "path_repeats",
                 [&](const Json& v, const std::string& p) { obstacle.def.path_repeats = json_.boolean(v, p); });
        optional(value, path, "color",
                 [&](const Json& v, const std::string& p) { obstacle.color = json_.color(v, p); });
        if (obstacle.shape) {
            obstacle.def.shape = scene_.shapes[*obstacle.shape].shape;
        }
        scene_.obstacles.push_back(std::move(obstacle));
    }
}

void SceneReader::readCamera(const Json& camera) {
    if (!json_.object(camera, "/camera", {"eye", "target", "fov"})) {
        return;
    }
    SceneCamera read;
    if (const Json* eye = json_.required(camera, "/camera", "eye")) {
        read.eye = json_.vector(*eye, "/camera/eye", kMostPosition);
    }
    if (const Json* target = json_.required(camera, "/camera", "target")) {
        read.target = json_.vector(*target, "/camera/target", kMostPosition);
    }
    optional(camera, "/camera", "fov", [&](const Json& v, const std::string& p) {
        read.fov_degrees = json_.number(v, p, 1.0, 170.0, "degrees");
    });
    if (!json_.failed() && glm::length(read.eye - read.target) < 1e-6) {
        json_.fail("/camera/target", "must be another place than the eye");
    }
    scene_.camera = read;
}

void SceneReader::readStrobe(const Json& strobe) {
    if (!json_.object(strobe, "/strobe", {"every", "spread", "from", "to"})) {
        return;
    }
    SceneStrobe& read = scene_.strobe;
    optional(strobe, "/strobe", "every",
             [&](const Json& v, const std::string& p) { read.every = json_.number(v, p, 1e-4, kLongest, "s"); });
    optional(strobe, "/strobe", "spread",
             [&](const Json& v, const std::string& p) { read.spread = json_.vector(v, p, kMostSpeed); });
    optional(strobe, "/strobe", "from",
             [&](const Json& v, const std::string& p) { read.from = json_.number(v, p, 0.0, kLongest, "s"); });
    optional(strobe, "/strobe", "to",
             [&](const Json& v, const std::string& p) { read.to = json_.number(v, p, read.from, kLongest, "s"); });
}

/// Bodies must not start inside obstacles. (What else stage() could refuse has been refused by now.)
void SceneReader::checkStarts() {
    Scene without_bodies = scene_;
    without_bodies.bodies.clear();
    auto staged = stage(without_bodies);
    if (!staged) {
        json_.fail("", staged.error().text());
        return;
    }
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
        const auto overlap = staged.value().world.overlapOf(scene_.bodies[i].def);
        if (!overlap) {
            continue;
        }
        const Vec3 way = overlap->normal * overlap->depth;
        json_.fail("/bodies" + pathPart(i) + "/position",
                   "the body starts " + shortNumber(overlap->depth) + " m inside the obstacle \"" +
                       scene_.obstacles[overlap->obstacle.slot - 1].name + "\"; move it by at least [" +
                       shortNumber(way.x) + ", " + shortNumber(way.y) + ", " + shortNumber(way.z) + "]");
        return;
    }
}

} // namespace

Result<Scene> parseScene(std::string_view text, const std::string& file, const MeshReader& read_mesh) {
    auto root = parseJson(text, file);
    if (!root) {
        return root.error();
    }
    return SceneReader(file, read_mesh).read(root.value());
}

Result<StagedScene> stage(const Scene& scene, const ParallelFor& parallel_for) {
    auto world = World::create({.gravity = scene.gravity, .parallel_for = parallel_for});
    if (!world) {
        return world.error();
    }
    StagedScene staged{std::move(world).value(), {}, {}};
    for (const SceneObstacle& obstacle : scene.obstacles) {
        auto id = staged.world.addObstacle(obstacle.def);
        if (!id) {
            return Error{id.error().message, "obstacle \"" + obstacle.name + "\", " + id.error().where};
        }
        staged.obstacles.push_back(id.value());
    }
    for (const SceneBody& body : scene.bodies) {
        auto id = staged.world.addBody(body.def);
        if (!id) {
            return Error{id.error().message, "body \"" + body.name + "\", " + id.error().where};
        }
        staged.bodies.push_back(id.value());
    }
    return staged;
}

} // namespace elastoon
