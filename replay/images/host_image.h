// An image or buffer read back from the device, bit for bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "passes/graph/step.h"
#include "passes/reference/image.h"

namespace strata {

/// Texels of mip 0, layer by layer, rows top to bottom, tightly packed in the shape's format. Depth d32f is one float.
struct HostImage {
    Shape shape;
    std::vector<std::byte> texels;
    glm::ivec2 place{0};  ///< of the first texel in the picture; an EXR's data window may lie anywhere in the display window
};

/// Images of a run or a file.
using NamedImages = std::map<std::string, HostImage>;

/// One texel as four doubles; missing channels are 0 (a: 1).
glm::dvec4 texel(const HostImage&, std::uint32_t x, std::uint32_t y, std::uint32_t layer = 0);
/// The whole image in double.
ReferenceImage in_double(const HostImage&);

}  // namespace strata
