#include "passes/lighting/tiled/modes.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "passes/lighting/mode_costs.h"
#include "passes/lighting/spectra.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

/// By number: whether it is the choice for one of the spectra.
std::vector<bool> chosen_modes(const std::vector<Mode>& modes, std::span<const std::uint32_t> spectra, std::uint32_t forced) {
    std::vector<bool> chosen(modes.size(), false);
    for (const std::uint32_t spectrum : spectra) chosen[choose(modes, spectrum | forced)] = true;
    return chosen;
}

}  // namespace

std::vector<std::uint32_t> mode_features(const TiledParams& p) {
    const std::array all = {p.mode_0, p.mode_1, p.mode_2,  p.mode_3,  p.mode_4,  p.mode_5,  p.mode_6,  p.mode_7,
                            p.mode_8, p.mode_9, p.mode_10, p.mode_11, p.mode_12, p.mode_13, p.mode_14, p.mode_15};
    std::vector<std::uint32_t> features(all.begin(), all.begin() + std::min<std::size_t>(p.modes, all.size()));
    if (p.branches == branches_uniform) features = {every_light_feature};
    if (std::ranges::count(features, every_light_feature) == 0) features.push_back(every_light_feature);
    assert(features.size() <= most_modes);
    return features;
}

ModeOrder mode_order(const TiledParams& params, std::span<const std::uint32_t> spectra) {
    std::vector<Mode> modes;
    for (const std::uint32_t features : mode_features(params)) modes.push_back({features, weighted_cost(features)});
    ModeOrder order{.force = params.force & every_light_feature};
    const std::vector<bool> chosen = chosen_modes(modes, spectra, order.force);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < modes.size(); ++i)
        if (chosen[i]) numbers.push_back(i);
    std::ranges::stable_sort(numbers, {}, [&](std::uint32_t i) { return modes[i].cost; });
    for (const std::uint32_t number : numbers) order.modes[order.count++] = modes[number].features | number << 16;
    return order;
}

}  // namespace strata::lighting
