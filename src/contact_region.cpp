// See contact_region.h.
#include "contact_region.h"

#include <algorithm>
#include <cmath>

namespace elastoon {

namespace {

double cross(const FlatPoint& o, const FlatPoint& a, const FlatPoint& b) {
    return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

/// The part of a convex region on the left of the line from a to b (Sutherland, Hodgman 1974).
std::vector<FlatPoint> clipped(const std::vector<FlatPoint>& region, const FlatPoint& a, const FlatPoint& b) {
    std::vector<FlatPoint> kept;
    const std::size_t sides = region.size() == 2 ? 1 : region.size();
    for (std::size_t i = 0; i < region.size(); ++i) {
        const FlatPoint& p = region[i];
        const FlatPoint& q = region[(i + 1) % region.size()];
        const double at_p = cross(a, b, p);
        const double at_q = cross(a, b, q);
        if (at_p >= 0.0) {
            kept.push_back(p);
        }
        if (i < sides && ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))) {
            const double share = at_p / (at_p - at_q);
            kept.emplace_back(p.first + share * (q.first - p.first), p.second + share * (q.second - p.second));
        }
    }
    return kept;
}

double distanceSquared(const FlatPoint& a, const FlatPoint& b) {
    const double x = a.first - b.first;
    const double y = a.second - b.second;
    return x * x + y * y;
}

FlatPoint nearestOnOutline(const std::vector<FlatPoint>& outline, const FlatPoint& to) {
    FlatPoint best = outline.front();
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const FlatPoint& p = outline[i];
        const FlatPoint& q = outline[(i + 1) % outline.size()];
        const double square = distanceSquared(p, q);
        const double along =
            (to.first - p.first) * (q.first - p.first) + (to.second - p.second) * (q.second - p.second);
        const double share = square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
        const FlatPoint candidate{p.first + share * (q.first - p.first), p.second + share * (q.second - p.second)};
        if (distanceSquared(candidate, to) < distanceSquared(best, to)) {
            best = candidate;
        }
    }
    return best;
}

/// Of two segments or points: where they cross, or the ends of their common part.
std::vector<FlatPoint> crossing(const std::vector<FlatPoint>& first, const std::vector<FlatPoint>& second) {
    if (first.size() == 1 || second.size() == 1) {
        return {first.size() == 1 ? first.front() : nearestOnOutline(first, second.front())};
    }
    const double at_begin = cross(first[0], first[1], second[0]);
    const double at_end = cross(first[0], first[1], second[1]);
    const double parallel =
        1e-9 * std::sqrt(distanceSquared(first[0], first[1]) * distanceSquared(second[0], second[1]));
    if (std::fabs(at_begin - at_end) > parallel) {
        const double share = std::clamp(at_begin / (at_begin - at_end), 0.0, 1.0);
        return {{second[0].first + share * (second[1].first - second[0].first),
                 second[0].second + share * (second[1].second - second[0].second)}};
    }
    return {nearestOnOutline(first, second[0]), nearestOnOutline(first, second[1])};
}

} // namespace

std::vector<FlatPoint> flatHull(std::vector<FlatPoint> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) {
        return points;
    }
    std::vector<FlatPoint> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const FlatPoint& point : points) {
            while (hull.size() >= begin + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0.0) {
                hull.pop_back();
            }
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

FlatPoint middleOf(const std::vector<FlatPoint>& points) {
    const std::vector<FlatPoint> hull = flatHull(points);
    double area = 0.0;
    FlatPoint sum{0.0, 0.0};
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
        const double part = cross(hull[0], hull[i], hull[i + 1]);
        area += part;
        sum.first += part * (hull[0].first + hull[i].first + hull[i + 1].first) / 3.0;
        sum.second += part * (hull[0].second + hull[i].second + hull[i + 1].second) / 3.0;
    }
    const auto [low, high] = std::minmax_element(points.begin(), points.end());
    if (area <= 1e-12 * distanceSquared(*low, *high)) {
        return {0.5 * (low->first + high->first), 0.5 * (low->second + high->second)};
    }
    return {sum.first / area, sum.second / area};
}

std::vector<FlatPoint> commonRegion(const std::vector<FlatPoint>& first, const std::vector<FlatPoint>& second) {
    const bool second_has_area = second.size() >= 3;
    const std::vector<FlatPoint>& window = second_has_area ? second : first;
    if (window.size() < 3) {
        return crossing(first, second);
    }
    std::vector<FlatPoint> shared = second_has_area ? first : second;
    for (std::size_t i = 0; i < window.size() && !shared.empty(); ++i) {
        shared = clipped(shared, window[i], window[(i + 1) % window.size()]);
    }
    return shared.empty() ? std::vector<FlatPoint>{nearestOnOutline(first, middleOf(second))} : shared;
}

bool isWithin(const std::vector<FlatPoint>& hull, const FlatPoint& point, double slack) {
    if (distanceSquared(nearestOnOutline(hull, point), point) <= slack * slack) {
        return true;
    }
    bool inside = hull.size() >= 3;
    for (std::size_t i = 0; i < hull.size(); ++i) {
        inside = inside && cross(hull[i], hull[(i + 1) % hull.size()], point) >= 0.0;
    }
    return inside;
}

} // namespace elastoon
