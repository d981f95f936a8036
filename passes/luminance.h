// How bright linear light of the primaries of BT.709 is. Shaders have passes/shaders/luminance.glsl.
#pragma once

#include <glm/glm.hpp>

namespace strata {

template <typename T>
constexpr T luminance(T red, T green, T blue) {
    return T(.2126) * red + T(.7152) * green + T(.0722) * blue;
}

template <typename T, glm::qualifier Q>
constexpr T luminance(const glm::vec<3, T, Q>& light) {
    return luminance(light.x, light.y, light.z);
}

}  // namespace strata
