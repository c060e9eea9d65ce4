// The parts of World::step, in its order. docs/step.md tells them in the same words.
#pragma once

#include "closest.h"
#include "elastoon/world.h"
#include "flight.h"
#include "impact.h"
#include "large_array.h"
#include "obstacle_tree.h"
#include "path.h"
#include "watch.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace elastoon {

/// A style that many bodies have: those that are made one after another with the same share it.
class SharedStyle {
public:
    SharedStyle() {
        // Not the last one: a slot is made before its style is known.
        static const auto kUsual = std::make_shared<const Style>();
        style_ = kUsual;
    }
    SharedStyle(const Style& style) {
        thread_local std::shared_ptr<const Style> last;
        if (!last || !(*last == style)) {
            last = std::make_shared<const Style>(style);
        }
        style_ = last;
    }
    operator const Style&() const { return *style_; }
    const Style* operator->() const { return style_.get(); }

private:
    std::shared_ptr<const Style> style_;
};

struct ObstacleSlot;

/// A touch, and whose surface it is.
struct Met {
    double time = std::numeric_limits<double>::infinity();
    std::size_t obstacle = 0; ///< slot
    Surface surface;
};

/// Where a surface is in its obstacle's frame, as Surface has it.
struct Place {
    Vec3 point{0.0}, normal{0.0, 1.0, 0.0};
};

/// The next event of a body, looked up ahead of the step: it holds as long as the phase goes on and the surroundings
/// are of that version.
struct Plan {
    enum class Kind : std::uint8_t { Meet, FlyOn, EndSlide, EndImpact, PressLetGo, Wake };
    double looked_until = -std::numeric_limits<double>::infinity(); ///< nothing else happens until then
    double time = std::numeric_limits<double>::infinity();
    double window = 0.0; ///< the phase's time is looked at in windows of kAhead: which of them
    std::uint32_t version = 0; ///< of the surroundings
    std::uint32_t obstacle = 0; ///< of Meet: its slot
    Kind kind = Kind::Meet;
    bool on_solid = false; ///< of Meet: the surface has the obstacle's solid below it
    Boxed<Place> place; ///< of Meet with a solid: where the surface is

    [[nodiscard]] bool meets() const { return kind == Kind::Meet && time < std::numeric_limits<double>::infinity(); }
    /// What has been found to be met, in the obstacle's own frame, comes next. Of a plane it is the plane itself.
    void meet(const Met& met, const ObstacleSlot& obstacle);
};

struct BodySlot {
    std::uint32_t generation = 0;
    bool used = false;
    ShapePtr shape;
    SharedStyle style;
    Phase phase;
    Plan plan;
    std::uint64_t user_data = 0;
};

struct ObstacleSlot {
    std::uint32_t generation = 0;
    bool used = false;
    ShapePtr shape; ///< null for a plane
    Vec3 normal{0.0, 1.0, 0.0}; ///< of a plane, unit, in the frame
    MovingFrame frame;
    Path path; ///< without keys: none
    std::uint64_t user_data = 0;

    [[nodiscard]] bool isPlane() const { return shape == nullptr; }
    /// The surface that a plane shows.
    [[nodiscard]] Surface surface() const { return {frame, Vec3(0.0), normal, nullptr}; }
    [[nodiscard]] Watched watched() const { return {frame, normal, shape}; }
};

/// What bodies meet and what pulls them: all that the motion of one body reads besides itself.
struct Surroundings {
    static constexpr double kAhead = 0.5; ///< s, of what bodies look for
    Vec3 gravity{0.0};
    LargeArray<ObstacleSlot> obstacles;
    /// A plane as those that are near are told by: whether it stands, and where.
    struct Plane {
        std::size_t slot;
        bool moves;
        Vec3 normal; ///< world
        double offset; ///< of the plane along its normal, m
    };
    std::vector<Plane> planes; ///< by slots, ascending
    std::vector<std::size_t> moving_planes; ///< slots, ascending
    std::vector<std::size_t> moving_solids; ///< slots, ascending
    std::vector<std::size_t> on_paths; ///< slots, ascending
    std::uint32_t version = 0; ///< counts the changes
    ObstacleTree solids; ///< boxes that hold now, and in a step through all of it and kAhead s more

    [[nodiscard]] bool anyMoves() const { return !moving_planes.empty() || !moving_solids.empty(); }
    /// To be called when an obstacle has come, goes, or moves otherwise; at time t.
    void include(std::size_t slot, double t);
    void exclude(std::size_t slot);
    /// The plane in this slot, after those before it.
    void addPlane(std::size_t slot);
    /// Grows the boxes of moving solids to where they will be within [from, to + kAhead].
    void prepareStep(double from, double to);
    /// Slots of the obstacles that a body may touch or come near to within [from, to], ascending: those near its way.
    void near(const Phase& phase, const Shape& shape, double from, double to, std::vector<std::size_t>& found) const;
};

/// What the plan, made in these surroundings, meets.
[[nodiscard]] Met metOf(const Plan& plan, const Surroundings& around);

/// What the motion of bodies leaves behind.
struct Happenings {
    std::vector<Event> events;
    std::vector<PhaseBegun> phases;
};

[[nodiscard]] inline BodyId idOfBody(std::size_t index, const BodySlot& slot) {
    return {static_cast<std::uint32_t>(index + 1), slot.generation};
}
[[nodiscard]] inline ObstacleId idOfObstacle(std::size_t index, const ObstacleSlot& slot) {
    return {static_cast<std::uint32_t>(index + 1), slot.generation};
}

/// A surface that a body was held by or has brushed, and whose it is.
struct Left {
    Surface surface;
    ObstacleId obstacle;
    bool parts = false; ///< the body is known to part from it
    double for_at_least = 0.0; ///< s
};

/// One body at one moment, and all that happens to it there: each of these ends its phase and begins the next.
/// Reads the surroundings and no other body; writes the body and `out`.
class Moment {
public:
    Moment(const Surroundings& around, BodySlot& body, BodyId id, double t, Happenings& out)
        : around_(around), body_(body), id_(id), t_(t), out_(out) {}

    /// Gives the body its next phase and notes it.
    void begin(Phase phase);
    /// Lets the body fly from this pose. It is kept clear for a while of the surfaces that it parts from; the others it
    /// meets again at once. Within `ease` s it comes from the pose's form to the flight's; 0: at once.
    void fly(const Pose& pose, const Vec3& velocity, Lead lead, std::span<const Left> lefts = {}, double ease = 0.0);
    /// It goes on flying with what it has, clear of what it has left but still reaches.
    void flyOn();
    /// It has touched the obstacle: an impact begins, or it goes on, clear of what it brushes while parting from it.
    void touch(const Met& met);
    /// In an impact, it has come near to another obstacle, which waits.
    void queue(const Met& met);
    /// The slide is over: it stands up where it stopped, goes on in a new direction, or leaves the edge.
    void endSlide();
    /// While it slides, it has touched another obstacle.
    void touchInSlide(const Met& met);
    /// The impact that it is in ends with this velocity (world).
    void steer(const Vec3& velocity);
    /// The impact is over: the next one that waits begins, or the body flies off, or rests.
    void endImpact();
    /// An obstacle has come upon it at rest: it is pressed against what it rests on, or meets it.
    void hitAtRest(const Met& met);
    /// What pressed it at rest does not touch it any more.
    void pressLetGo();
    /// What held it lets it go, or drops away; it goes on with the velocity that it had.
    void wake() { wake(held(), velocity()); }
    void wake(std::span<const Left> lefts) { wake(lefts, velocity()); }
    void wake(std::span<const Left> lefts, const Vec3& velocity);
    /// What pressed it at rest is gone at once: it comes back to its own form.
    void recover();
    /// It found no end of events here: it is put to rest where it is.
    void settle();

    /// What the body rests on, squashes against, waits for or is just leaving.
    [[nodiscard]] std::vector<Left> held() const;

private:
    [[nodiscard]] Pose pose() const { return poseAt(body_.phase, *body_.shape, t_); }
    [[nodiscard]] Vec3 velocity() const { return velocityAt(body_.phase, *body_.shape, t_); }
    void note(EventType type, ObstacleId other, const Surface& surface, double speed, const ImpactCurve& curve);
    bool beginImpactWith(const Met& met, const Pose& pose, const Vec3& velocity, std::vector<KeptClear> waiting);
    [[nodiscard]] Touching touchingOf(const Met& met, const Pose& pose, const Vec3& velocity,
                                      std::span<const KeptClear> waiting) const;
    bool beginSlideOn(const Met& met, const Pose& pose, const Vec3& velocity, bool goes_on,
                      std::span<const KeptClear> waiting);
    void blend(Phase& phase) const;
    bool meetNextWaiting(const Impact& impact);
    void restOn(const Impact& impact, const std::vector<KeptClear>& pressing);
    [[nodiscard]] std::vector<KeptClear> pressingOn(const Surface& surface) const;
    [[nodiscard]] double leastPartingSpeed(const Surface& surface) const;

    const Surroundings& around_;
    BodySlot& body_;
    BodyId id_;
    double t_;
    Happenings& out_;
};

/// Moves one body from time `from` to `to` through all its phases. Gives the time, not before `to`, before which
/// nothing else happens to it in these surroundings.
double advanceBody(const Surroundings& around, BodySlot& body, BodyId id, double from, double to, Happenings& out);

} // namespace elastoon
