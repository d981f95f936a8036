// Grain and fading in double, from docs/algorithms/deferred.md 8.9: what truth and models compute with.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::film {

/// Where a pixel's value stands among the 4096 of its tile, in the slot of time that the frame lies in.
std::uint32_t grain_rank(const Frame&, std::uint32_t x, std::uint32_t y, double rate);

/// Display light after grain, as noise from 0 to 1, and fading.
glm::dvec4 aged(const Frame&, const glm::dvec4& display, double noise);

}  // namespace strata::film
