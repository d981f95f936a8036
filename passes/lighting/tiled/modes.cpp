#include "passes/lighting/tiled/modes.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "passes/lighting/mode_costs.h"
#include "passes/lighting/spectra.h"
#include "passes/shaders/light_features.shared.h"

namespace strata::lighting {
namespace {

/// By number: whether it is the choice for some features of the frame.
std::vector<bool> chosen_modes(const std::vector<Mode>& modes, std::uint32_t frame_features, std::uint32_t forced) {
    std::vector<bool> chosen(modes.size(), false);
    // Every subset, down to none.
    for (std::uint32_t subset = frame_features;; subset = (subset - 1) & frame_features) {
        chosen[choose(modes, subset | forced)] = true;
        if (subset == 0) return chosen;
    }
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

ModeOrder mode_order(const TiledParams& params, std::uint32_t frame_features) {
    std::vector<Mode> modes;
    for (const std::uint32_t features : mode_features(params)) modes.push_back({features, weighted_cost(features)});
    const std::vector<bool> chosen =
        chosen_modes(modes, frame_features & every_light_feature, params.force & every_light_feature);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < modes.size(); ++i)
        if (chosen[i] || choose(modes, every_light_feature) == i) numbers.push_back(i);
    std::ranges::stable_sort(numbers, {}, [&](std::uint32_t i) { return modes[i].cost; });
    ModeOrder order{.count = static_cast<std::uint32_t>(numbers.size()), .force = params.force & every_light_feature};
    for (std::size_t i = 0; i < numbers.size(); ++i) order.modes[i] = modes[numbers[i]].features | numbers[i] << 16;
    return order;
}

}  // namespace strata::lighting
