#include "passes/lighting/mode_costs.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "passes/lighting/spectra.h"

namespace strata::lighting {

double weighted_cost(std::uint32_t features) {
    double cost = 1;
    for (std::uint32_t bit = 0; bit < light_feature_bits; ++bit)
        if ((features >> bit & 1) != 0) cost += example_weights[bit];
    return cost;
}

double occupancy_penalty(std::uint32_t waves, std::uint32_t reference, double power) {
    return std::pow(std::max(1., double(reference) / double(std::max(1u, waves))), power);
}

ModeCost compiled_cost(const std::map<std::uint32_t, CompiledMode>& modes) {
    std::uint32_t reference = 1;
    for (const auto& [features, mode] : modes) reference = std::max(reference, mode.waves);
    std::map<std::uint32_t, double> known;
    for (const auto& [features, mode] : modes) known[features] = mode.cycles * occupancy_penalty(mode.waves, reference);
    return [known, completed = completed_cost(known)](std::uint32_t features) {
        const auto own = known.find(features);
        return own == known.end() ? completed(features) : own->second;
    };
}

ModeCost completed_cost(std::map<std::uint32_t, double> known) {
    assert(!known.empty());
    const auto [least, most] = std::ranges::minmax_element(known, {}, [](const auto& entry) { return entry.second; });
    const double cheapest = least->second, dearest = most->second;
    return [known = std::move(known), cheapest, dearest](std::uint32_t features) {
        double below = cheapest, above = dearest;
        for (const auto& [other, cost] : known) {
            if (serves(features, other)) below = std::max(below, cost);
            if (serves(other, features)) above = std::min(above, cost);
        }
        return (below + above) / 2;
    };
}

}  // namespace strata::lighting
