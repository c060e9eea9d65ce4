// See contact.h. Half-space support; the contact region is found among the vertices that tie for it.
#include "contact.h"

#include "rotation.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace elastoon {

namespace {

/// Vertices this close to the plane (share of the body's length) lie in the contact region.
constexpr double kFlatness = 1e-9;

using Point = std::pair<double, double>;

double cross(const Point& o, const Point& a, const Point& b) {
    return (a.first - o.first) * (b.second - o.second) - (a.second - o.second) * (b.first - o.first);
}

/// Convex hull of points in the plane, counter-clockwise (Andrew's monotone chain).
std::vector<Point> planarHull(std::vector<Point> points) {
    std::sort(points.begin(), points.end());
    std::vector<Point> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t begin = hull.size();
        for (const Point& point : points) {
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

/// Area centroid; of a region without area, the middle of its ends.
Point middleOf(const std::vector<Point>& points) {
    const std::vector<Point> hull = planarHull(points);
    double area = 0.0;
    Point sum{0.0, 0.0};
    for (std::size_t i = 1; i + 1 < hull.size(); ++i) {
        const double part = cross(hull[0], hull[i], hull[i + 1]);
        area += part;
        sum.first += part * (hull[0].first + hull[i].first + hull[i + 1].first) / 3.0;
        sum.second += part * (hull[0].second + hull[i].second + hull[i + 1].second) / 3.0;
    }
    const auto [low, high] = std::minmax_element(points.begin(), points.end());
    const double width = high->first - low->first;
    if (area <= 1e-12 * width * width) {
        return {0.5 * (low->first + high->first), 0.5 * (low->second + high->second)};
    }
    return {sum.first / area, sum.second / area};
}

} // namespace

double reachTowards(const Shape& shape, const Pose& pose, const Vec3& direction) {
    const Vec3 in_shape = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * direction);
    return glm::dot(in_shape, shape.vertices()[shape.supportVertex(in_shape)]);
}

double gapTo(const Surface& surface, const Shape& shape, const Pose& pose, double t) {
    const Vec3 normal = surface.normalAt(t);
    return glm::dot(normal, pose.position - surface.pointAt(t)) - reachTowards(shape, pose, -normal);
}

Vec3 contactPoint(const Shape& shape, const Pose& pose, const Vec3& normal) {
    const Vec3 down = scaleOf(pose.stretch) * (glm::conjugate(pose.orientation) * -normal);
    const auto vertices = shape.vertices();
    const double deepest = glm::dot(down, vertices[shape.supportVertex(down)]);
    std::vector<Vec3> region;
    for (const Vec3& vertex : vertices) {
        if (glm::dot(down, vertex) >= deepest - kFlatness * shape.length()) {
            region.push_back(worldFromShape(pose, vertex));
        }
    }
    if (region.size() == 1) {
        return region.front();
    }
    const Vec3 u = anyAcross(normal);
    const Vec3 v = glm::cross(normal, u);
    const Vec3 base = region.front();
    std::vector<Point> flat;
    flat.reserve(region.size());
    for (const Vec3& point : region) {
        flat.emplace_back(glm::dot(point - base, u), glm::dot(point - base, v));
    }
    const Point middle = middleOf(flat);
    return base + u * middle.first + v * middle.second;
}

} // namespace elastoon
