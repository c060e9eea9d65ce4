// How a body at rest turns under a press where no form along its own axis fits. docs/contacts.md.
#pragma once

#include "elastoon/phase.h"

#include <optional>

namespace elastoon {

/// By which factors a body's own stretch may change.
struct StretchRange {
    double least = 1.0, most = 1.0;
};

struct PressTurn {
    double angle = 0.0; ///< rad, from its own axis; 0: it need not turn
    double factor = 1.0; ///< of its own stretch
    Pose pose;
    bool fits = false;
};

/// The least turn that makes room, its axis towards the press's direction or away from it, with the factor that makes
/// most of it. Where even that is too little, the turn that enters least; none where no turn helps.
[[nodiscard]] std::optional<PressTurn> turnUnderPress(const Phase& phase, const Shape& shape, double t,
                                                      const StretchRange& range);

} // namespace elastoon
