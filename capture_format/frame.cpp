// The computations a plain frame brings along: the projection of View, the axes of AddressMode.
#include "capture_format/frame.h"

#include <array>
#include <cmath>

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

glm::mat4 perspective(double vertical_fov, double width_over_height, double near) {
    const double scale_y = 1 / std::tan(vertical_fov / 2);
    glm::mat4 projection{0};
    projection[0][0] = static_cast<float>(scale_y / width_over_height);
    projection[1][1] = static_cast<float>(-scale_y);  // Vulkan's y grows downwards
    projection[2][3] = 1;                             // w is the view depth
    projection[3][2] = static_cast<float>(near);      // z / w = near / depth: 1 at the near plane, 0 at infinity
    return projection;
}

}  // namespace strata
