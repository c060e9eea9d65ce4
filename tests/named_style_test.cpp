// The styles that come with the library: what the files say, within the table's ranges, usable by name in any scene.
#include "elastoon/scene.h"
#include "elastoon/style.h"

#include "test_support.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

namespace elastoon {
namespace {

/// A ball of this style; `styles` is what the scene declares.
std::string sceneOf(const std::string& style, const std::string& styles = "{}") {
    return R"({"elastoon": 1, "shapes": {"ball": {"type": "sphere", "radius": 0.5}}, "styles": )" + styles +
           R"(, "bodies": [{"shape": "ball", "style": ")" + style + R"(", "position": [0, 3, 0]}]})";
}

Style styleIn(const std::string& scene) {
    return valueOf(parseScene(scene)).bodies.at(0).def.style;
}

/// The files, by the names of their styles.
std::map<std::string, nlohmann::json> styleFiles() {
    std::map<std::string, nlohmann::json> files;
    for (const auto& entry : std::filesystem::directory_iterator(ELASTOON_SOURCE_DIR "/scenes/styles")) {
        std::ifstream stream(entry.path());
        files[entry.path().stem().string()] = nlohmann::json::parse(stream);
    }
    return files;
}

TEST(NamedStyle, LibraryAndFilesAgree) {
    const auto files = styleFiles();
    const std::vector<std::string_view> names = styleNames();
    ASSERT_EQ(names.size(), files.size());
    EXPECT_GE(names.size(), 9U);
    EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
    for (const NamedStyle& named : namedStyles()) {
        const std::string name(named.name);
        ASSERT_TRUE(files.contains(name)) << name;
        const nlohmann::json& file = files.at(name);
        EXPECT_EQ(named.description, file.at("description").get<std::string>());
        EXPECT_EQ(styleNamed(name), named.style);
        // The scene reader knows units, words and ranges on its own: it is the judge of the generated table.
        EXPECT_EQ(styleIn(sceneOf("declared", "{\"declared\": " + file.at("style").dump() + "}")), named.style) << name;
    }
}

TEST(NamedStyle, AllAreWithinTheTablesRanges) {
    for (const NamedStyle& named : namedStyles()) {
        EXPECT_FALSE(named.description.empty()) << named.name;
        EXPECT_LE(named.description.size(), 100U) << named.name;
        for (const StyleParameter& parameter : styleParameters()) {
            const double value = parameterValue(named.style, parameter);
            if (parameter.may_be_derived && value == kDerived) {
                continue;
            }
            EXPECT_GE(value, parameter.minimum - 1e-9) << named.name << ' ' << parameter.name;
            EXPECT_LE(value, parameter.maximum + 1e-9) << named.name << ' ' << parameter.name;
        }
    }
}

TEST(NamedStyle, TheDocumentsShowThem) {
    const auto textOf = [](const char* page) {
        std::ifstream stream(std::string(ELASTOON_SOURCE_DIR "/docs/") + page);
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    const std::string gallery = textOf("gallery.md"), scene = textOf("scene.md");
    for (const NamedStyle& named : namedStyles()) {
        std::string line(named.description);
        line[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
        EXPECT_NE(gallery.find("### " + std::string(named.name) + "\n" + line + ".\n"), std::string::npos)
            << named.name;
        EXPECT_NE(scene.find(std::string(named.name)), std::string::npos) << named.name;
    }
}

TEST(NamedStyle, NoTwoAreAlike) {
    const auto styles = namedStyles();
    for (std::size_t i = 0; i < styles.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_NE(styles[i].style, styles[j].style) << styles[i].name << ' ' << styles[j].name;
        }
    }
}

TEST(NamedStyle, ScenesUseThemUndeclaredAndTheirOwnComeFirst) {
    EXPECT_EQ(styleIn(sceneOf("jelly")), styleNamed("jelly"));
    EXPECT_NE(styleNamed("jelly"), Style{});
    EXPECT_EQ(styleIn(sceneOf("jelly", R"({"jelly": {"restitution": 0.123}})")).restitution, 0.123);
}

TEST(NamedStyle, UnknownNamesAreToldWithTheKnownOnes) {
    EXPECT_FALSE(styleNamed("").has_value());
    EXPECT_FALSE(styleNamed("Jelly").has_value());
    const auto scene = parseScene(sceneOf("jely", R"({"goo": {}})"), "s.json");
    ASSERT_FALSE(scene.ok());
    EXPECT_EQ(scene.error().where, "s.json: /bodies/0/style");
    for (const char* says : {"there is no style \"jely\"", "did you mean \"jelly\"", "known: goo, anvil, "}) {
        EXPECT_NE(scene.error().message.find(says), std::string::npos) << scene.error().message;
    }
}

} // namespace
} // namespace elastoon
