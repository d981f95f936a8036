// The table of docs/algorithms/deferred.md 4.2: the share of samples that a constant alpha covers on average over 4 x 4 pixels,
// at 4 samples per pixel.
#pragma once

#include <array>
#include <cstdint>

#include "passes/gbuffer/coverage/coverage.shared.h"

namespace strata::gbuffer {

/// The table's columns: alpha in sixteenths.
inline constexpr std::array<std::uint32_t, 13> table_alphas = {1, 3, 4, 5, 7, 8, 9, 10, 11, 12, 13, 14, 16};

struct MeanCoverages {
    std::uint32_t mode = 0;
    std::array<double, table_alphas.size()> at;
};

inline constexpr std::array mean_coverages = {
    MeanCoverages{masked_a2c_1, {0, 0, .25, .25, .5, .5, .5, .75, .75, .75, 1, 1, 1}},
    MeanCoverages{masked_a2c_2, {0, 0, .25, .25, .4375, .5, .5, .625, .75, .75, .8125, 1, 1}},
    MeanCoverages{masked_a2c_or, {0, 0, .25, .25, .359375, .5, .5, .5625, .75, .75, .765625, 1, 1}},
    MeanCoverages{masked_full_step, {0, .125, .1875, .25, .4375, .5, .5625, .6875, .75, .8125, .875, 1, 1}},
    MeanCoverages{masked_unbiased, {.0625, .1875, .25, .3125, .4375, .5, .5625, .625, .6875, .75, .8125, .875, 1}},
};

}  // namespace strata::gbuffer
