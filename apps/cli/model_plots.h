// The plots of docs/model.md, drawn from the library's own functions so that they cannot say something else.
#pragma once

#include "elastoon/result.h"

#include <string>

namespace elastoon {

/// Writes model_stretch.svg, model_squash.svg, model_contact_time.svg, model_apex.svg and model_turn.svg.
Status writeModelPlots(const std::string& folder);

} // namespace elastoon
