// The computation a plain frame brings along: the axes of AddressMode.
#include "capture_format/frame.h"

#include <array>
#include <cstddef>

namespace strata {

AddressMode address_u(AddressMode mode) {
    using enum AddressMode;
    constexpr std::array by_mode = {repeat, clamp, mirror, repeat, repeat, clamp, clamp, mirror, mirror};
    return by_mode[static_cast<std::size_t>(mode)];
}

AddressMode address_v(AddressMode mode) {
    using enum AddressMode;
    constexpr std::array by_mode = {repeat, clamp, mirror, clamp, mirror, repeat, mirror, repeat, clamp};
    return by_mode[static_cast<std::size_t>(mode)];
}

}  // namespace strata
