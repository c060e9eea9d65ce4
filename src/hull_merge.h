// Triangles of a hull that lie on one plane become one polygon: the second half of convexHull(). docs/hull.md.
#pragma once

#include "quickhull.h"

#include <vector>

namespace elastoon {

/// Loops of corners, counter-clockwise from outside.
struct HullFaces {
    std::vector<std::vector<int>> loops;
    std::vector<int> loop_of; ///< by triangle: the loop around it
    std::vector<int> uses;    ///< by point: how many loops it is a corner of
};

/// Groups triangles whose corners are within `play` of a plane. Every loop is simple: a group grows only in ways that
/// keep it a disk.
[[nodiscard]] HullFaces facesOf(const PointSet& set, const std::vector<Triangle>& triangles, double play);

/// Cuts the loops that bend inwards by more than `play` back into their triangles, which cannot.
void cutHollowFaces(const PointSet& set, const std::vector<Triangle>& triangles, double play, HullFaces& faces);

/// The points that the hull needs, ascending: corners of three faces or more (others lie on straight edges or within a
/// face), and of two corners within `play` of each other only the first.
[[nodiscard]] std::vector<int> neededCorners(const PointSet& set, const HullFaces& faces, double play);

} // namespace elastoon
