// The closed-form phases that a body's motion is a chain of. Each is a small record; its pose is a pure function of
// time.
#pragma once

#include "elastoon/export.h"
#include "elastoon/ids.h"
#include "elastoon/math.h"
#include "elastoon/model.h"
#include "elastoon/shape.h"

#include <atomic>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace elastoon ELASTOON_API {

/// A rigid frame that moves with constant velocity and constant angular velocity.
struct MovingFrame {
    double start = 0.0; ///< time at which origin and orientation hold, s
    Vec3 origin{0.0};
    Quat orientation{kNoRotation};
    Vec3 velocity{0.0};         ///< of the origin, m/s
    Vec3 angular_velocity{0.0}; ///< world axes, rad/s

    [[nodiscard]] bool moves() const { return velocity != Vec3(0.0) || angular_velocity != Vec3(0.0); }
    [[nodiscard]] Vec3 originAt(double t) const { return origin + velocity * (t - start); }
    [[nodiscard]] Quat orientationAt(double t) const {
        return angular_velocity == Vec3(0.0) ? orientation : turnedAt(t);
    }
    /// Velocity at time t of the frame's material point that is at `point` (world).
    [[nodiscard]] Vec3 velocityAt(double t, const Vec3& point) const;
    [[nodiscard]] Vec3 worldFromFrame(double t, const Vec3& point) const {
        return originAt(t) + orientationAt(t) * point;
    }
    [[nodiscard]] Vec3 frameFromWorld(double t, const Vec3& point) const {
        return glm::conjugate(orientationAt(t)) * (point - originAt(t));
    }

private:
    [[nodiscard]] Quat turnedAt(double t) const;
};

/// A plane that is carried by a frame: what a body is in contact with. It refers to no obstacle, it is a thing of its
/// own.
struct Surface {
    MovingFrame frame;
    Vec3 point{0.0};           ///< on the plane, in the frame
    Vec3 normal{0.0, 1.0, 0.0}; ///< unit, towards the body, in the frame
    ShapePtr solid; ///< the convex solid below the plane, at home in the frame; null: all that is below it

    [[nodiscard]] Vec3 normalAt(double t) const { return frame.orientationAt(t) * normal; }
    [[nodiscard]] Vec3 pointAt(double t) const { return frame.worldFromFrame(t, point); }
};

/// Which way the axis is laid in flight. Chosen once, when the flight begins. Paper, section 3.2.
enum class AxisRule : std::uint8_t {
    Velocity, ///< along the velocity
    Reversal, ///< near-vertical throw: through the vertical at the apex, the forward end is swapped there
    Fixed, ///< nothing turns it: no speed and no gravity
};

/// A value kept apart, which its copies share until one of them is changed; where it is T{} it may take no room.
template <class T>
class Boxed {
public:
    Boxed() = default;
    Boxed(const T& value) : box_(new Box(value)) {}
    Boxed(const Boxed& other) noexcept : box_(other.box_) {
        if (box_ != nullptr) {
            box_->owners.fetch_add(1, std::memory_order_relaxed);
        }
    }
    Boxed(Boxed&& other) noexcept : box_(std::exchange(other.box_, nullptr)) {}
    Boxed& operator=(Boxed other) noexcept {
        std::swap(box_, other.box_);
        return *this;
    }
    ~Boxed() {
        if (box_ != nullptr && box_->owners.fetch_sub(1, std::memory_order_acq_rel) == 1) {
            delete box_;
        }
    }

    const T& operator*() const { return box_ != nullptr ? box_->value : kUsual; }
    const T* operator->() const { return &**this; }
    /// To be changed, apart from all copies: from here on it takes room, and what ** gave before is no longer this one.
    [[nodiscard]] T& edit() {
        if (box_ == nullptr || box_->owners.load(std::memory_order_acquire) != 1) {
            *this = Boxed(**this);
        }
        return box_->value;
    }
    /// It is T{}, and takes no room.
    [[nodiscard]] bool isUsual() const { return box_ == nullptr; }

private:
    struct Box {
        explicit Box(const T& given) : value(given) {}
        T value;
        std::atomic<std::uint32_t> owners{1};
    };
    static inline const T kUsual{};
    Box* box_ = nullptr;
};

/// A form that a phase begins with and that is not the one of its velocity: it fades within `span`, smoothly.
struct Ease {
    double span = 0.0; ///< s; 0: nothing to fade
    Vec3 axis{0.0, 0.0, 1.0}; ///< unit, world
    double angle = 0.0; ///< turn besides the velocity's, at the start, rad
    double stretch = 1.0; ///< at the start
    bool operator==(const Ease&) const = default;
};

/// Free flight under constant gravity; the stretch and the axis follow the velocity.
struct Flight {
    Vec3 position{0.0}; ///< at start
    Vec3 velocity{0.0}; ///< at start
    Vec3 gravity{0.0}; ///< one below 1e-12 m/s^2 is none
    Quat orientation{kNoRotation}; ///< while the heading is straight up; without gravity at all times
    Vec3 turn_axis{0.0, 0.0, -1.0}; ///< unit, up x (the velocity's direction across gravity)
    double climb = 0.0; ///< speed along `up` at start, m/s
    double pull = 0.0; ///< |gravity|, m/s^2
    double speed_across = 0.0; ///< v_h, m/s
    double reversal_speed = 0.0; ///< epsilon = |g| / reversal_rate, m/s
    double max_stretch = 1.0, stretch_rate = 0.0;
    AxisRule rule = AxisRule::Velocity;
    Vec3 up{0.0, 1.0, 0.0}; ///< against gravity
    Boxed<Ease> ease; ///< mostly none
};

/// Squash and stretch against a surface, turning about the contact. Lives in the frame of the surface.
struct Impact {
    double begun = 0.0; ///< time of the touch, the curve's zero
    Surface surface; ///< through the contact point
    Vec3 contact_in_shape{0.0}; ///< the material point that sticks
    Quat orientation{kNoRotation}; ///< at start, in the surface's frame
    Vec3 turn_axis{0.0, 0.0, 1.0}; ///< unit, in the surface's frame
    double turn_angle = 0.0; ///< whole turn, rad, >= 0
    double turn_from = 0.0; ///< share of the easing at which this turn began
    Vec3 skims{0.0}; ///< velocity of the contact along the surface, in its frame: zero where it sticks
    ImpactCurve curve;
    ImpactEasing easing = ImpactEasing::Smooth;
    Vec3 velocity_in{0.0}; ///< relative to the surface, in its frame
    Vec3 velocity_out{0.0}; ///< likewise
    bool comes_to_rest = false;
};

/// Sliding along a surface: constant acceleration, the axis along the way, stretched by the speed. docs/contacts.md.
struct Slide {
    double begun = 0.0; ///< time at which what follows holds
    Surface surface; ///< its frame does not turn
    Vec3 foot{0.0}; ///< of the centroid on the plane, in the frame; likewise all that follows
    Vec3 direction{1.0, 0.0, 0.0}; ///< unit, of the way
    Vec3 velocity{0.0};
    Vec3 acceleration{0.0};
    Quat orientation{kNoRotation}; ///< that goes with the direction
    double max_stretch = 1.0, stretch_rate = 0.0;
    Ease ease;
};

/// Still on a surface, carried by it.
struct Rest {
    Surface surface;
    Pose pose; ///< in the surface's frame
};

/// A plane, carried by a frame, that a body is moved clear of should it turn, lengthen or bulge into it: of an obstacle
/// that it leaves, or of one that waits for its turn while another is met. The move depends on time alone.
struct KeptClear {
    Surface surface; ///< without a solid: between the body and the obstacle
    ObstacleId obstacle;
    double since = 0.0; ///< when it was left, or come near to
    double until = std::numeric_limits<double>::infinity(); ///< inclusive
    bool presses = false; ///< it closes on the body from the other side, which flattens where nothing else helps
};

/// One phase of one body: immutable once made.
struct Phase {
    double start = 0.0;
    double end =
        std::numeric_limits<double>::infinity(); ///< its own end, as far as it is known; an event may come before
    ObstacleId obstacle; ///< that an impact, rest or slide is against, or that a flight has just left
    std::vector<KeptClear> clear_of; ///< a flight gives them up some time after it has left them all
    /// From here on a flight needs no move to be clear of `clear_of`: its pose is its own.
    double free_from = std::numeric_limits<double>::infinity();
    std::variant<Boxed<Flight>, Boxed<Impact>, Boxed<Rest>, Boxed<Slide>> motion;

    /// Flight, Impact, Rest or Slide: whether it is one, as one (null if it is not), as the one that it is, and as that
    /// to be changed: what the others gave before is then no longer this phase's.
    template <class T>
    [[nodiscard]] bool is() const {
        return std::holds_alternative<Boxed<T>>(motion);
    }
    template <class T>
    [[nodiscard]] const T* as() const& {
        const auto* boxed = std::get_if<Boxed<T>>(&motion);
        return boxed != nullptr ? &**boxed : nullptr;
    }
    template <class T>
    const T* as() const&& = delete; ///< the phase would be gone
    template <class T>
    [[nodiscard]] const T& get() const& {
        return *as<T>();
    }
    template <class T>
    [[nodiscard]] T& edit() {
        return std::get<Boxed<T>>(motion).edit();
    }
    template <class T>
    const T& get() const&& = delete;
};

/// flight, impact, rest or slide.
[[nodiscard]] std::string_view nameOf(const Phase& phase);

/// Pose of a body of this shape at time t of the phase; t is taken as start where it is before it.
[[nodiscard]] Pose poseAt(const Phase& phase, const Shape& shape, double t);

/// Velocity of the centroid at time t. In an impact it is the difference quotient of the closed form over 2
/// microseconds.
[[nodiscard]] Vec3 velocityAt(const Phase& phase, const Shape& shape, double t);

} // namespace elastoon ELASTOON_API
