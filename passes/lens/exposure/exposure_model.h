// Exposure in double, from docs/algorithms/deferred.md 8.5.
#pragma once

#include <optional>

#include "passes/lens/lens_params.h"

namespace strata {

struct Frame;           // capture_format/frame.h
struct ReferenceImage;  // passes/reference/image.h
struct StageInput;      // passes/stage_input.h

}  // namespace strata

namespace strata::lens {

/// What the curve asks for at a mean luminance; 1/128 to 20.
double exposure_target(double luminance, double amount, double gray);
/// The share of the way to the target after `seconds`.
double exponential_share(double seconds, double speed);
double xray_share(double share_before, double seconds, double speed);

/// Mean luminance of the samples that are numbers; `held` is the factor that X-Ray's picture was exposed by before. Nothing
/// where no sample is a number.
std::optional<double> measured_luminance(const Frame&, const ReferenceImage& color, std::uint32_t form, double held);

/// The frame's factor: StageInput::before has "color" and in "exposure" what held.comp says of earlier frames.
double exposure_model(const StageInput&, const LensParams&);

}  // namespace strata::lens
