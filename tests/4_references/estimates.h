// Tests of estimates by random numbers against a closed form.
#pragma once

#include <array>
#include <cstdint>

#include "passes/reference/image.h"
#include "tests/support/z_test.h"

namespace strata {

struct Biases {
    int false_alarms = 0;    ///< rows whose mean is not the wanted one, at a level of .01
    int noticed = 0;         ///< rows whose mean, were it .5 % more, would not be
    double probability = 1;  ///< of the mean of all, if it is the wanted one
};

/// Every texel is an estimate of the same value, in red; every row is tested by itself.
inline Biases biases(const ReferenceImage& estimates, double wanted) {
    Biases found;
    ZTest all;
    for (std::uint32_t y = 0; y < estimates.height; ++y) {
        ZTest plain, biased;
        for (std::uint32_t x = 0; x < estimates.width; ++x) {
            plain.add(std::array{estimates.at(x, y).x});
            all.add(std::array{estimates.at(x, y).x});
            biased.add(std::array{1.005 * estimates.at(x, y).x});
        }
        found.false_alarms += plain.probability(std::array{wanted}, 0) < .01;
        found.noticed += biased.probability(std::array{wanted}, 0) < .01;
    }
    found.probability = all.probability(std::array{wanted}, 0);
    return found;
}

}  // namespace strata
