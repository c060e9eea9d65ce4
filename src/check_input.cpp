// See check_input.h.
#include "check_input.h"

#include "path.h"

#include <cmath>
#include <cstdio>

namespace elastoon {

namespace {

std::optional<Error> checkRotation(const Quat& q, const char* what) {
    const double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (std::isfinite(square) && square > 1e-20) {
        return std::nullopt;
    }
    return Error{"must be a quaternion x y z w with finite numbers that are not all zero", what};
}

} // namespace

std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

std::optional<Error> checkVector(const Vec3& value, double most, const char* what) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::fabs(value[axis]) <= most)) {
            return Error{"must be three finite numbers within +-" + shortNumber(most) + ", has " +
                             shortNumber(value[axis]),
                         what};
        }
    }
    return std::nullopt;
}

std::optional<Error> checkStyle(const Style& style) {
    for (const StyleParameter& parameter : styleParameters()) {
        const double value = parameterValue(style, parameter);
        if (parameter.may_be_derived && value == kDerived) {
            continue;
        }
        // A value that was converted to the field's unit and back may miss its bound by rounding.
        const double slack = 1e-12 * std::fabs(parameter.maximum);
        if (!(value >= parameter.minimum - slack && value <= parameter.maximum + slack)) {
            return Error{"must be from " + shortNumber(parameter.minimum) + " to " + shortNumber(parameter.maximum) +
                             (parameter.unit.empty() ? "" : " " + std::string(parameter.unit)) + ", is " +
                             shortNumber(value),
                         "style." + std::string(parameter.name)};
        }
    }
    return std::nullopt;
}

std::optional<Error> checkBodyDef(const BodyDef& def) {
    if (!def.shape) {
        return Error{"a body needs a shape: make one with Shape::sphere() or its like", "shape"};
    }
    if (auto error = checkStyle(def.style)) {
        return error;
    }
    if (auto error = checkVector(def.position, kMostPosition, "position")) {
        return error;
    }
    if (auto error = checkVector(def.velocity, kMostSpeed, "velocity")) {
        return error;
    }
    return checkRotation(def.rotation, "rotation");
}

std::optional<Error> checkPlace(const Vec3& position, const Quat& rotation) {
    if (auto error = checkVector(position, kMostPosition, "position")) {
        return error;
    }
    return checkRotation(rotation, "rotation");
}

namespace {

/// Between two keys, or none of them and the start.
std::optional<Error> checkLeg(const PathKey& from, const PathKey& to, const std::string& where) {
    const MovingFrame leg = frameBetween(from.time, from.position, from.rotation, to.time, to.position, to.rotation);
    const double speed = glm::length(leg.velocity);
    const double spin = glm::length(leg.angular_velocity);
    if (speed <= kMostSpeed && spin <= kMostSpin) {
        return std::nullopt;
    }
    return Error{"is too far for so short a time: that would take " + shortNumber(speed) + " m/s and " +
                     shortNumber(spin) + " rad/s, and the most is 1e6 m/s and 1e4 rad/s",
                 where};
}

std::optional<Error> checkPath(const ObstacleDef& def) {
    const std::vector<PathKey>& path = def.path;
    const bool repeats = def.path_repeats;
    double last = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const std::string where = "path[" + std::to_string(i) + "]";
        if (!(path[i].time > last && path[i].time <= kMostStep)) {
            return Error{"must be above " + shortNumber(last) + " s (the key before it) and at most 1e6 s, is " +
                             shortNumber(path[i].time),
                         where + ".time"};
        }
        if (auto error = checkPlace(path[i].position, path[i].rotation)) {
            return Error{error->message, where + "." + error->where};
        }
        const PathKey start{0.0, def.position, def.rotation};
        if (auto error = checkLeg(i == 0 ? start : path[i - 1], path[i], where)) {
            return error;
        }
        last = path[i].time;
    }
    if (repeats && !path.empty() && last < kLeastLap) {
        return Error{"must take at least 0.001 s to repeat, takes " + shortNumber(last), "path"};
    }
    return std::nullopt;
}

} // namespace

std::optional<Error> checkObstacleDef(const ObstacleDef& def) {
    if (auto error = checkVector(def.position, kMostPosition, "position")) {
        return error;
    }
    if (auto error = checkVector(def.velocity, kMostSpeed, "velocity")) {
        return error;
    }
    if (auto error = checkVector(def.angular_velocity, kMostSpin, "angular_velocity")) {
        return error;
    }
    const double length = glm::length(def.normal);
    if (!(std::isfinite(length) && length > 1e-12)) {
        return Error{"must be three finite numbers that are not all zero", "normal"};
    }
    if (auto error = checkRotation(def.rotation, "rotation")) {
        return error;
    }
    return checkPath(def);
}

} // namespace elastoon
