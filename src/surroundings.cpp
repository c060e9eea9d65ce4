// Which obstacles a body may meet: planes always, solids by their boxes. See step.h.
#include "step.h"

#include "swept_box.h"

#include <algorithm>

namespace elastoon {

namespace {

void insertSorted(std::vector<std::size_t>& sorted, std::size_t value) {
    sorted.insert(std::lower_bound(sorted.begin(), sorted.end(), value), value);
}

} // namespace

void Surroundings::include(std::size_t slot, double t) {
    const ObstacleSlot& obstacle = obstacles[slot];
    exclude(slot);
    if (!obstacle.path.keys.empty()) {
        insertSorted(on_paths, slot);
    }
    if (obstacle.isPlane()) {
        insertSorted(planes, slot);
        if (obstacle.frame.moves()) {
            insertSorted(moving_planes, slot);
        }
        return;
    }
    solids.insert(slot, boxOf(*obstacle.shape, obstacle.frame, t));
    if (obstacle.frame.moves()) {
        insertSorted(moving_solids, slot);
    }
}

void Surroundings::exclude(std::size_t slot) {
    ++version;
    std::erase(planes, slot);
    std::erase(moving_planes, slot);
    std::erase(moving_solids, slot);
    std::erase(on_paths, slot);
    solids.remove(slot);
}

void Surroundings::prepareStep(double from, double to) {
    for (const std::size_t slot : moving_solids) {
        solids.update(slot, sweptBox(*obstacles[slot].shape, obstacles[slot].frame, from, to + kAhead));
    }
}

namespace {

/// Whether anything of the box is below the plane, which stands.
bool reaches(const Box& box, const ObstacleSlot& plane) {
    const Vec3 normal = plane.frame.orientation * plane.normal;
    const Vec3 lowest(normal.x > 0.0 ? box.low.x : box.high.x, normal.y > 0.0 ? box.low.y : box.high.y,
                      normal.z > 0.0 ? box.low.z : box.high.z);
    return glm::dot(normal, lowest - plane.frame.origin) <= 0.0;
}

} // namespace

void Surroundings::near(const Phase& phase, const Shape& shape, double from, double to,
                        std::vector<std::size_t>& found) const {
    found.clear();
    // Past all that counts as near.
    const double margin = 0.01 * shape.length();
    Box box = sweptBox(phase, shape, from, to);
    box = {box.low - margin, box.high + margin};
    if (solids.size() > 0) {
        solids.meeting(box, found);
    }
    const auto middle = static_cast<std::ptrdiff_t>(found.size());
    for (const std::size_t slot : planes) {
        if (obstacles[slot].frame.moves() || reaches(box, obstacles[slot])) {
            found.push_back(slot);
        }
    }
    std::inplace_merge(found.begin(), found.begin() + middle, found.end());
}

} // namespace elastoon
