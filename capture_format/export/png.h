// Pictures as PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace strata {

/// A whole file of 8-bit texels, rows top to bottom; channels: 3 (red, green, blue) or 4 (and alpha). The texels are all there
/// (asserted).
std::vector<std::byte> encode_png(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                                  std::span<const std::byte> texels);

}  // namespace strata
