#include "passes/lens/distortion/radial_model.h"

#include <algorithm>
#include <cmath>

namespace strata::lens {

glm::dvec3 bilinear(const ReferenceImage& image, glm::dvec2 at, std::uint32_t layer) {
    const glm::dvec2 place = glm::clamp(at, glm::dvec2(0), glm::dvec2(image.width, image.height)) - .5, low = glm::floor(place);
    glm::dvec3 sum(0);
    for (const double dy : {0., 1.})
        for (const double dx : {0., 1.}) {
            const auto x = std::uint32_t(std::clamp(low.x + dx, 0., image.width - 1.));
            const auto y = std::uint32_t(std::clamp(low.y + dy, 0., image.height - 1.));
            const double weight = (1 - std::abs(place.x - low.x - dx)) * (1 - std::abs(place.y - low.y - dy));
            for (int c = 0; c < 3; ++c) {
                const double value = image.at(x, y, layer)[c];
                sum[c] += std::isnan(value) ? 0 : weight * std::clamp(value, 0., 65504.);
            }
        }
    return sum;
}

glm::dvec2 radial_source(double k1, glm::dvec2 at, glm::dvec2 extent) {
    const glm::dvec2 middle = extent / 2., off = at - middle;
    const double diagonal2 = glm::dot(middle, middle), shorter = std::min(middle.x, middle.y);
    const auto stretched = [&](double r2) { return 1 + k1 * r2 / diagonal2; };
    const double whole = stretched(k1 > 0 ? diagonal2 : shorter * shorter);
    return middle + off * (stretched(glm::dot(off, off)) / whole);
}

ReferenceImage radial_model(const ReferenceImage& color, double k1) {
    ReferenceImage result = color;
    const auto undecided_at = [&](const glm::dvec2& source, std::uint32_t layer) {
        for (const glm::dvec2 corner : {glm::dvec2(-.5, -.5), glm::dvec2(.5, -.5), glm::dvec2(-.5, .5), glm::dvec2(.5, .5)}) {
            const glm::dvec2 at =
                glm::clamp(glm::floor(source + corner), glm::dvec2(0), glm::dvec2(color.width - 1, color.height - 1));
            if (color.undecided[color.index(std::uint32_t(at.x), std::uint32_t(at.y), layer)]) return true;
        }
        return false;
    };
    for (std::uint32_t s = 0; s < color.layers; ++s)
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x) {
                const glm::dvec2 source = radial_source(k1, glm::dvec2(x, y) + .5, {color.width, color.height});
                result.at(x, y, s) = glm::dvec4(bilinear(color, source, s), 1);
                if (!color.undecided.empty()) result.undecided[result.index(x, y, s)] = undecided_at(source, s);
            }
    return result;
}

}  // namespace strata::lens
