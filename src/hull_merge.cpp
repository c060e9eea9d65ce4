// See hull_merge.h. That a group can always be completed one triangle at a time while it stays a disk: 2-balls are
// extendably shellable, Danaraj, Klee, "A representation of 2-dimensional pseudomanifolds", 1978.
#include "hull_merge.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace elastoon {

namespace {

constexpr int kNone = -1;

std::size_t asSize(int i) {
    return static_cast<std::size_t>(i);
}

class Grouping {
public:
    Grouping(const PointSet& set, const std::vector<Triangle>& triangles, double play)
        : set_(set),
          triangles_(triangles),
          play_(play),
          group_of_(triangles.size(), kNone),
          reached_(set.points.size(), kNone),
          following_(set.points.size(), kNone) {}
    HullFaces run();

private:
    [[nodiscard]] const Triangle& triangle(int index) const { return triangles_[asSize(index)]; }
    void take(int index, int group, std::vector<int>& members);
    [[nodiscard]] bool mayJoin(int index, int group) const;
    void grow(int seed, const OrientedPlane& plane, int group, std::vector<int>& members);
    [[nodiscard]] std::vector<int> loopOf(const std::vector<int>& members, int group);

    const PointSet& set_;
    const std::vector<Triangle>& triangles_;
    double play_;
    std::vector<int> group_of_;  ///< by triangle
    std::vector<int> reached_;   ///< by point: the last group that has it
    std::vector<int> following_; ///< by point: the next on the border of a group
};

void Grouping::take(int index, int group, std::vector<int>& members) {
    group_of_[asSize(index)] = group;
    for (const int corner : triangle(index).corners) {
        reached_[asSize(corner)] = group;
    }
    members.push_back(index);
}

/// The group with this triangle is still a disk: it joins by two edges, or by one and brings a new corner.
bool Grouping::mayJoin(int index, int group) const {
    const Triangle& candidate = triangle(index);
    int shared = 0;
    int brings = kNone;
    for (std::size_t edge = 0; edge < 3; ++edge) {
        if (group_of_[asSize(candidate.neighbors[edge])] == group) {
            ++shared;
            brings = candidate.corners[(edge + 2) % 3];
        }
    }
    return shared == 2 || (shared == 1 && reached_[asSize(brings)] != group);
}

void Grouping::grow(int seed, const OrientedPlane& plane, int group, std::vector<int>& members) {
    members.clear();
    take(seed, group, members);
    for (std::size_t next = 0; next < members.size(); ++next) {
        for (const int other : triangle(members[next]).neighbors) {
            if (group_of_[asSize(other)] != kNone || !mayJoin(other, group)) {
                continue;
            }
            const auto& corners = triangle(other).corners;
            const bool coplanar = std::all_of(corners.begin(), corners.end(), [&](int corner) {
                return std::fabs(plane.distance(set_.at(corner), 0.1 * play_)) <= play_;
            });
            if (coplanar) {
                take(other, group, members);
            }
        }
    }
}

std::vector<int> Grouping::loopOf(const std::vector<int>& members, int group) {
    int first = kNone;
    std::size_t count = 0;
    for (const int index : members) {
        const Triangle& member = triangle(index);
        for (std::size_t edge = 0; edge < 3; ++edge) {
            if (group_of_[asSize(member.neighbors[edge])] != group) {
                first = member.corners[edge];
                following_[asSize(first)] = member.corners[(edge + 1) % 3];
                ++count;
            }
        }
    }
    std::vector<int> loop;
    for (int corner = first; loop.size() < count; corner = following_[asSize(corner)]) {
        loop.push_back(corner);
    }
    return loop;
}

HullFaces Grouping::run() {
    // The largest triangles have the most trustworthy planes.
    std::vector<OrientedPlane> planes;
    planes.reserve(triangles_.size());
    for (const Triangle& each : triangles_) {
        planes.push_back(set_.planeOf(each));
    }
    std::vector<int> order(triangles_.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return planes[asSize(a)].length() > planes[asSize(b)].length(); });
    HullFaces faces;
    faces.uses.assign(set_.points.size(), 0);
    std::vector<int> members;
    for (const int seed : order) {
        if (group_of_[asSize(seed)] != kNone) {
            continue;
        }
        const int group = static_cast<int>(faces.loops.size());
        grow(seed, planes[asSize(seed)], group, members);
        faces.loops.push_back(loopOf(members, group));
        for (const int corner : faces.loops.back()) {
            ++faces.uses[asSize(corner)];
        }
    }
    faces.loop_of = std::move(group_of_);
    return faces;
}

/// Whether a corner of the loop lies deeper than `play` within the line of its neighbours.
bool isHollow(const PointSet& set, const std::vector<int>& loop, double play) {
    const std::size_t count = loop.size();
    const auto at = [&](std::size_t i) { return set.at(loop[i % count]) - set.at(loop[0]); };
    Vec3 normal(0.0);
    for (std::size_t i = 1; i + 1 < count; ++i) {
        normal += glm::cross(at(i), at(i + 1));
    }
    normal = glm::normalize(normal);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 before = at(i + 1) - at(i);
        const Vec3 after = at(i + 2) - at(i + 1);
        if (!(glm::dot(normal, glm::cross(before, after)) >= -play * glm::length(before + after))) {
            return true;
        }
    }
    return false;
}

} // namespace

HullFaces facesOf(const PointSet& set, const std::vector<Triangle>& triangles, double play) {
    return Grouping(set, triangles, play).run();
}

void cutHollowFaces(const PointSet& set, const std::vector<Triangle>& triangles, double play, HullFaces& faces) {
    std::vector<bool> hollow(faces.loops.size(), false);
    for (std::size_t i = 0; i < hollow.size(); ++i) {
        hollow[i] = faces.loops[i].size() > 3 && isHollow(set, faces.loops[i], play);
    }
    std::vector<bool> replaced(faces.loops.size(), false);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto loop = asSize(faces.loop_of[i]);
        if (loop >= hollow.size() || !hollow[loop]) {
            continue;
        }
        const auto& corners = triangles[i].corners;
        if (!replaced[loop]) {
            replaced[loop] = true;
            faces.loops[loop].assign(corners.begin(), corners.end());
        } else {
            faces.loops.emplace_back(corners.begin(), corners.end());
        }
    }
}

std::vector<int> neededCorners(const PointSet& set, const HullFaces& faces, double play) {
    std::vector<int> needed;
    std::size_t corners = 0;
    for (std::size_t i = 0; i < set.points.size(); ++i) {
        corners += faces.uses[i] > 0 ? 1 : 0;
        if (faces.uses[i] >= 3) {
            needed.push_back(static_cast<int>(i));
        }
    }
    // Not both at once: of two corners near each other, each could be left out because of the other.
    if (needed.size() < corners) {
        return needed;
    }
    std::vector<bool> needless(set.points.size(), false);
    for (const auto& loop : faces.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const auto [first, second] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
            if (!needless[asSize(first)] && glm::length(set.at(second) - set.at(first)) <= play) {
                needless[asSize(second)] = true;
            }
        }
    }
    needed.erase(std::remove_if(needed.begin(), needed.end(), [&](int corner) { return needless[asSize(corner)]; }),
                 needed.end());
    return needed;
}

} // namespace elastoon
