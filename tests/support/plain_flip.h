// FLIP straight from the papers: double, one thread, one image operation after the other. The model of replay/measure/flip,
// and what its speed is compared with.
#pragma once

#include "replay/measure/flip.h"

namespace strata {

struct PlainFlip {
    std::vector<double> map;
    double mean = 0;
};

PlainFlip plain_display_flip(const ColorPlanes& reference, const ColorPlanes& test,
                             double pixels_per_degree = pixels_per_degree_of_a_desk);
/// Over the given exposures.
PlainFlip plain_radiance_flip(const ColorPlanes& reference, const ColorPlanes& test, const ExposureRange&,
                              const std::string& tone_mapper = "aces");

}  // namespace strata
