// Based on: Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997:
// numbers as sums of doubles that do not overlap, smallest first. It needs exact rounding, so no contraction and no
// x87.
#include "orient.h"

#include <array>

namespace elastoon {

namespace {

/// The exact value high + low of a sum or a product.
struct Pair {
    double high, low;
};

Pair exactSum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    const double a_part = sum - b_part;
    return {sum, (a - a_part) + (b - b_part)};
}

/// Two halves of 26 bits, whose products are exact.
Pair halves(double a) {
    constexpr double kSplitter = 0x1p27 + 1.0;
    const double scaled = kSplitter * a;
    const double high = scaled - (scaled - a);
    return {high, a - high};
}

Pair exactProduct(double a, double b) {
    const double product = a * b;
    const Pair x = halves(a);
    const Pair y = halves(b);
    const double error = ((product - x.high * y.high) - x.low * y.high) - x.high * y.low;
    return {product, x.low * y.low - error};
}

/// A sum of at most N doubles, smallest first, without zeros.
template <std::size_t N>
struct Expansion {
    std::array<double, N> terms;
    std::size_t count = 0;

    void add(double term) {
        if (term != 0.0) {
            terms[count++] = term;
        }
    }
    [[nodiscard]] double value() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += terms[i];
        }
        return sum;
    }
};

/// Shewchuk's fast expansion sum.
template <std::size_t N, std::size_t M>
Expansion<N + M> sumOf(const Expansion<N>& e, const Expansion<M>& f) {
    Expansion<N + M> sum;
    std::size_t i = 0;
    std::size_t j = 0;
    const auto nextTerm = [&] {
        const bool from_e = j == f.count || (i < e.count && std::fabs(e.terms[i]) < std::fabs(f.terms[j]));
        return from_e ? e.terms[i++] : f.terms[j++];
    };
    if (e.count + f.count == 0) {
        return sum;
    }
    double carry = nextTerm();
    while (i < e.count || j < f.count) {
        const Pair next = exactSum(carry, nextTerm());
        sum.add(next.low);
        carry = next.high;
    }
    sum.add(carry);
    return sum;
}

/// Shewchuk's expansion scaling.
template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& e, double by) {
    Expansion<2 * N> product;
    if (e.count == 0) {
        return product;
    }
    Pair next = exactProduct(e.terms[0], by);
    product.add(next.low);
    double carry = next.high;
    for (std::size_t i = 1; i < e.count; ++i) {
        next = exactProduct(e.terms[i], by);
        const Pair low = exactSum(carry, next.low);
        product.add(low.low);
        const Pair high = exactSum(next.high, low.high);
        product.add(high.low);
        carry = high.high;
    }
    product.add(carry);
    return product;
}

template <std::size_t N>
Expansion<4 * N> productOf(const Expansion<N>& e, const Expansion<2>& f) {
    Expansion<2 * N> low;
    Expansion<2 * N> high;
    if (f.count > 0) {
        low = scaled(e, f.terms[0]);
    }
    if (f.count > 1) {
        high = scaled(e, f.terms[1]);
    }
    return sumOf(low, high);
}

Expansion<2> differenceOf(double a, double b) {
    const Pair exact = exactSum(a, -b);
    Expansion<2> difference;
    difference.add(exact.low);
    difference.add(exact.high);
    return difference;
}

template <std::size_t N>
Expansion<N> negated(Expansion<N> e) {
    for (std::size_t i = 0; i < e.count; ++i) {
        e.terms[i] = -e.terms[i];
    }
    return e;
}

using Difference = std::array<Expansion<2>, 3>;

Difference differenceOf(const Vec3& a, const Vec3& b) {
    return {differenceOf(a.x, b.x), differenceOf(a.y, b.y), differenceOf(a.z, b.z)};
}

/// One component of the cross product of two differences, times that component of a third.
Expansion<64> part(const Difference& u, const Difference& v, const Difference& w, std::size_t axis) {
    const std::size_t j = (axis + 1) % 3;
    const std::size_t k = (axis + 2) % 3;
    return productOf(sumOf(productOf(u[j], v[k]), negated(productOf(u[k], v[j]))), w[axis]);
}

} // namespace

double orientExactly(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Difference u = differenceOf(b, a);
    const Difference v = differenceOf(c, a);
    const Difference w = differenceOf(p, a);
    return sumOf(sumOf(part(u, v, w, 0), part(u, v, w, 1)), part(u, v, w, 2)).value();
}

OrientedPlane::OrientedPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& extent) : a_(a), b_(b), c_(c) {
    const Vec3 u = b - a;
    const Vec3 v = c - a;
    normal_ = glm::cross(u, v);
    length_ = glm::length(normal_);
    // Shewchuk's bound, (7 + 56 e) e times the determinant with all signs positive, e = 2^-53; for any p at once.
    const Vec3 m = glm::abs(u);
    const Vec3 n = glm::abs(v);
    const Vec3 magnitude(m.y * n.z + m.z * n.y, m.z * n.x + m.x * n.z, m.x * n.y + m.y * n.x);
    constexpr double kShare = 8.0 * 0x1p-53;
    error_bound_ = kShare * glm::dot(magnitude, extent);
}

} // namespace elastoon
