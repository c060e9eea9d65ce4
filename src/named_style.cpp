// The styles that come with the library. Their table is made from scenes/styles/*.json by scripts/style_table.cmake, so
// that files and library cannot disagree, and no JSON is read here. See style.h.
#include "elastoon/style.h"

#include <algorithm>
#include <array>

namespace elastoon {

namespace {

/// A parameter as the file gives it: a number in the file's unit, or a word.
struct Given {
    std::string_view parameter;
    double number;
    std::string_view word;
};

struct Row {
    std::string_view name;
    std::string_view description;
    std::array<Given, 10> given; ///< those that the file names; the rest are empty
};

constexpr auto kRows = std::to_array<Row>({
#include "style_table.inc"
});

double valueOf(const StyleParameter& parameter, const Given& given) {
    if (parameter.choices.empty()) {
        return given.word == "auto" ? kDerived : given.number;
    }
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), given.word);
    return static_cast<double>(found - parameter.choices.begin());
}

NamedStyle styleOf(const Row& row) {
    NamedStyle named{row.name, row.description, {}};
    for (const StyleParameter& parameter : styleParameters()) {
        for (const Given& given : row.given) {
            if (given.parameter == parameter.name) {
                setParameter(named.style, parameter, valueOf(parameter, given));
            }
        }
    }
    return named;
}

std::array<NamedStyle, kRows.size()> makeStyles() {
    std::array<NamedStyle, kRows.size()> styles;
    std::transform(kRows.begin(), kRows.end(), styles.begin(), styleOf);
    return styles;
}

} // namespace

std::span<const NamedStyle> namedStyles() {
    static const std::array<NamedStyle, kRows.size()> kStyles = makeStyles();
    return kStyles;
}

std::vector<std::string_view> styleNames() {
    std::vector<std::string_view> names;
    for (const NamedStyle& named : namedStyles()) {
        names.push_back(named.name);
    }
    return names;
}

std::optional<Style> styleNamed(std::string_view name) {
    for (const NamedStyle& named : namedStyles()) {
        if (named.name == name) {
            return named.style;
        }
    }
    return std::nullopt;
}

} // namespace elastoon
