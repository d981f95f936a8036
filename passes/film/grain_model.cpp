#include "passes/film/grain_model.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/reference/pcg.h"

namespace strata::film {
namespace {

std::uint32_t shuffled(std::uint32_t place, std::uint32_t key) {
    constexpr std::uint32_t count = 4096;
    std::uint32_t x = (place + key) % count;
    x ^= x / 64;
    x = (x * 2925 + key / 4096) % count;
    x ^= x / 128;
    x = x * 1597 % count;
    x ^= x / 64;
    x = (x * 3413 + key / 1048576) % count;
    return x ^ (x / 128);
}

}  // namespace

std::uint32_t grain_rank(const Frame& frame, std::uint32_t x, std::uint32_t y, double rate) {
    const double slot = std::floor(frame.time * rate), wrapped = std::fmod(slot, 4294967296.);
    const auto time = std::uint32_t(std::int64_t(wrapped));
    const std::uint32_t key = pcg(pcg(pcg(std::uint32_t(frame.seed) ^ time)));
    return shuffled(y % 64 * 64 + x % 64, pcg(pcg(pcg(key ^ (x / 64)) ^ (y / 64))));
}

glm::dvec4 aged(const Frame& frame, const glm::dvec4& display, double noise) {
    const double grain = std::max(0., 1 + double(frame.film.grain) * (2 * noise - 1));
    const double remains = 1 - std::clamp(double(frame.film.fade), 0., 1.);
    return {glm::dvec3(display) * grain * remains, display.w};
}

}  // namespace strata::film
