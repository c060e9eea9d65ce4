// Table 5: convex hulls of points on a sphere, against Qhull.
#include "hull.h"
#include "poses.h"
#include "tables.h"

#include <fmt/format.h>
#include <libqhull_r/qhull_ra.h>

#include <cmath>
#include <cstdio>

namespace elastoon {

namespace {

/// Number of vertices; 0 on failure. Qt makes triangles of what Qhull merges: a whole surface, as ours is.
int byQhull(std::vector<double>& coordinates) {
    qhT state;
    qhT* qh = &state;
    qh_zero(qh, stderr);
    char options[] = "qhull Qt Pp";
    const int count = static_cast<int>(coordinates.size() / 3);
    const bool fails = qh_new_qhull(qh, 3, count, coordinates.data(), False, options, nullptr, stderr) != 0;
    const int vertices = fails ? 0 : qh->num_vertices;
    qh_freeqhull(qh, !qh_ALL);
    int left = 0;
    int total = 0;
    qh_memfreeshort(qh, &left, &total);
    return vertices;
}

void runCell(int count, const Choice& choice, Report& report) {
    const std::string cell = fmt::format("hull sphere {}", count);
    if (!choice.wants(cell)) {
        return;
    }
    BenchRandom random(31);
    std::vector<Vec3> points;
    std::vector<double> coordinates;
    for (int i = 0; i < count; ++i) {
        const Vec3 point = random.direction();
        points.push_back(point);
        coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    }
    double ours = 0.0;
    double theirs = 0.0;
    const Job jobs[] = {{[&] {
                             const auto hull = convexHull(points);
                             ours = hull.ok() ? static_cast<double>(hull.value().vertices.size()) : 0.0;
                         },
                         1},
                        {[&] { theirs = byQhull(coordinates); }, 1}};
    const auto samples = interleave(jobs, choice.effort);
    const double ratio = medianRatio(samples[0], samples[1]);
    report.add({cell, 1e-6 * median(samples[0]), 1e-6 * median(samples[1]), ratio, ours, theirs});
    // Rounding leaves a few points of the sphere within the hull of the rest.
    report.errorAtMost(cell + ": vertices unlike Qhull's", std::fabs(ours - theirs), 0.001 * count);
    if (count == 100000) {
        report.expectAtMost(cell + ": over Qhull", ratio, 3.0);
    }
}

} // namespace

void runHullTable(const Choice& choice, Report& report) {
    report.begin({"5. Convex hull of points on a sphere (ms)",
                  {{"cell", "", 22},
                   {"Elastoon ms", "{:.1f}", 12},
                   {"Qhull ms", "{:.1f}", 10},
                   {"ratio", "{:.2f}", 8},
                   {"vertices", "{:.0f}", 10},
                   {"Qhull's", "{:.0f}", 10}},
                  {}});
    if (choice.effort.quick) {
        runCell(2000, choice, report);
        return;
    }
    runCell(10000, choice, report);
    runCell(100000, choice, report);
}

} // namespace elastoon
