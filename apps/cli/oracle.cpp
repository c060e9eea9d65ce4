// See oracle.h.
#include "oracle.h"

#include "oracle_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace elastoon {

namespace {

Real dot(const RealVec& a, const RealVec& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

RealVec realOf(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// Rodrigues' formula.
RealVec turned(const RealVec& v, const RealVec& rate, Real seconds) {
    const Real speed = std::sqrt(dot(rate, rate));
    if (speed == 0) {
        return v;
    }
    const RealVec axis{rate[0] / speed, rate[1] / speed, rate[2] / speed};
    const Real c = std::cos(speed * seconds);
    const Real s = std::sin(speed * seconds);
    const Real along = dot(axis, v) * (1 - c);
    return {v[0] * c + (axis[1] * v[2] - axis[2] * v[1]) * s + axis[0] * along,
            v[1] * c + (axis[2] * v[0] - axis[0] * v[2]) * s + axis[1] * along,
            v[2] * c + (axis[0] * v[1] - axis[1] * v[0]) * s + axis[2] * along};
}

struct Plane {
    RealVec normal, point;
};

/// Where a plane of the scene is at time t, from its definition alone.
/// The leg of its path that an obstacle is on, as an obstacle of its own, and the time since that leg began.
std::pair<ObstacleDef, double> legAt(const ObstacleDef& def, double t) {
    if (def.path.empty()) {
        return {def, t};
    }
    const MovingFrame frame = frameAt(def, 0.0, t);
    ObstacleDef leg = def;
    leg.path.clear();
    leg.position = frame.origin;
    leg.rotation = frame.orientation;
    leg.velocity = frame.velocity;
    leg.angular_velocity = frame.angular_velocity;
    return {leg, t - frame.start};
}

Plane planeAt(const ObstacleDef& whole, double time) {
    const auto [def, t] = legAt(whole, time);
    const RealVec given = product(rotationOf(glm::normalize(def.rotation)), realOf(glm::normalize(def.normal)));
    const RealVec normal = turned(given, realOf(def.angular_velocity), t);
    const RealVec start = realOf(def.position);
    const RealVec velocity = realOf(def.velocity);
    return {normal, {start[0] + velocity[0] * t, start[1] + velocity[1] * t, start[2] + velocity[2] * t}};
}

class Inspector {
public:
    Inspector(const Scene& scene, const StagedScene& staged) : scene_(scene), staged_(staged) {}
    void lookAtTrack(const Track& track, const std::string& name, double from, double to, double fps);
    OracleReport report;

private:
    void lookAt(const Track& track, const std::string& name, const Phase& phase, double t);
    void lookAtChange(const Track& track, const std::string& name, const Phase& before, const Phase& after);
    static void note(Worst& worst, double value, double t, const std::string& body, const std::string& other);

    void lookAtObstacle(const Track& track, const std::string& name, const Phase& phase, double t, std::size_t index);
    [[nodiscard]] const SolidWitness& witnessOf(const ShapePtr& shape);

    const Scene& scene_;
    const StagedScene& staged_;
    std::vector<RealVec> posed_;
    Real nearest_ = 0; ///< obstacle's distance from posed_
    std::string nearest_name_;
    std::map<const Shape*, SolidWitness> witnesses_;
};

void Inspector::note(Worst& worst, double value, double t, const std::string& body, const std::string& other) {
    if (value > worst.value) {
        worst = {value, t, body, other};
    }
}

Real volumeOf(const Shape& shape, const std::vector<RealVec>& posed) {
    Real sum = 0;
    for (std::size_t i = 0; i < shape.faceCount(); ++i) {
        const auto face = shape.face(i);
        for (std::size_t j = 1; j + 1 < face.size(); ++j) {
            std::array<RealVec, 3> corner{posed[face[0]], posed[face[j]], posed[face[j + 1]]};
            for (auto& c : corner) {
                c = {c[0] - posed[0][0], c[1] - posed[0][1], c[2] - posed[0][2]};
            }
            const auto& [a, b, c] = corner;
            sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
    }
    return sum / 6;
}

void Inspector::lookAt(const Track& track, const std::string& name, const Phase& phase, double t) {
    const Shape& shape = *track.shape();
    const Pose pose = poseAt(phase, shape, t);
    ++report.poses;
    posed_ = posedVertices(shape, pose);
    Real sum = 0;
    for (const RealVec& point : posed_) {
        sum += point[0] + point[1] + point[2];
    }
    if (!std::isfinite(sum)) {
        ++report.not_finite;
        return;
    }
    const double volume = static_cast<double>(volumeOf(shape, posed_));
    note(report.volume_error, std::fabs(volume / shape.volume() - 1.0), t, name, "");
    // In a corner another obstacle may lift the body off the one that it met first.
    nearest_ = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < scene_.obstacles.size(); ++i) {
        lookAtObstacle(track, name, phase, t, i);
    }
    if (!phase.is<Flight>() && nearest_ < std::numeric_limits<Real>::infinity()) {
        note(report.gap, static_cast<double>(nearest_) / shape.length(), t, name, nearest_name_);
    }
}

const SolidWitness& Inspector::witnessOf(const ShapePtr& shape) {
    return witnesses_.try_emplace(shape.get(), *shape).first->second;
}

/// Where a solid of the scene has its vertices at time t, from its definition alone.
std::vector<RealVec> solidAt(const ObstacleDef& whole, double time) {
    const auto [def, t] = legAt(whole, time);
    std::vector<RealVec> vertices;
    const RealMat rotation = rotationOf(glm::normalize(def.rotation));
    for (const Vec3& vertex : def.shape->vertices()) {
        RealVec point = turned(product(rotation, realOf(vertex)), realOf(def.angular_velocity), t);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            point[axis] += realOf(def.position)[axis] + static_cast<Real>(realOf(def.velocity)[axis]) * t;
        }
        vertices.push_back(point);
    }
    return vertices;
}

void Inspector::lookAtObstacle(const Track& track, const std::string& name, const Phase& phase, double t,
                               std::size_t index) {
    const SceneObstacle& obstacle = scene_.obstacles[index];
    const double length = track.shape()->length();
    const bool held = !phase.is<Flight>() && phase.obstacle == staged_.obstacles[index];
    Real least = std::numeric_limits<Real>::infinity();
    if (obstacle.shape) {
        const std::vector<RealVec> solid = solidAt(obstacle.def, t);
        least = boxGap(posed_, solid);
        if (least <= OracleReport::kMostGap * length || held) {
            least = separationBySat({&witnessOf(track.shape()), posed_}, {&witnessOf(obstacle.def.shape), solid});
        }
        note(report.solid_depth, static_cast<double>(-least) / length, t, name, obstacle.name);
    } else {
        const Plane plane = planeAt(obstacle.def, t);
        for (const RealVec& point : posed_) {
            least = std::min(least, dot(plane.normal, {point[0] - plane.point[0], point[1] - plane.point[1],
                                                       point[2] - plane.point[2]}));
        }
        note(report.depth, static_cast<double>(-least) / length, t, name, obstacle.name);
    }
    if (least < nearest_) {
        nearest_ = least;
        nearest_name_ = obstacle.name;
    }
}

void Inspector::lookAtChange(const Track& track, const std::string& name, const Phase& before, const Phase& after) {
    const Shape& shape = *track.shape();
    const Pose a = poseAt(before, shape, after.start);
    const Pose b = poseAt(after, shape, after.start);
    const double moved = glm::length(a.position - b.position) / shape.length();
    const double stretched = std::fabs(a.stretch - b.stretch);
    const Quat turn = glm::conjugate(a.orientation) * b.orientation;
    const double rotated =
        2.0 * std::asin(std::min(1.0, std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z)));
    note(report.jump, std::max({moved, stretched, rotated}), after.start, name, "");
}

void Inspector::lookAtTrack(const Track& track, const std::string& name, double from, double to, double fps) {
    constexpr int kSamplesInImpact = 16;
    for (double k = 0.0; from + k / fps <= to; k += 1.0) {
        lookAt(track, name, track.phaseAt(from + k / fps), from + k / fps);
    }
    const std::vector<Phase>& phases = track.phases();
    for (std::size_t i = 0; i < phases.size(); ++i) {
        const double end = std::min(i + 1 < phases.size() ? phases[i + 1].start : to, to);
        lookAt(track, name, phases[i], phases[i].start);
        lookAt(track, name, phases[i], std::max(end, phases[i].start));
        if (phases[i].is<Impact>()) {
            for (int j = 1; j < kSamplesInImpact; ++j) {
                lookAt(track, name, phases[i], phases[i].start + (end - phases[i].start) * j / kSamplesInImpact);
            }
        }
        if (i > 0 && phases[i].start <= to) {
            lookAtChange(track, name, phases[i - 1], phases[i]);
        }
    }
}

} // namespace

OracleReport inspect(const Scene& scene, const StagedScene& staged, const Timeline& timeline, double fps) {
    Inspector inspector(scene, staged);
    for (const Track& track : timeline.tracks()) {
        const auto found = std::find(staged.bodies.begin(), staged.bodies.end(), track.body());
        const std::string name = found == staged.bodies.end()
                                     ? "body"
                                     : scene.bodies[static_cast<std::size_t>(found - staged.bodies.begin())].name;
        inspector.lookAtTrack(track, name, timeline.start(), timeline.end(), fps);
    }
    return inspector.report;
}

} // namespace elastoon
