// Images in double precision on the CPU.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

/// Another value that a texel of a truth may have, as far as rounding decides.
struct Alternative {
    std::size_t texel = 0;
    glm::dvec4 value{0};
};

/// width x height x layers texels of four doubles; layer = sample where an image has samples.
struct ReferenceImage {
    std::uint32_t width = 0, height = 0, layers = 1;
    std::uint32_t channels = 4;  ///< that mean something; the others read 0, 0, 1
    std::vector<glm::dvec4> texels;
    std::vector<bool> undecided = {};             ///< empty, or one per texel: coverage hangs on rounding there, do not compare
    std::vector<Alternative> alternatives = {};   ///< by texel: what else undecided texels of a truth may be (settle.h)
    std::vector<glm::dvec3> standard_error = {};  ///< of each texel's color, where texels are estimates by random numbers

    ReferenceImage() = default;
    ReferenceImage(std::uint32_t w, std::uint32_t h, std::uint32_t l = 1, glm::dvec4 fill = glm::dvec4(0))
        : width(w), height(h), layers(l), texels(std::size_t(w) * h * l, fill) {}

    std::size_t index(std::uint32_t x, std::uint32_t y, std::uint32_t layer = 0) const {
        return (std::size_t(layer) * height + y) * width + x;
    }
    glm::dvec4& at(std::uint32_t x, std::uint32_t y, std::uint32_t layer = 0) { return texels[index(x, y, layer)]; }
    const glm::dvec4& at(std::uint32_t x, std::uint32_t y, std::uint32_t layer = 0) const { return texels[index(x, y, layer)]; }
};

}  // namespace strata
