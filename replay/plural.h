// Numbers of things and lists of names as people say them.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include <fmt/core.h>

namespace strata {

/// "1 frame", "2 frames".
inline std::string plural(std::size_t count, std::string_view thing) {
    return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// "a, b, c and 2 more": the first of them by name.
inline std::string first_of(std::span<const std::string> names) {
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i == 0 ? "" : ", ") + names[i];
    return names.size() > most ? text + fmt::format(" and {} more", names.size() - most) : text;
}

}  // namespace strata
