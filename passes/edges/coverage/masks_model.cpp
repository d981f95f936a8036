#include "passes/edges/coverage/masks_model.h"

#include <algorithm>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/stage_input.h"

namespace strata::edges {
namespace {

/// Bits of samples, by a triangle's depth against the pixel's.
struct Seen {
    std::uint32_t there = 0, cut = 0, hidden = 0;
};

Seen seen(const Covering& c, const ReferenceImage& depths, glm::uvec2 pixel) {
    Seen bits;
    for (std::uint32_t sample = 0; sample < depths.layers; ++sample) {
        if ((c.covered >> sample & 1u) == 0) continue;
        const double nearer = c.depth[sample] - depths.at(pixel.x, pixel.y, sample).x;
        if (nearer > c.tolerance[sample]) bits.cut |= 1u << sample;
        else if (nearer < -c.tolerance[sample]) bits.hidden |= 1u << sample;
        else bits.there |= 1u << sample;
    }
    return bits;
}

Verdict verdict_on(const Covering& c, const Seen& bits, std::uint32_t all) {
    if (!c.is_masked && bits.cut != 0) return Verdict::undecided;  // nothing cuts it: a side within rounding
    if (bits.there == 0) return Verdict::plain;
    if (c.covered != all || bits.cut != 0) return Verdict::edge;
    if (!c.is_masked) return Verdict::plain;
    return bits.hidden != 0 || c.is_fractional ? Verdict::undecided : Verdict::plain;
}

}  // namespace

bool has_masks(const Frame& frame) {
    return std::ranges::any_of(opaque_draws(frame), [&](std::uint32_t draw) {
        return frame.materials[frame.draws[draw].material].alpha_mode == AlphaMode::mask;
    });
}

Verdict verdict_by_depth(const std::vector<Covering>& here, const StageInput& input, glm::uvec2 pixel) {
    const ReferenceImage& depths = input.before.at("depth_layers");
    Verdict verdict = Verdict::plain;
    std::uint32_t taken = 0;
    for (const Covering& covering : here) {
        const Seen bits = seen(covering, depths, pixel);
        if ((taken & bits.there) != 0) return Verdict::undecided;
        taken |= bits.there;
        const Verdict one = verdict_on(covering, bits, (1u << depths.layers) - 1);
        if (verdict != Verdict::edge && one != Verdict::plain) verdict = one;
    }
    return verdict;
}

}  // namespace strata::edges
