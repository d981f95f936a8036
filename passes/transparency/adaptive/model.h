// The technique in double precision, from the paper and not from the shader.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/adaptive/adaptive.shared.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// Transmittance behind a depth.
struct CurveStep {
    double depth = 0;
    glm::dvec3 transmittance{1};
};
/// The compressed step curve of fragments in submission order.
std::vector<CurveStep> adaptive_curve(std::span<const Fragment>, std::uint32_t nodes);
/// T(z): of the last step in front of the depth.
glm::dvec3 transmittance_at(std::span<const CurveStep>, double depth);

ImageSet adaptive_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
