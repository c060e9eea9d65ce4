// The scene file: everything the contract names is read; whatever is wrong gets one message with its JSON path.
#include "elastoon/scene.h"

#include "test_support.h"

#include <string>

namespace elastoon {
namespace {

constexpr const char* kFull = R"({ "elastoon": 1, "name": "all of it", "gravity": [0, -1.62, 0], "duration": 3.5,
  "shapes": { "ball": {"type": "sphere", "radius": 1}, "crate": {"type": "box", "size": [1, 2, 3]},
              "can": {"type": "cylinder", "radius": 0.5, "length": 2}, "hat": {"type": "cone", "radius": 1, "length": 2},
              "pill": {"type": "capsule", "radius": 0.25, "length": 1},
              "tetra": {"type": "hull", "points": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]} },
  "styles": { "rubber": {"restitution": 0.7, "max_stretch": 3, "min_squash": 0.4, "stretch_rate": 0.2, "squash_rate": 2,
              "squash_law": "paper", "impact_easing": "linear", "reversal_rate": 360, "rest_speed": "auto",
              "rest_slope": 45}, "plain": {} },
  "bodies": [ {"name": "b1", "shape": "ball", "style": "rubber", "position": [0, 11, 0], "velocity": [0.8, 0, 0],
               "rotation": [0, 0, 1, 0], "color": "#e4572e"}, {"shape": "pill", "position": [5, 5, 5]} ],
  "obstacles": [ {"name": "floor", "type": "plane", "normal": [0, 2, 0], "offset": 0.5},
                 {"name": "step", "shape": "crate", "position": [3, 9, 0], "rotation": [0, 0, 0, 1], "velocity": [0, 0, 1],
                  "angular_velocity": [0, 90, 0]} ],
  "camera": { "eye": [1, 2, 3], "target": [0, 0, 0], "fov": 40 }, "strobe": { "every": 0.05, "spread": [1, 0, 0] } })";

TEST(Scene, ReadsAllThatTheContractNames) {
    const Scene scene = valueOf(parseScene(kFull));
    EXPECT_EQ(scene.name, "all of it");
    EXPECT_EQ(scene.gravity, Vec3(0, -1.62, 0));
    EXPECT_EQ(scene.duration, 3.5);
    ASSERT_EQ(scene.shapes.size(), 6U);
    ASSERT_EQ(scene.bodies.size(), 2U);
    const SceneBody& body = scene.bodies[0];
    EXPECT_EQ(body.name, "b1");
    EXPECT_EQ(body.def.shape->kind(), ShapeKind::Sphere);
    EXPECT_EQ(body.def.style.restitution, 0.7);
    EXPECT_EQ(body.def.style.squash_law, SquashLaw::Paper);
    EXPECT_EQ(body.def.style.impact_easing, ImpactEasing::Linear);
    EXPECT_NEAR(body.def.style.reversal_rate, 2 * M_PI, 1e-12);
    EXPECT_NEAR(body.def.style.rest_slope, M_PI / 4, 1e-12);
    EXPECT_EQ(body.def.style.rest_speed, kDerived);
    EXPECT_EQ(body.def.rotation.z, 1.0);
    EXPECT_NEAR(body.color.x, 228.0 / 255.0, 1e-12);
    EXPECT_EQ(scene.bodies[1].name, "body2");
    EXPECT_EQ(scene.bodies[1].def.style, Style{});
    EXPECT_EQ(scene.obstacles[0].def.normal, Vec3(0, 1, 0));
    EXPECT_EQ(scene.obstacles[0].def.position, Vec3(0, 0.5, 0));
    EXPECT_NEAR(scene.obstacles[1].def.angular_velocity.y, M_PI / 2, 1e-12);
    ASSERT_TRUE(scene.camera.has_value());
    EXPECT_EQ(scene.camera->fov_degrees, 40.0);
    EXPECT_EQ(scene.strobe.every, 0.05);
    EXPECT_TRUE(stage(scene).ok());
}

TEST(Scene, EmptyIsAScene) {
    const Scene scene = valueOf(parseScene(R"({"elastoon": 1})"));
    EXPECT_TRUE(scene.bodies.empty());
    EXPECT_TRUE(stage(scene).ok());
}

/// kFull with one piece replaced.
std::string with(const std::string& from, const std::string& to) {
    std::string text = kFull;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

struct Wrong {
    const char* from;
    const char* to;
    const char* path;
    const char* says;
};

TEST(Scene, EveryMistakeGetsItsPathAndAReason) {
    const Wrong cases[] = {
        {"\"elastoon\": 1", "\"elastoon\": 2", "/elastoon", "must be 1"},
        {"\"elastoon\": 1", "\"elastoons\": 1", "", "\"elastoon\" is missing"},
        {"\"duration\": 3.5", "\"durration\": 3.5", "/durration", "did you mean \"duration\""},
        {"\"duration\": 3.5", "\"duration\": -1", "/duration", "must be from 0 to 86400 s, is -1"},
        {"\"duration\": 3.5", "\"duration\": \"long\"", "/duration", "must be a number, is a text"},
        {"\"gravity\": [0, -1.62, 0]", "\"gravity\": [0, -1.62]", "/gravity", "a list of 2"},
        {"\"gravity\": [0, -1.62, 0]", "\"gravity\": [0, 1e9, 0]", "/gravity/1", "is 1e+09"},
        {"\"type\": \"sphere\"", "\"type\": \"sfere\"", "/shapes/ball/type", "did you mean \"sphere\""},
        {"\"radius\": 1}", "\"radius\": 0}", "/shapes/ball/radius", "must be from 1e-09"},
        {"\"radius\": 1}", "\"radius\": 1, \"size\": 2}", "/shapes/ball/size", "unknown key"},
        {"\"size\": [1, 2, 3]", "\"size\": [1, -2, 3]", "/shapes/crate", "size: must be a length"},
        {"\"radius\": 0.25, \"length\": 1", "\"radius\": 0.25, \"length\": 0.4", "/shapes/pill", "twice the radius"},
        {",[0,0,1]]", ",[1,1,0]]", "/shapes/tetra", "one plane"},
        {",[0,0,1]]", "]", "/shapes/tetra", "at least 4 points"},
        {"\"restitution\": 0.7", "\"restitution\": -0.7", "/styles/rubber/restitution", "must be from 0 to 10"},
        {"\"restitution\": 0.7", "\"restituton\": 0.7", "/styles/rubber/restituton", "did you mean \"restitution\""},
        {"\"squash_law\": \"paper\"", "\"squash_law\": \"rock\"", "/styles/rubber/squash_law", "bounded, paper"},
        {"\"rest_speed\": \"auto\"", "\"rest_speed\": \"car\"", "/styles/rubber/rest_speed", "must be a number"},
        {"\"shape\": \"ball\"", "\"shape\": \"bal\"", "/bodies/0/shape", "did you mean \"ball\""},
        {"\"shape\": \"ball\", ", "", "/bodies/0", "\"shape\" is missing"},
        {"\"style\": \"rubber\"", "\"style\": \"rubbr\"", "/bodies/0/style", "did you mean \"rubber\""},
        {"[0, 11, 0]", "[0, 1.2, 0]", "/bodies/0/position", "inside the obstacle \"floor\""},
        {"[0, 11, 0]", "[0, null, 0]", "/bodies/0/position/1", "must be a number"},
        {"[0, 0, 1, 0]", "[0, 0, 0, 0]", "/bodies/0/rotation", "not zero"},
        {"#e4572e", "#e4572", "/bodies/0/color", "#e4572e"},
        {"{\"shape\": \"pill\"", "{\"name\": \"b1\", \"shape\": \"pill\"", "/bodies/1/name", "taken"},
        {"\"normal\": [0, 2, 0]", "\"normal\": [0, 0, 0]", "/obstacles/0/normal", "not zero"},
        {"\"type\": \"plane\"", "\"type\": \"plain\"", "/obstacles/0/type", "must be \"plane\""},
        {"\"shape\": \"crate\"", "\"color\": \"#000000\"", "/obstacles/1", "must have a \"shape\""},
        {"\"target\": [0, 0, 0]", "\"target\": [1, 2, 3]", "/camera/target", "another place"},
        {"\"every\": 0.05", "\"every\": 0", "/strobe/every", "must be from"},
    };
    for (const Wrong& wrong : cases) {
        const auto scene = parseScene(with(wrong.from, wrong.to), "s.json");
        ASSERT_FALSE(scene.ok()) << wrong.to;
        const std::string where = std::string("s.json") + (*wrong.path == '\0' ? "" : ": ") + wrong.path;
        EXPECT_EQ(scene.error().where, where) << scene.error().message;
        EXPECT_NE(scene.error().message.find(wrong.says), std::string::npos) << scene.error().message;
    }
}

TEST(Scene, ListsAndObjectsMustBeThat) {
    const auto errorOf = [](const std::string& rest) { return parseScene("{\"elastoon\": 1, " + rest + "}").error(); };
    EXPECT_EQ(errorOf("\"bodies\": 3").where, "/bodies");
    EXPECT_EQ(errorOf("\"bodies\": [3]").where, "/bodies/0");
    EXPECT_EQ(errorOf("\"obstacles\": {}").where, "/obstacles");
    EXPECT_EQ(errorOf("\"obstacles\": [[]]").where, "/obstacles/0");
    EXPECT_EQ(errorOf("\"shapes\": []").where, "/shapes");
    EXPECT_EQ(errorOf("\"shapes\": {\"a\": 1}").where, "/shapes/a");
    EXPECT_EQ(errorOf("\"styles\": 1").where, "/styles");
    EXPECT_EQ(errorOf("\"styles\": {\"a\": []}").where, "/styles/a");
    EXPECT_EQ(errorOf("\"camera\": []").where, "/camera");
    EXPECT_EQ(errorOf("\"strobe\": 1").where, "/strobe");
}

TEST(Scene, BrokenTextIsNamedByLineAndColumn) {
    const auto errorOf = [](const std::string& text) { return parseScene(text, "s.json").error(); };
    EXPECT_EQ(errorOf("{\n  \"elastoon\": 1,\n  oops }").where, "s.json: line 3, column 3");
    EXPECT_NE(errorOf(R"({"elastoon": 1, "duration": NaN})").message.find("not valid JSON"), std::string::npos);
    EXPECT_NE(errorOf(R"({"elastoon": 1, "duration": 1e999})").message.find("too large"), std::string::npos);
    EXPECT_NE(errorOf(R"({"elastoon": 1, "name": "a", "name": "b"})").message.find("twice"), std::string::npos);
    EXPECT_NE(errorOf(std::string(100000, '[')).message.find("nested deeper"), std::string::npos);
    EXPECT_FALSE(parseScene("").ok());
    EXPECT_FALSE(parseScene("[]").ok());
    EXPECT_FALSE(parseScene("\xff\xfe").ok());
    EXPECT_EQ(readScene("/no/such.json").error().where, "/no/such.json");
    EXPECT_FALSE(readScene("/").ok());
}

TEST(Scene, TruncatedAtAnyPlaceIsRefusedNotCrashed) {
    const std::string text = kFull;
    for (std::size_t length = 0; length + 1 < text.size(); ++length) {
        EXPECT_FALSE(parseScene(std::string_view(text).substr(0, length)).ok()) << length;
    }
}

TEST(Scene, RandomDamageIsReadOrRefused) {
    Random random(23);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
        std::string text = kFull;
        for (int j = 0; j < 1 + random.below(4); ++j) {
            text[static_cast<std::size_t>(random.below(static_cast<int>(text.size())))] =
                static_cast<char>(32 + random.below(95));
        }
        refused += parseScene(text).ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 1500);
}

TEST(Scene, MeshesNeedAReaderAndAVolume) {
    const std::string text = R"({"elastoon": 1, "shapes": {"rock": {"type": "mesh", "file": "rock.obj"}}})";
    EXPECT_NE(parseScene(text, "dir/s.json").error().message.find("cannot be read here"), std::string::npos);
    std::string asked;
    const auto flat = [&](const std::string& path) -> Result<std::vector<Vec3>> {
        asked = path;
        return std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    };
    const auto refused = parseScene(text, "dir/s.json", flat);
    EXPECT_EQ(asked, "dir/rock.obj") << "taken from the scene's folder";
    EXPECT_EQ(refused.error().where, "dir/s.json: /shapes/rock");
    EXPECT_NE(refused.error().message.find("one plane"), std::string::npos);
}

TEST(Scene, ObstaclesFollowPaths) {
    const auto withPath = [](const std::string& path) {
        return parseScene(R"({"elastoon":1,"shapes":{"b":{"type":"box","size":[1,1,1]}},
            "obstacles":[{"shape":"b","position":[1,0,0],"path":)" +
                          path + R"(,"path_repeats":true}]})");
    };
    const Scene scene = valueOf(withPath(R"([{"time":1,"position":[1,2,0]},{"time":2.5}])"));
    const ObstacleDef& def = scene.obstacles[0].def;
    ASSERT_EQ(def.path.size(), 2U);
    EXPECT_EQ(def.path[1].position, Vec3(1, 2, 0)) << "what a key leaves out stays";
    EXPECT_EQ(def.path[1].time, 2.5);
    EXPECT_TRUE(def.path_repeats);
    EXPECT_EQ(withPath(R"([{"time":1},{"time":1}])").error().where, "/obstacles/0/path/1/time");
    EXPECT_EQ(withPath(R"([{"position":[0,0,0]}])").error().where, "/obstacles/0/path/0");
    EXPECT_EQ(withPath(R"(3)").error().where, "/obstacles/0/path");
}

} // namespace
} // namespace elastoon
