// Special members of Frame, where all types of its lists are known, and the axes of AddressMode.
#include "capture_format/frame.h"

#include <array>
#include <cstddef>

namespace strata {

Frame::Frame() = default;
Frame::Frame(const Frame&) = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(const Frame&) = default;
Frame& Frame::operator=(Frame&&) noexcept = default;
Frame::~Frame() = default;

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
