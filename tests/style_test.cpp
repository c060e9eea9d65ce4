// The parameter table: it holds every field, with the defaults of the struct.
#include "elastoon/style.h"

#include "step.h"
#include "test_support.h"

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace elastoon {
namespace {

TEST(Style, TableHoldsTheDefaultsOfTheStruct) {
    const Style style;
    for (const StyleParameter& parameter : styleParameters()) {
        EXPECT_NEAR(parameterValue(style, parameter), parameter.default_value, 1e-12) << parameter.name;
        EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
        EXPECT_LT(parameter.minimum, parameter.maximum) << parameter.name;
        EXPECT_EQ(parameter.number == nullptr, !parameter.choices.empty()) << parameter.name;
    }
}

TEST(Style, TheDocumentHoldsTheTable) {
    std::ifstream stream(std::string(ELASTOON_SOURCE_DIR) + "/docs/model.md");
    std::stringstream text;
    text << stream.rdbuf();
    for (const StyleParameter& p : styleParameters()) {
        std::ostringstream row;
        row << "| `" << p.name << "` | " << p.symbol << (p.symbol.empty() ? "| " : " | ") << p.unit
            << (p.unit.empty() ? "| " : " | ");
        if (p.choices.empty()) {
            row << p.minimum << " to " << p.maximum << " | ";
            p.default_value == kDerived ? row << "auto" : row << p.default_value;
        } else {
            row << p.choices[0] << ", " << p.choices[1] << " | "
                << p.choices[static_cast<std::size_t>(p.default_value)];
        }
        row << " | " << p.meaning << " |";
        EXPECT_NE(text.str().find(row.str()), std::string::npos) << "docs/model.md lacks: " << row.str();
    }
}

TEST(Style, EveryFieldHasARow) {
    // Setting every row to another value must change every byte-sized piece of meaning: the struct built by hand
    // agrees.
    Style through_table;
    for (const StyleParameter& parameter : styleParameters()) {
        setParameter(through_table, parameter, parameter.maximum);
        EXPECT_NEAR(parameterValue(through_table, parameter), parameter.maximum, 1e-9 * parameter.maximum);
    }
    Style by_hand{.restitution = 10,
                  .max_stretch = 100,
                  .min_squash = 1,
                  .stretch_rate = 1000,
                  .squash_rate = 1000,
                  .squash_law = SquashLaw::Paper,
                  .impact_easing = ImpactEasing::Linear,
                  .reversal_rate = through_table.reversal_rate,
                  .rest_speed = 1e6,
                  .rest_slope = through_table.rest_slope,
                  .friction = 100,
                  .grazing_angle = through_table.grazing_angle,
                  .corner_rule = CornerRule::Blended};
    EXPECT_EQ(through_table, by_hand);
    EXPECT_NEAR(through_table.rest_slope, 1.5707963267948966, 1e-12);
}

TEST(Style, BodiesMadeOneAfterAnotherShareOne) {
    Style style;
    style.restitution = 0.25;
    std::vector<BodySlot> slots;
    for (int i = 0; i < 3; ++i) {
        slots.emplace_back();
        slots.back().style = style;
    }
    EXPECT_EQ(slots[0].style.operator->(), slots[2].style.operator->());
    EXPECT_EQ(slots[0].style->restitution, 0.25);
    slots[1].style = Style{};
    EXPECT_EQ(slots[1].style->restitution, Style{}.restitution);
    EXPECT_EQ(slots[2].style->restitution, 0.25);
}

} // namespace
} // namespace elastoon
