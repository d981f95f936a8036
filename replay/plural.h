// Numbers of things as people say them.
#pragma once

#include <string>
#include <string_view>

#include <fmt/core.h>

namespace strata {

/// "1 frame", "2 frames".
inline std::string plural(std::size_t count, std::string_view thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

}  // namespace strata
