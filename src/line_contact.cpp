// Based on: Snethen, "XenoCollide: Complex Collision Made Simple", Game Programming Gems 7, 2008. A triangle of the
// bodies' difference that the line passes, the portal, is drawn outwards, until it lies in the face that the line
// leaves by. What rounding leaves open is left to GJK.
#include "line_contact.h"

#include "gjk.h"
#include "support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace elastoon {

namespace {

constexpr double kRounding = 0x1p-52;
/// Times the size: the last support is no further than the portal.
constexpr double kFlat = 8.0 * kRounding;
/// Times the size: so near is on the line.
constexpr double kOnLine = 8.0 * kRounding;
/// Times the size and the offset: a line that misses by less may also graze.
constexpr double kGrazing = 64.0 * kRounding;
/// A surface less inclined to the line is left to GJK too.
constexpr double kLeastSine = 1e-8;
constexpr int kMaxTurns = 16;
constexpr int kMaxSteps = 64;

/// A vertex of each body, from its own body's position.
struct Corner {
    std::uint32_t index_a = 0, index_b = 0;
    Vec3 a{0.0}, b{0.0};
    Vec3 at{0.0}; ///< their difference, from the line's point nearest the middle
};

/// Exact where the two share a vertex, and relative to the smaller body where they do not differ in the larger.
Vec3 wayBetween(const Corner& from, const Corner& to) {
    return (to.a - from.a) - (to.b - from.b);
}

class Portal {
public:
    Portal(const PosedShape& a, const PosedShape& b, const Vec3& direction)
        : a_(a), b_(b), line_(-direction), size_(sizeBound(a) + sizeBound(b)) {
        const Vec3 offset = a.position - b.position;
        along_ = glm::dot(line_, offset);
        base_ = line_ * along_ - offset;
        reach_ = size_ + glm::length(offset);
    }

    PortalEnd run(LineContact& contact);

private:
    enum class Search : std::uint8_t { Goes, Found, Misses, Unsure };

    void takeSupport(const Vec3& direction, Corner& corner);
    [[nodiscard]] Vec3 across(const Vec3& v) const { return v - line_ * glm::dot(line_, v); }
    /// Twice the area that the line's point and the two corners span, seen along the line.
    [[nodiscard]] double turn(const Corner& p, const Corner& q) const {
        return glm::dot(line_, glm::cross(p.at, wayBetween(p, q)));
    }
    Search takeBeyond(const Vec3& side, const Vec3& up, Corner& corner);
    Search discover();
    Search surround();
    Search refine();
    [[nodiscard]] bool isCorner(const Corner& corner) const;
    [[nodiscard]] Vec3 normalOf(bool exactly) const;
    Search replaceOne(const std::array<Vec3, 3>& ways);
    [[nodiscard]] bool holdsLine() const;

    const PosedShape& a_;
    const PosedShape& b_;
    Vec3 line_; ///< unit; the way that the line leaves the difference
    double size_;
    double along_ = 0.0;
    Vec3 base_{0.0};
    double reach_ = 0.0;
    std::array<Corner, 3> corners_{};
    Corner last_;
    Vec3 normal_{0.0}; ///< that the last support was taken in
};

void Portal::takeSupport(const Vec3& direction, Corner& corner) {
    const Vec3 in_a = direction * a_.linear;
    const Vec3 in_b = -(direction * b_.linear);
    corner.index_a = static_cast<std::uint32_t>(supportOf(*a_.shape, in_a));
    corner.index_b = static_cast<std::uint32_t>(supportOf(*b_.shape, in_b));
    corner.a = a_.linear * a_.shape->vertices()[corner.index_a];
    corner.b = b_.linear * b_.shape->vertices()[corner.index_b];
    corner.at = (corner.a - corner.b) - base_;
}

/// A corner on the far side of the line: if it can be, one that is also up.
Portal::Search Portal::takeBeyond(const Vec3& side, const Vec3& up, Corner& corner) {
    takeSupport(side + up, corner);
    if (glm::dot(side, corner.at) > 0.0) {
        return Search::Goes;
    }
    takeSupport(side, corner);
    const double beyond = glm::dot(side, corner.at);
    const double noise = kGrazing * reach_;
    if (beyond > 0.0 && beyond * beyond > noise * noise * glm::dot(side, side)) {
        return Search::Goes;
    }
    return beyond < 0.0 && beyond * beyond > noise * noise * glm::dot(side, side) ? Search::Misses : Search::Unsure;
}

/// The first two corners.
Portal::Search Portal::discover() {
    takeSupport(line_, corners_[0]);
    const Vec3 off = -across(corners_[0].at);
    const double squared = glm::dot(off, off);
    if (squared <= kOnLine * kOnLine * size_ * size_) {
        last_ = corners_[0];
        normal_ = line_;
        return Search::Found;
    }
    return takeBeyond(off, line_ * std::sqrt(squared), corners_[1]);
}

/// The third, by turning from side to side as GJK does in a plane.
Portal::Search Portal::surround() {
    for (int step = 0; step < kMaxTurns; ++step) {
        Vec3 edge = wayBetween(corners_[0], corners_[1]);
        Vec3 side = glm::cross(line_, edge);
        if (glm::dot(side, corners_[0].at) > 0.0) {
            std::swap(corners_[0], corners_[1]);
            side = -side;
            edge = -edge;
        }
        const double rise = glm::dot(line_, edge);
        const Vec3 flat = edge - line_ * rise;
        const double squared = glm::dot(flat, flat);
        const Vec3 up = (line_ * squared - flat * rise) / std::sqrt(squared + rise * rise);
        const Search search = takeBeyond(side, up, corners_[2]);
        if (search != Search::Goes) {
            return search;
        }
        if (turn(corners_[1], corners_[2]) < 0.0) {
            corners_[0] = corners_[2];
        } else if (turn(corners_[2], corners_[0]) < 0.0) {
            corners_[1] = corners_[2];
        } else {
            return Search::Goes;
        }
    }
    return Search::Unsure;
}

/// Puts the last support in the place of the corner that the line does not need. The ways lead to it.
Portal::Search Portal::replaceOne(const std::array<Vec3, 3>& ways) {
    const Vec3 side = glm::cross(line_, last_.at);
    if (glm::dot(side, side) <= kOnLine * kOnLine * size_ * size_) {
        return Search::Found;
    }
    std::array<double, 3> turns;
    for (std::size_t i = 0; i < 3; ++i) {
        turns[i] = -glm::dot(side, ways[i]);
    }
    std::size_t replaced = 3;
    double largest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (!(turns[i] >= 0.0 && turns[next] <= 0.0)) {
            continue;
        }
        // Where the line passes an edge there are two ways to go on, and one may be without area.
        const bool only = turns[i] > 0.0 && turns[next] < 0.0;
        const double area = only ? 0.0 : turns[i] - turns[next] + turn(corners_[i], corners_[next]);
        if (only || area > largest) {
            replaced = (i + 2) % 3;
            largest = area;
        }
    }
    if (replaced == 3) {
        return Search::Unsure;
    }
    corners_[replaced] = last_;
    return Search::Goes;
}

bool Portal::isCorner(const Corner& corner) const {
    return std::any_of(corners_.begin(), corners_.end(),
                       [&](const Corner& c) { return c.index_a == corner.index_a && c.index_b == corner.index_b; });
}

/// Across the portal, not unit. Of a thin one, the rounding that tilts it along its length does the harm: the exact
/// normal is made from the shorter sides and the longest.
Vec3 Portal::normalOf(bool exactly) const {
    std::array<Vec3, 3> sides; // opposite the corner
    for (std::size_t i = exactly ? 0 : 1; i < 3; ++i) {
        sides[i] = wayBetween(corners_[(i + 1) % 3], corners_[(i + 2) % 3]);
    }
    if (!exactly) {
        return glm::cross(sides[1], sides[2]);
    }
    std::size_t longest = 0;
    for (std::size_t i = 1; i < 3; ++i) {
        longest = glm::dot(sides[i], sides[i]) > glm::dot(sides[longest], sides[longest]) ? i : longest;
    }
    const Vec3 normal = glm::cross(sides[(longest + 1) % 3], sides[(longest + 2) % 3]);
    const Vec3& length = sides[longest];
    return normal - length * (glm::dot(normal, length) / glm::dot(length, length));
}

Portal::Search Portal::refine() {
    bool exactly = false;
    for (int step = 0; step < kMaxSteps; ++step) {
        normal_ = normalOf(exactly);
        if (!(glm::dot(normal_, line_) > 0.0)) {
            return Search::Unsure;
        }
        takeSupport(normal_, last_);
        std::array<Vec3, 3> ways;
        double rise = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            ways[i] = wayBetween(corners_[i], last_);
            rise = std::max(rise, glm::dot(normal_, ways[i]));
        }
        const double flat = kFlat * size_;
        if (rise * rise <= flat * flat * glm::dot(normal_, normal_)) {
            return holdsLine() ? Search::Found : Search::Unsure;
        }
        if (isCorner(last_)) {
            if (exactly) {
                return Search::Unsure;
            }
            exactly = true;
            continue;
        }
        const Search search = replaceOne(ways);
        if (search != Search::Goes) {
            return search;
        }
    }
    return Search::Unsure;
}

/// Whether a point of the portal is on the line but for rounding. Of a thin portal, the weights are corrected once by
/// how far off they lead.
bool Portal::holdsLine() const {
    std::array<double, 3> weights;
    for (std::size_t i = 0; i < 3; ++i) {
        weights[i] = std::max(0.0, turn(corners_[(i + 1) % 3], corners_[(i + 2) % 3]));
    }
    for (int pass = 0; pass < 2; ++pass) {
        const double sum = weights[0] + weights[1] + weights[2];
        const Vec3 off =
            across(weights[0] * corners_[0].at + weights[1] * corners_[1].at + weights[2] * corners_[2].at) / sum;
        if (glm::dot(off, off) <= kOnLine * kOnLine * size_ * size_) {
            return true;
        }
        const Vec3 lever = glm::cross(line_, off);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 opposite = wayBetween(corners_[(i + 1) % 3], corners_[(i + 2) % 3]);
            weights[i] = std::max(0.0, weights[i] + glm::dot(lever, opposite));
        }
    }
    return false;
}

PortalEnd Portal::run(LineContact& contact) {
    Search search = discover();
    if (search == Search::Goes) {
        search = surround();
    }
    if (search == Search::Goes) {
        search = refine();
    }
    if (search != Search::Found) {
        return search == Search::Misses ? PortalEnd::Misses : PortalEnd::Unsure;
    }
    const double length = glm::length(normal_);
    const double slope = glm::dot(normal_, line_);
    if (!(slope > kLeastSine * length)) {
        return PortalEnd::Unsure;
    }
    contact.shift = along_ + glm::dot(normal_, last_.at) / slope;
    contact.normal = normal_ / -length;
    return PortalEnd::Touches;
}

} // namespace

PortalEnd contactByPortal(const PosedShape& a, const PosedShape& b, const Vec3& direction, LineContact& contact) {
    return Portal(a, b, direction).run(contact);
}

std::optional<LineContact> contactAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction) {
    LineContact contact;
    switch (contactByPortal(a, b, direction, contact)) {
    case PortalEnd::Touches:
        return contact;
    case PortalEnd::Misses:
        return std::nullopt;
    default:
        return contactAlongByDistance(a, b, direction);
    }
}

std::optional<double> separationAlong(const PosedShape& a, const PosedShape& b, const Vec3& direction) {
    const auto contact = contactAlong(a, b, direction);
    return contact ? std::optional(contact->shift) : std::nullopt;
}

} // namespace elastoon
