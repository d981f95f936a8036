#include "passes/reference/ordering.h"

#include <algorithm>

#include "passes/reference/fragments.h"
#include "passes/shaders/ordering.shared.h"

namespace strata {

std::uint32_t layer_of(const Frame& frame, std::uint32_t draw) {
    return draw < frame.draws.size() ? frame.draws[draw].layer : frame.emitters[draw - frame.draws.size()].layer;
}

std::uint32_t highest_layer(const Frame& frame) {
    std::uint32_t highest = 0;
    for (const std::uint32_t draw : transparent_draws(frame)) highest = std::max(highest, layer_of(frame, draw));
    return highest;
}

double ordering_depth(const Frame& frame, std::uint32_t layer, double z) {
    const float near = frame.view.near;
    return layer > 0 ? double(layer_depth(near, layer)) : std::max(z, double(near));
}

}  // namespace strata
