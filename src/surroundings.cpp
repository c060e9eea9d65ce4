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
        addPlane(slot);
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

void Surroundings::addPlane(std::size_t slot) {
    const ObstacleSlot& obstacle = obstacles[slot];
    const Vec3 normal = obstacle.frame.orientation * obstacle.normal;
    const auto after = std::find_if(planes.begin(), planes.end(), [slot](const Plane& p) { return p.slot > slot; });
    planes.insert(after, {slot, obstacle.frame.moves(), normal, glm::dot(normal, obstacle.frame.origin)});
}

void Surroundings::exclude(std::size_t slot) {
    ++version;
    std::erase_if(planes, [slot](const Plane& plane) { return plane.slot == slot; });
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
    const std::size_t solid_count = found.size();
    const Vec3 middle = 0.5 * (box.low + box.high);
    const Vec3 half = 0.5 * (box.high - box.low);
    for (const Plane& plane : planes) {
        const bool reached = glm::dot(plane.normal, middle) - plane.offset <= glm::dot(glm::abs(plane.normal), half);
        if (reached || plane.moves) {
            found.push_back(plane.slot);
        }
    }
    if (solid_count > 0 && found.size() > solid_count) {
        std::sort(found.begin(), found.end());
    }
}

} // namespace elastoon
