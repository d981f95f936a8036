// The technique in double, from the papers. It shares the integer hash with the shaders: which subsamples a fragment covers is
// part of the technique, not a rounding of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "passes/blend_rounding.h"
#include "passes/image_set.h"
#include "passes/transparency/sample_blend.h"
#include "passes/transparency/stochastic/stochastic.shared.h"

namespace strata {

class Settings;  // passes/settings.h

}  // namespace strata

namespace strata::transparency {

/// Of hashed alpha: what the threshold of a fragment may be, wherever rounding puts its point among the cells.
struct ThresholdRange {
    double least = 0, most = 0;
};

/// A fragment with what its subset is made from.
struct SeededFragment {
    Fragment fragment;
    std::uint32_t key = 0;  ///< subset_key()
    ThresholdRange threshold = {};
};

/// What a fragment of a sample (x, y, sample) draws lots with: a number for every two triangles of a draw.
std::uint32_t subset_key(std::uint32_t seed, glm::uvec3 at, std::uint32_t draw, std::uint32_t triangle);

/// Bit s: subsample s is covered.
std::uint64_t covered_subset(double alpha, std::uint32_t key, std::uint32_t subsamples, std::uint32_t subset);

/// Uniform in 0..1 if u1 and u2 are; l from 0 (u1 alone) to 1 (u2 alone).
double mixed_uniformly(double u1, double u2, double l);
/// Of the points within `reach` of one in object space, where cells have the size 2^-octave.
ThresholdRange hashed_thresholds(const glm::dvec3& position, double reach, double octave, std::uint32_t seed);
/// At a point.
double hashed_threshold(const glm::dvec3& position, double octave, std::uint32_t seed);

/// One sample. Undecided where an alpha is within float rounding of covering one subsample more or less, or a point within
/// rounding of another cell of the hash, whose threshold lies on the other side of alpha. With `half` sums and products are half
/// floats, rounded at every blend.
BlendedSample stochastic_blend(std::span<const SeededFragment>, glm::dvec3 behind, const StochasticParams&,
                               std::optional<Rounding> half = {});

ImageSet stochastic_model(const StageInput&, const Settings&);

}  // namespace strata::transparency
