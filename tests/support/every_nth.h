// A part of a product for the default suite; the exhaustive one runs it whole.
#pragma once

#include <cstddef>
#include <ranges>
#include <vector>

namespace strata {

/// The first of a list and every n-th after it.
template <typename List>
auto every_nth(std::size_t n, const List& list) {
    std::vector<std::ranges::range_value_t<List>> some;
    for (std::size_t i = 0; i < std::ranges::size(list); i += n) some.push_back(list[i]);
    return some;
}

}  // namespace strata
