// Parameters of the bounded A-buffer.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct ABufferParams {
    std::uint32_t layers;
    std::uint32_t stored_as;  ///< the parameter `layout`, which is a word of GLSL
};

}  // namespace strata::transparency
