// Contact sheets: cells of one size in a grid, each the picture of its moment.
#include "sheet.h"

#include "test_support.h"

#include <cairo.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <memory>

namespace elastoon {
namespace {

constexpr const char* kScene =
    R"({ "elastoon": 1, "duration": 2, "shapes": { "ball": {"type": "sphere", "radius": 0.5} },
  "bodies": [ {"shape": "ball", "style": "jelly", "position": [0, 2, 0], "velocity": [1, 0, 0], "color": "#ff0000"} ],
  "obstacles": [ {"type": "plane", "normal": [0, 1, 0]} ],
  "camera": { "eye": [1, 1, 9], "target": [1, 1, 0], "fov": 30 } })";

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

struct Stage {
    Stage() : scene(valueOf(parseScene(kScene))), staged(valueOf(stage(scene))) {
        timeline.begin(staged.world);
        for (int i = 0; i < 60; ++i) {
            staged.world.step(1.0 / 30.0);
            timeline.capture(staged.world);
        }
    }
    /// The sheet, read back from its file.
    [[nodiscard]] Surface sheet(const SheetOptions& options) const {
        const std::string path =
            (std::filesystem::temp_directory_path() / ("elastoon-sheet-" + std::to_string(getpid()) + ".png")).string();
        EXPECT_TRUE(renderSheet(scene, timeline, options, path).ok());
        Surface surface(cairo_image_surface_create_from_png(path.c_str()), &cairo_surface_destroy);
        std::filesystem::remove(path);
        return surface;
    }

    Scene scene;
    StagedScene staged;
    Timeline timeline;
};

SheetOptions options(int columns, int rows, std::vector<double> times) {
    SheetOptions made;
    made.size = {200, 120};
    made.samples = 4;
    made.columns = columns;
    made.rows = rows;
    made.times = std::move(times);
    return made;
}

std::array<int, 3> rgbAt(const Surface& surface, int x, int y) {
    const unsigned char* at =
        cairo_image_surface_get_data(surface.get()) + y * cairo_image_surface_get_stride(surface.get()) + 4 * x;
    return {at[2], at[1], at[0]};
}

/// Pixels of a cell that are as red as the ball.
int redIn(const Surface& surface, const SheetOptions& made, int column, int row) {
    const PictureSize cell = cellSize(made);
    int count = 0;
    for (int y = 0; y < cell.height; ++y) {
        for (int x = 0; x < cell.width; ++x) {
            const auto rgb = rgbAt(surface, 2 + column * (cell.width + 2) + x, 2 + row * (cell.height + 2) + y);
            count += rgb[0] > rgb[1] + 40 ? 1 : 0;
        }
    }
    return count;
}

TEST(Sheet, CellsShareTheRoom) {
    for (const auto& [columns, rows] : {std::pair{1, 1}, {4, 3}, {9, 2}}) {
        const SheetOptions made = options(columns, rows, {});
        const PictureSize cell = cellSize(made);
        EXPECT_LE(columns * cell.width + 2 * (columns + 1), made.size.width);
        EXPECT_GT(columns * (cell.width + 1) + 2 * (columns + 1), made.size.width);
        EXPECT_LE(rows * cell.height + 2 * (rows + 1), made.size.height);
    }
}

TEST(Sheet, EachCellShowsItsMomentAndTheRestStayEmpty) {
    const Stage stage;
    const SheetOptions made = options(2, 2, {0.0, 0.7, 1.4});
    const Surface surface = stage.sheet(made);
    ASSERT_EQ(cairo_image_surface_get_width(surface.get()), 200);
    ASSERT_EQ(cairo_image_surface_get_height(surface.get()), 120);
    for (int i = 0; i < 3; ++i) {
        EXPECT_GT(redIn(surface, made, i % 2, i / 2), 20) << i;
    }
    EXPECT_EQ(redIn(surface, made, 1, 1), 0);
    EXPECT_EQ(rgbAt(surface, 150, 90), rgbAt(surface, 1, 1)) << "paper";
}

TEST(Sheet, GhostsAddPaleRed) {
    const Stage stage;
    SheetOptions made = options(1, 1, {0.6});
    const Surface plain = stage.sheet(made);
    made.ghosts = 3;
    made.ghost_every = 0.15;
    const Surface with = stage.sheet(made);
    int changed = 0;
    for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 200; ++x) {
            changed += rgbAt(plain, x, y) != rgbAt(with, x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(changed, 200);
}

TEST(Sheet, WithoutRoomOrMomentsItIsAnError) {
    const Stage stage;
    const std::string nowhere = "/dev/null/x.png";
    EXPECT_FALSE(renderSheet(stage.scene, stage.timeline, options(2, 2, {}), nowhere).ok());
    EXPECT_FALSE(renderSheet(stage.scene, stage.timeline, options(1, 1, {0.0, 1.0}), nowhere).ok());
    EXPECT_FALSE(renderSheet(stage.scene, stage.timeline, options(60, 1, {0.0}), nowhere).ok());
}

} // namespace
} // namespace elastoon
