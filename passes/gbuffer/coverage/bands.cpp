#include "passes/gbuffer/coverage/bands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/reference/pcg.h"

namespace strata::gbuffer {
namespace {

std::uint32_t surface_key(const BandPlace& at) { return pcg(pcg(at.draw) + at.triangle); }

/// By count and dither.
constexpr std::array<std::array<std::uint32_t, 4>, 5> turning = {
    {{0, 0, 0, 0}, {0x1, 0x2, 0x4, 0x8}, {0x9, 0x6, 0x9, 0x6}, {0xe, 0xd, 0xb, 0x7}, {0xf, 0xf, 0xf, 0xf}}};

std::uint32_t hashed_samples(std::uint32_t count, const BandPlace& at) {
    const std::uint32_t turn = pcg(surface_key(at) + pcg(at.x + pcg(at.y))) / 0x40000000u;
    std::uint32_t mask = 0;
    for (std::uint32_t i = 0; i < count; ++i) mask |= 1u << (i + turn) % 4;
    return mask;
}

}  // namespace

std::uint32_t dither(std::uint32_t mode, const BandPlace& at) {
    switch (mode) {
        case masked_a2c_or:
            return (at.x | at.y) % 4;
        case masked_unbiased:
            return (at.x + at.y + surface_key(at)) % 4;
        default:
            return (at.x + at.y) % 4;
    }
}

std::uint32_t sample_count(std::uint32_t mode, std::uint32_t samples, double alpha, std::uint32_t p) {
    const double bands = samples + 1;
    double count = 0;
    switch (mode) {
        case masked_a2c_2:
        case masked_a2c_or:
            count = bands * alpha - p / 12.0;  // a - p * (.2 / 4) / 3 at 4 samples, in bands
            break;
        case masked_full_step:
            count = bands * alpha + (p - 1.5) / 4;
            break;
        case masked_unbiased:
            count = samples * alpha + (p + 0.5) / 4;
            break;
        default:
            count = bands * alpha;
    }
    return static_cast<std::uint32_t>(std::clamp(std::floor(count), 0.0, double(samples)));
}

std::uint32_t sample_mask(std::uint32_t mode, std::uint32_t samples, double alpha, const BandPlace& at) {
    const std::uint32_t p = dither(mode, at), count = sample_count(mode, samples, alpha, p);
    if (samples == 1) return count;
    if (mode == masked_a2c_1 || mode == masked_sharpened) return turning[count][p];
    if (mode == masked_unbiased) return hashed_samples(count, at);
    return (1u << count) - 1;
}

}  // namespace strata::gbuffer
