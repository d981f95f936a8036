// The integral over the unit square by adaptive cubature: Genz and Malik 1980, An adaptive algorithm for numerical integration
// over an N-dimensional rectangular region. The cell whose degree 5 and degree 7 rules differ most is halved, until their sum is
// small.
#pragma once

#include <cstdint>
#include <functional>

#include <glm/glm.hpp>

namespace strata {

struct CubatureOptions {
    double tolerance = 1e-4;  ///< of the largest component's integral, relative
    std::uint32_t most = 20'000;
    /// Cells around here are quartered `levels` times before anything is asked: a peak that no point of a rule meets is never
    /// seen.
    glm::dvec2 peak{0.5};
    int levels = 0;
};

glm::dvec3 integral(const std::function<glm::dvec3(glm::dvec2)>&, const CubatureOptions&);

}  // namespace strata
