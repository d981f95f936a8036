// What a tile costs that is shaded by a mode with certain feature bits (docs/algorithms/lighting.md 3.5): by a weight per bit,
// from times measured for some sets of bits, or from a compiler's statistics.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>

#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {

/// Cost of a tile by the mode's bits. Monotone, a superset costs at least as much, but for compiled_cost().
using ModeCost = std::function<double(std::uint32_t features)>;
/// Waves per SIMD that the mode compiled with these bits leaves room for.
using ModeWaves = std::function<std::uint32_t(std::uint32_t features)>;

/// By bit of light_features.shared.h, relative to a mode without any, which costs 1. Those of blockers, portals, shadows, soft
/// shadows, square spots, tubes, areas and projected textures are the example of docs/algorithms/lighting.md T3.2; the others are
/// guessed beside them by what they compute: a branch or two .05 or less, another lobe or two .2 to .35. Measure to know.
inline constexpr std::array<double, light_feature_bits> example_weights = {.30, .15, .25, .60, .10, .05, .05, .35,
                                                                           .50, .10, .02, .08, .20, .30, .25, .35};

/// 1 + the weights of the bits.
double weighted_cost(std::uint32_t features);

/// max(1, reference / waves)^power: fewer waves than a reference hide less latency. The exponent is the guess of
/// docs/algorithms/lighting.md 3.5.
double occupancy_penalty(std::uint32_t waves, std::uint32_t reference, double power = .5);

/// What a compiler says of a mode.
struct CompiledMode {
    double cycles = 0;        ///< that a tile takes, as it estimates them
    std::uint32_t waves = 0;  ///< per SIMD
};
/// Cycles times the penalty against the most waves that any of the modes has; of other modes completed like measured costs. Not
/// monotone: a compiler may find more waves for a superset, and that is no noise.
ModeCost compiled_cost(const std::map<std::uint32_t, CompiledMode>& modes);

/// A monotone cost for every set of bits from those known for some: half way between the most that any known subset costs and the
/// least that any known superset does, the set itself being both. Where the known costs are monotone already that is the known
/// cost; where noise turned two around, both get the middle. Beyond what is known, the least and the most of all stand in.
ModeCost completed_cost(std::map<std::uint32_t, double> known);

}  // namespace strata::lighting
