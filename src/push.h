// The least shift that takes a body out of surfaces: for one that leaves them, and for one that squashes in a corner.
// docs/contacts.md.
#pragma once

#include "elastoon/phase.h"

#include <optional>
#include <span>

namespace elastoon {

/// Asks for a shift d with gap + d . way >= 0.
struct Barrier {
    Vec3 way{0.0}; ///< any length; zero: no shift helps
    double gap = 0.0;
};

/// The shortest such shift for all barriers; it changes continuously with them. None where there is none, or only one
/// longer than `most`. At most 16 barriers are looked at.
[[nodiscard]] std::optional<Vec3> leastPush(std::span<const Barrier> barriers, double most);

/// Where the phase's own motion puts the body, with its stretch times `factor` and, at rest alone, turned by `turn` (in
/// the surface's frame): not yet kept clear of anything. In an impact or at rest the body still touches the phase's
/// surface.
[[nodiscard]] Pose ownPose(const Phase& phase, const Shape& shape, double t, double factor = 1.0,
                           const Quat& turn = kNoRotation);

/// Takes the pose out of all surfaces that the phase is kept clear of by moving it. False if that cannot be done; the
/// pose is then somewhere on the way.
[[nodiscard]] bool moveClear(const Phase& phase, const Shape& shape, double t, Pose& pose);

/// A pose that is kept clear.
struct Fit {
    Pose pose;
    bool fits = true; ///< else there is no room for the body
    Vec3 shift{0.0}; ///< from where the phase's own motion puts it; of a body that no move helps, zero

    [[nodiscard]] double moved() const { return glm::length(shift); }
};

/// The phase's pose, moved (in an impact or at rest: along the surface) out of what it is to be kept clear of; where no
/// move helps, squashed or stretched until it fits.
[[nodiscard]] Fit fitted(const Phase& phase, const Shape& shape, double t);
[[nodiscard]] Pose keptClear(const Phase& phase, const Shape& shape, double t);

/// A push moves a body by at most twice its (stretched) radius, m.
[[nodiscard]] double longestPush(const Shape& shape, double stretch);

/// How much faster than the surfaces and the body's own motion the push can be, at time t: 0 without one.
[[nodiscard]] double pushGain(const Phase& phase, double t);

/// The surface that a phase is about; null in flight.
[[nodiscard]] const Surface* surfaceOf(const Phase& phase);

/// Whether something closes on the body from the other side at time t.
[[nodiscard]] bool isPressed(const Phase& phase, double t);

/// Whether the second surface leaves a body on the first nowhere to go but flat: their normals all but oppose.
[[nodiscard]] bool opposes(const Vec3& normal, const Vec3& other);

} // namespace elastoon
