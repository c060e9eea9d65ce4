// Flat convex regions (polygons, segments, points) in a plane: their middle, and what two of them share.
#pragma once

#include <utility>
#include <vector>

namespace elastoon {

/// Coordinates in the plane.
using FlatPoint = std::pair<double, double>;

/// Convex hull, counter-clockwise (Andrew's monotone chain): a polygon, two ends, or one point.
[[nodiscard]] std::vector<FlatPoint> flatHull(std::vector<FlatPoint> points);

/// Area centroid; of a region without area, the middle of its ends.
[[nodiscard]] FlatPoint middleOf(const std::vector<FlatPoint>& points);

/// What two hulls share. Where rounding keeps them apart, the point of the first that is nearest to the second's
/// middle.
[[nodiscard]] std::vector<FlatPoint> commonRegion(const std::vector<FlatPoint>& first,
                                                  const std::vector<FlatPoint>& second);

/// Whether the point is in the hull, or at most `slack` outside it.
[[nodiscard]] bool isWithin(const std::vector<FlatPoint>& hull, const FlatPoint& point, double slack);

} // namespace elastoon
