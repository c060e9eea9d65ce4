// What both methods for closest points share. See closest.h.
#include "closest.h"

#include "gjk.h"
#include "vclip.h"

#include <cmath>

namespace elastoon {

namespace {

double normOf(const Mat3& m) {
    return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

} // namespace

double sizeBound(const PosedShape& body) {
    return normOf(body.linear) * body.shape->boundingRadius();
}

double roundingScale(const PosedShape& a, const PosedShape& b) {
    return glm::length(a.position - b.position) + sizeBound(a) + sizeBound(b);
}

Closest closestPoints(const PosedShape& a, const PosedShape& b, ClosestSeed& seed, ClosestMethod method) {
    return method == ClosestMethod::Vclip ? vclipClosest(a, b, seed) : gjkClosest(a, b, seed);
}

} // namespace elastoon
