// When a body that is kept clear of what is about it first finds no room to go on. docs/contacts.md.
#pragma once

#include "elastoon/phase.h"

namespace elastoon {

/// When the body of an impact that is kept clear of others first finds no room to go on; the phase's end if it does
/// not.
[[nodiscard]] double blockedAt(const Phase& phase, const Shape& shape);
/// Likewise of any phase but a flight, within [from, to]; `to` if it finds room until then.
[[nodiscard]] double blockedAt(const Phase& phase, const Shape& shape, double from, double to);

/// That an impact on a plane beside one other plane, both standing, finds room until `to`, and is never moved at once,
/// without a look: most are of that kind. False where that cannot be told.
[[nodiscard]] bool surelyHasRoom(const Phase& phase, const Shape& shape, double to);

} // namespace elastoon
