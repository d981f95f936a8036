#include "tests/support/not_finite.h"

#include <cmath>

#include <fmt/core.h>

namespace strata {

std::optional<std::string> texel_that_is_no_number(const HostImage& image) {
    const ReferenceImage texels = in_double(image);
    for (std::uint32_t layer = 0; layer < texels.layers; ++layer)
        for (std::uint32_t y = 0; y < texels.height; ++y)
            for (std::uint32_t x = 0; x < texels.width; ++x) {
                const glm::dvec4 t = texels.at(x, y, layer);
                if (!std::isfinite(t.x + t.y + t.z + t.w))
                    return fmt::format("({}, {}) layer {}: {} {} {} {}", x, y, layer, t.x, t.y, t.z, t.w);
            }
    return {};
}

}  // namespace strata
