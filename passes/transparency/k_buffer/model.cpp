#include "passes/transparency/k_buffer/model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/transparency/distortion/model.h"
#include "passes/transparency/rounding.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

struct Layer {
    glm::dvec3 color{0};
    double alpha = 0;
};

std::uint64_t code_of(double x) { return static_cast<std::uint64_t>(nearest_code(x)); }

/// RGB9E5: a common exponent, from -15 on, for the largest channel's 9 bits to suffice.
std::uint64_t rgb9e5(glm::dvec3 color) {
    color = glm::clamp(color, 0., 65408.);
    const double largest = std::max({color.x, color.y, color.z});
    int exponent = largest > 0 ? std::max(std::ilogb(largest) + 1, -15) : -15;
    if (code_of(std::ldexp(largest, 9 - exponent)) > 511) ++exponent;
    std::uint64_t code = static_cast<std::uint64_t>(exponent + 15) << 27;
    for (int c = 0; c < 3; ++c) code |= code_of(std::ldexp(color[c], 9 - exponent)) << (9 * c);
    return code;
}

Layer layer_of(std::uint64_t key) {
    const auto alpha = (key >> 32) & 0xff;
    Layer layer{.alpha = double(alpha > 128 ? alpha + 1 : alpha) / 256};
    for (int c = 0; c < 3; ++c)
        layer.color[c] = std::ldexp(double((key >> (9 * c)) & 0x1ff), static_cast<int>((key >> 27) & 0x1f) - 24);
    return layer;
}

/// What is behind the K nearest, in the order it fell out.
class TailModel {
public:
    void add(const Layer& layer) {
        over_ = layer.color + (1 - layer.alpha) * over_;
        through_ *= 1 - layer.alpha;
        sum_ += layer.color;
        alphas_ += layer.alpha;
        if (layer.alpha > 0) count_ += 1;
    }

    glm::dvec3 before(glm::dvec3 behind, std::uint32_t tail) const {
        if (tail == tail_drop) return behind;
        if (tail == tail_blend) return over_ + through_ * behind;
        if (count_ == 0) return sum_ + behind;
        const double through = std::pow(1 - alphas_ / count_, count_);
        return sum_ / alphas_ * (1 - through) + through * behind;
    }

private:
    glm::dvec3 over_{0}, sum_{0};
    double through_ = 1, alphas_ = 0, count_ = 0;
};

/// Inserts into the sorted keys; what does not fit is returned.
std::optional<std::uint64_t> keep(std::vector<std::uint64_t>& nearest, std::uint64_t key, std::size_t layers) {
    nearest.insert(std::ranges::upper_bound(nearest, key), key);
    if (nearest.size() <= layers) return {};
    const std::uint64_t fallen = nearest.back();
    nearest.pop_back();
    return fallen;
}

/// Share that a neutral fragment takes of the light behind it.
double hidden_share(const Fragment& f) { return 1 - f.transmittance.x; }

bool is_same(const Fragment& a, const Fragment& b) {
    return a.depth == b.depth && hidden_share(a) == hidden_share(b) && a.color + a.emission == b.color + b.emission;
}

/// Whether the codes of two fragments that follow each other would be in another order, were floats rounded otherwise. Of equal
/// depths, which come out equal on every device, only what breaks the tie is in doubt.
bool order_hangs_on_rounding(const Fragment& a, Fragment b) {
    if (is_same(a, b)) return false;
    const auto is_nearer = [&](double nudge) {
        std::uint64_t first = k_buffer_key(a, nudge), second = k_buffer_key(b, -nudge);
        const std::uint64_t payload = (std::uint64_t{1} << 40) - 1;
        if (a.depth == b.depth) first &= payload, second &= payload;
        return first < second;
    };
    return is_nearer(8) != is_nearer(-8);
}

bool is_doubtful(std::span<const Fragment> fragments) {
    std::vector<Fragment> sorted(fragments.begin(), fragments.end());
    std::ranges::stable_sort(sorted, std::ranges::less{}, [](const Fragment& f) { return k_buffer_key(f); });
    for (std::size_t i = 1; i < sorted.size(); ++i)
        if (order_hangs_on_rounding(sorted[i - 1], sorted[i])) return true;
    return false;
}

}  // namespace

std::uint64_t k_buffer_key(const Fragment& f, double nudge) {
    const double factor = 1 + nudge * 0x1p-23;
    const auto z = static_cast<float>(std::max(f.depth * factor, 0.));
    const std::uint64_t depth = (std::bit_cast<std::uint32_t>(z) + 64) >> 7;
    const auto of_256 = code_of(std::min(hidden_share(f) * factor, 1.) * 256);
    const std::uint64_t color = rgb9e5((f.color + f.emission) * factor);
    return depth << 40 | (of_256 > 128 ? of_256 - 1 : of_256) << 32 | color;
}

glm::dvec3 k_buffer_blend(std::span<const Fragment> fragments, glm::dvec3 behind, const KBufferParams& params) {
    std::vector<std::uint64_t> nearest;
    TailModel tail;
    for (const Fragment& fragment : fragments)
        if (const auto fallen = keep(nearest, k_buffer_key(fragment), params.layers)) tail.add(layer_of(*fallen));
    glm::dvec3 radiance = tail.before(behind, params.tail);
    for (auto key = nearest.rbegin(); key != nearest.rend(); ++key) {
        const Layer layer = layer_of(*key);
        radiance = layer.color + (1 - layer.alpha) * radiance;
    }
    return radiance;
}

ImageSet k_buffer_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<KBufferParams>();
    const PlacedBlend blend = [&](std::span<const Fragment> fragments, glm::dvec3 behind, glm::uvec3) -> BlendedSample {
        return {k_buffer_blend(fragments, behind, params), is_doubtful(fragments)};
    };
    return {{"color", blended(background(input), input, blend)}};
}

}  // namespace strata::transparency
