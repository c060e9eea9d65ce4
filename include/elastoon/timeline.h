// Everything that bodies did, kept as their chains of phases: any time can be asked for, exactly, forwards or back.
#pragma once

#include "elastoon/export.h"
#include "elastoon/phase.h"
#include "elastoon/world.h"

#include <vector>

namespace elastoon ELASTOON_API {

/// The motion of one body.
class Track {
public:
    Track(BodyId body, ShapePtr shape) : body_(body), shape_(std::move(shape)) {}

    [[nodiscard]] BodyId body() const { return body_; }
    [[nodiscard]] const ShapePtr& shape() const { return shape_; }
    /// In order of time; a phase ends where the next begins.
    [[nodiscard]] const std::vector<Phase>& phases() const { return phases_; }
    /// The phase that holds at t: of two that share it, the later. t before the first gives the first.
    [[nodiscard]] const Phase& phaseAt(double t) const;
    [[nodiscard]] Pose poseAt(double t) const;
    [[nodiscard]] Vec3 velocityAt(double t) const;

private:
    friend class Timeline;
    BodyId body_;
    ShapePtr shape_;
    std::vector<Phase> phases_;
    std::vector<std::size_t> captured_; ///< of each phase: the capture that brought it, from 1; 0: begin()
};

/// Fills itself from a world: begin() once, then capture() after each step.
class Timeline {
public:
    /// Takes the bodies that are in the world now.
    void begin(const World& world);
    /// Takes the phases and events of the last step; bodies added meanwhile get a track. (Of a body that was added and
    /// removed again before the step, nothing is kept.)
    void capture(const World& world);
    /// Forgets what came after that many captures: for a world that was restored to an earlier step and goes another
    /// way from there.
    void cut(std::size_t captures);

    /// Since begin().
    [[nodiscard]] std::size_t captures() const { return moments_.size(); }
    [[nodiscard]] const std::vector<Track>& tracks() const { return tracks_; }
    /// In order of time.
    [[nodiscard]] const std::vector<Event>& events() const { return events_; }
    [[nodiscard]] double start() const { return start_; }
    [[nodiscard]] double end() const { return end_; }

private:
    /// What there was after a capture.
    struct Moment {
        double time = 0.0;
        std::size_t events = 0;
    };

    Track* trackOf(const World& world, BodyId body);
    static void keep(Track& track, const Phase& phase, std::size_t capture);

    std::vector<Track> tracks_;
    std::vector<std::size_t> track_of_slot_; ///< index + 1 of the newest track of a slot; 0: none
    std::vector<Event> events_;
    std::vector<Moment> moments_;
    double start_ = 0.0, end_ = 0.0;
};

} // namespace elastoon ELASTOON_API
