// Frames built in code: seeded, animated, any frame count. Each isolates a question; the table says which.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/result.h"

namespace strata {

struct ScenarioOptions {
    std::uint32_t width = 160, height = 90, samples = 1;
    std::uint32_t frames = 1;  ///< how many there will be: sets nothing but the animation's end
    std::uint64_t seed = 1;
};

/// A number that a scenario's frame exceeds, at its natural extent and at 96 x 54, as otherwise it does not pose its question.
struct Witness {
    std::string_view stage;    ///< empty: the witness is a feature of the frame, which counts 1
    std::string_view counted;  ///< the feature, or a counter of the stage's first technique that has it, at its defaults
    double more_than = 0;
    std::string_view setting = {};  ///< beside the defaults: "packing=rgb10"
    std::uint32_t samples = 1;      ///< per pixel
};

struct Scenario {
    std::string_view name, question;         ///< "three_cards", "what leaks through three near-opaque cards?"
    std::uint32_t width = 160, height = 90;  ///< natural extent
    Frame (*build)(std::uint32_t frame, const ScenarioOptions&);
    std::vector<Witness> witnesses;  ///< none: the frame is empty
};

std::span<const Scenario> scenarios();
/// Fails with the nearest known name.
Result<const Scenario*> find_scenario(std::string_view name);

}  // namespace strata
