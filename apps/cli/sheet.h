// A contact sheet: moments side by side in one picture, read from left to right and from top to bottom.
#pragma once

#include "render.h"

#include <string>
#include <vector>

namespace elastoon {

struct SheetOptions : PictureOptions { ///< size is the whole sheet's
    int columns = 4, rows = 3;
    std::vector<double> times;       ///< s, one for each cell; cells that are left over stay empty
    std::vector<std::string> labels; ///< in the cells' corners; may be fewer than times
    int ghosts = 0;                  ///< of the moments before, in each cell, pale
    double ghost_every = 1.0 / 30.0; ///< s between them
};

/// Least width and height of a cell that are worth drawing.
inline constexpr int kLeastCell = 16;

/// Size of each cell.
[[nodiscard]] PictureSize cellSize(const SheetOptions& options);

/// Draws it as a .png, with a progress bar. Without a camera in the scene, what the cells show is framed.
Result<Rendered> renderSheet(const Scene& scene, const Timeline& timeline, const SheetOptions& options,
                             const std::string& path);

} // namespace elastoon
