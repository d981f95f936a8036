#include "passes/transparency/functions/tint_model.h"

#include <algorithm>

#include "passes/transparency/functions/model.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {

glm::dvec2 skew_depths(const Fragment& fragment, double seen) {
    glm::dvec3 tau;
    for (int c = 0; c < 3; ++c) tau[c] = optical_depth_in_double(fragment.transmittance[c]);
    const double least = std::min({tau.x, tau.y, tau.z});
    for (int c = 0; c < 3; ++c) tau[c] = std::min(tau[c] - least, double(largest_skew_depth));
    return seen * glm::dvec2(tau.x - tau.y, tau.z - tau.y);
}

glm::dvec3 skew(glm::dvec2 depths) {
    const double least = std::min({depths.x, 0., depths.y});
    const glm::dvec3 through = glm::exp(glm::dvec3(least - depths.x, least, least - depths.y));
    return through / luminance(through);
}

}  // namespace strata::transparency
