// Frames built in code: seeded, animated, any frame count. Each isolates a question; the table says which.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "capture_format/frame/frame.h"
#include "capture_format/result.h"

namespace strata {

struct ScenarioOptions {
    std::uint32_t width = 160, height = 90, samples = 1;
    std::uint32_t frames = 1;  ///< how many there will be: sets nothing but the animation's end
    std::uint64_t seed = 1;
};

struct Scenario {
    std::string_view name, question;         ///< "three_cards", "what leaks through three near-opaque cards?"
    std::uint32_t width = 160, height = 90;  ///< natural extent
    Frame (*build)(std::uint32_t frame, const ScenarioOptions&);
};

std::span<const Scenario> scenarios();
/// Fails with the nearest known name.
Result<const Scenario*> find_scenario(std::string_view name);

}  // namespace strata
