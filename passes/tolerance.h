// The technique of a technique in double, and how far the device may be from it.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "passes/image_set.h"

namespace strata {

class Settings;     // passes/settings.h
struct StageInput;  // passes/stage_input.h

/// The technique on whole images: returns the stage's outputs.
using Model = ImageSet (*)(const StageInput&, const Settings&);

/// A frame on which the GPU may be farther from the model than on all others: without it the tolerance would hide bugs on those.
struct ToleranceException {
    std::string_view settings;  ///< as Settings::lines() join by spaces: "kind=power8"; empty: the defaults
    std::string_view scenario;
    double rmse = 0, worst = 0;
    std::string_view because;
};
/// Where a model comes from. `paper`: from the published formulas alone. `mirror`: where the technique is a bit pattern (a hash,
/// a code, a list made by tests in float) the model repeats the shader's, so a mistake in both goes unseen. A mirror has property
/// tests beside it, named in its README, that derive what they expect by other arithmetic.
enum class ModelKind : std::uint32_t { paper, mirror };
std::string_view name(ModelKind);

/// How far the GPU may be from the model, relative to max(|model|, its root mean square). An empty reason fails a test.
struct Tolerance {
    double rmse = 0, worst = 0;
    std::string_view because;
    std::span<const ToleranceException> exceptions = {};
};

/// The tolerance on a scenario, at settings as in ToleranceException.
Tolerance tolerance_at(const Tolerance&, std::string_view settings, std::string_view scenario);

}  // namespace strata
