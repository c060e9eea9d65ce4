// The form of a body under a press: as flat, or as long, as what closes on it leaves room for. docs/contacts.md.
#pragma once

#include "elastoon/phase.h"

namespace elastoon {

struct Squeezed {
    Pose pose;
    bool fits = true;
};

/// Of a phase that something presses, where moving alone does not help: the form that fits and is nearest to its own;
/// where none fits, the one that is least deep.
[[nodiscard]] Squeezed squeezed(const Phase& phase, const Shape& shape, double t);
/// Whether what presses the body leaves it a form, if nothing else were there.
[[nodiscard]] bool fitsUnderPress(const Phase& phase, const Shape& shape, double t);

} // namespace elastoon
