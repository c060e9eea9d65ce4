// What the tests of written files share: a small scene that has been run, a folder of its own, reading files back.
#pragma once

#include "commands.h"
#include "test_support.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unistd.h>

namespace elastoon {

/// A folder that is there and empty at the start of a test, and gone after it.
class TestFolder {
public:
    explicit TestFolder(const std::string& name)
        : path_(std::filesystem::path(testing::TempDir()) / ("elastoon_" + name + std::to_string(getpid()))) {
        std::filesystem::remove_all(path_);
        std::filesystem::create_directories(path_);
    }
    TestFolder(const TestFolder&) = delete;
    TestFolder& operator=(const TestFolder&) = delete;
    ~TestFolder() { std::filesystem::remove_all(path_); }

    [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
    }

private:
    std::filesystem::path path_;
};

inline std::string contentOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
}

/// Two balls and a box that fall, hit, roll over and come to rest before a wall; one obstacle moves, one name needs
/// quotes.
inline constexpr const char* kExportScene = R"json({
  "elastoon": 1, "name": "export", "gravity": [0, -9.81, 0], "duration": 3,
  "shapes": { "ball": {"type": "sphere", "radius": 0.5}, "box": {"type": "box", "size": [1, 0.7, 0.5]} },
  "styles": { "rubber": {"restitution": 0.6} },
  "bodies": [
    {"name": "one", "shape": "ball", "style": "rubber", "position": [0, 3, 0], "velocity": [3, 0, 0],
     "color": "#e4572e"},
    {"name": "two, \"b\"", "shape": "ball", "style": "rubber", "position": [1, 4, 2], "velocity": [0.1, 2, 0.4],
     "color": "#e4572e"},
    {"name": "crate", "shape": "box", "style": "rubber", "position": [0, 2, -2], "velocity": [6, 1, 0.4],
     "color": "#808080"}],
  "obstacles": [
    {"name": "floor", "type": "plane", "normal": [0, 1, 0], "offset": 0},
    {"name": "wall", "type": "plane", "normal": [-1, 0, 0], "offset": -5},
    {"name": "fan", "shape": "box", "position": [-4, 6, 0], "velocity": [0, 0.2, 0], "angular_velocity": [0, 40, 0]}]
})json";

struct Played {
    Scene scene;
    Performance performance;
    double duration = 0.0;
};

inline Played play(const std::string& scene_text, double duration) {
    Scene scene = valueOf(parseScene(scene_text));
    Performance performance = perform(scene, duration);
    return {std::move(scene), std::move(performance), duration};
}

} // namespace elastoon
