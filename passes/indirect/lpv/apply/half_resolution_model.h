// Light that is read of a grid once per 2 x 2 pixels, in double: which pixel reads it, and which pixels take it from there.
#pragma once

#include <optional>
#include <vector>

#include "passes/indirect/reading_model.h"

namespace strata::indirect::in_double {

/// The surfaces of the first samples, row by row; no value on the background.
struct VisibleSurfaces {
    std::uint32_t width = 0, height = 0;
    std::vector<std::optional<Receiver>> receivers;
    std::vector<double> depths;  ///< view depth
};

/// The pixel of each 2 x 2 that reads the grid: the nearest to the eye where column + row of the block is even, the farthest
/// elsewhere, of equal ones the first. No value where none has a surface.
std::vector<std::optional<glm::uvec2>> reading_pixels(const VisibleSurfaces&);

/// How well the surface of another pixel stands for that of a pixel, `pixels` away from it: the product of 1 - |pixels| / 3 each
/// way, 1 - distance / half a cell, and 2 cos - 1 of the angle between normals, none below 0; 0 if a barrier lies between them.
double fit(const LitGrid&, const Receiver&, const Receiver& other, const glm::dvec2& pixels);

/// What a grid gives at the reading pixels. Refers to all it is made of.
class HalfResolutionLight {
public:
    HalfResolutionLight(const LitGrid&, const VisibleSurfaces&);
    /// W/m^2 at a receiver seen in a pixel: the mean over the pixel's own block and the three that touch the same corner of it,
    /// weighted by fit(). No value where these add up to less than 1/4.
    std::optional<glm::dvec3> at(const Receiver&, const glm::uvec2& pixel) const;

private:
    struct Block {
        glm::uvec2 pixel{0};
        Receiver receiver;
        glm::dvec3 light{0};
    };
    const LitGrid& lit_;
    glm::ivec2 extent_;                         ///< in blocks
    std::vector<std::optional<Block>> blocks_;  ///< none: no surface, or not in the grid
};

}  // namespace strata::indirect::in_double
