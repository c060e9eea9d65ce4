// See gltf_motion.h.
#include "gltf_motion.h"

#include <algorithm>

namespace elastoon {

namespace {

struct Candidate {
    double time = 0.0; // s from the start
    bool event = false;
};

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

void addKey(MotionKeys& keys, double time, const Pose& pose) {
    Quat q = glm::normalize(pose.orientation);
    if (!keys.rotations.empty()) {
        const auto& before = keys.rotations.back();
        const double cosine = q.x * static_cast<double>(before[0]) + q.y * static_cast<double>(before[1]) +
                              q.z * static_cast<double>(before[2]) + q.w * static_cast<double>(before[3]);
        q = cosine < 0.0 ? -q : q;
    }
    keys.times.push_back(static_cast<float>(time));
    keys.translations.push_back(single(pose.position));
    keys.rotations.push_back(
        {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z), static_cast<float>(q.w)});
    keys.scales.push_back(single(scaleOf(pose.stretch)));
}

/// In order, one for each time that single precision can tell from its neighbours.
std::vector<double> merged(std::vector<Candidate> candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.time < b.time; });
    std::vector<Candidate> kept;
    for (const Candidate& candidate : candidates) {
        const bool same = !kept.empty() && static_cast<float>(kept.back().time) == static_cast<float>(candidate.time);
        if (!same) {
            kept.push_back(candidate);
        } else if (candidate.event && !kept.back().event) {
            kept.back() = candidate;
        }
    }
    std::vector<double> times;
    for (const Candidate& candidate : kept) {
        times.push_back(candidate.time);
    }
    return times;
}

std::vector<Candidate> frameCandidates(const MotionSpan& span) {
    std::vector<Candidate> candidates;
    for (const double time : span.frames) {
        candidates.push_back({time, false});
    }
    candidates.push_back({span.end - span.start, false});
    return candidates;
}

} // namespace

std::vector<double> keyTimes(const Track& track, const MotionSpan& span) {
    std::vector<Candidate> candidates = frameCandidates(span);
    const auto add = [&](double time) {
        if (time > span.start && time < span.end) {
            candidates.push_back({time - span.start, true});
        }
    };
    for (const Phase& phase : track.phases()) {
        add(phase.start);
        const auto* impact = phase.as<Impact>();
        if (impact == nullptr) {
            continue;
        }
        const double deepest = impact->begun + impact->curve.t_in;
        if (deepest > phase.start && deepest < phase.end) {
            add(deepest);
        }
        add(phase.end);
    }
    return merged(std::move(candidates));
}

MotionKeys motionOf(const Track& track, const MotionSpan& span) {
    MotionKeys keys;
    for (const double time : keyTimes(track, span)) {
        addKey(keys, time, track.poseAt(span.start + time));
    }
    return keys;
}

MotionKeys motionOf(const ObstacleDef& obstacle, const MotionSpan& span) {
    std::vector<Candidate> candidates = frameCandidates(span);
    const double lap = obstacle.path.empty() ? span.end : obstacle.path.back().time;
    for (double start = 0.0; start < span.end && !obstacle.path.empty(); start += lap) {
        for (const PathKey& key : obstacle.path) {
            const double time = start + key.time - span.start;
            if (time > 0.0 && time < span.end - span.start) {
                candidates.push_back({time, true});
            }
        }
        if (!obstacle.path_repeats) {
            break;
        }
    }
    MotionKeys keys;
    for (const double time : merged(std::move(candidates))) {
        const MovingFrame frame = frameAt(obstacle, 0.0, span.start + time);
        addKey(keys, time, {frame.originAt(span.start + time), frame.orientationAt(span.start + time), 1.0});
    }
    return keys;
}

} // namespace elastoon
