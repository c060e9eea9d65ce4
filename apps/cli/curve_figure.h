// The paper's figure 4: stretch through an impact, a sine down to the deepest squash and a cosine up from it.
#pragma once

#include "elastoon/model.h"
#include "elastoon/result.h"

#include <string>

namespace elastoon {

/// An impact and what it comes from: length 1, restitution 0.5, s_max 2, s_min 0.5, k_str 0.1, k_sq 1, the paper's
/// squash law, met at 14.007 m/s, which is a fall of 10 m.
struct CurveExample {
    Style style;
    ImpactInput input;
    ImpactCurve curve;
};
[[nodiscard]] CurveExample curveExample();

/// Draws it; the file's ending says the kind: .png, .svg or .pdf.
Status writeCurveFigure(const std::string& path);

} // namespace elastoon
