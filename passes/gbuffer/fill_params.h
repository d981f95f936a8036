// Parameters that every G-buffer technique takes: how triangles are drawn into it, whatever its layout.
#pragma once

#include <cstdint>

namespace strata::gbuffer {

/// Where attributes are shaded: once per pixel and triangle at the pixel's center, or for every sample at its own place.
inline constexpr std::uint32_t attributes_at_center = 0;
inline constexpr std::uint32_t attributes_at_sample = 1;

struct FillParams {
    std::uint32_t attributes;
    std::uint32_t masked;  ///< a mode of passes/gbuffer/coverage/coverage.shared.h
};

}  // namespace strata::gbuffer
