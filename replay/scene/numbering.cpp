#include "replay/scene/numbering.h"

#include <algorithm>
#include <cstddef>

#include "capture_format/frame/no_index.h"

namespace strata {

void add_places(std::span<const std::uint32_t> indices, std::uint32_t first, std::uint32_t count,
                std::vector<std::uint32_t>& places) {
    const std::span<const std::uint32_t> range = indices.subspan(first, count / 3 * 3);
    if (range.empty()) return;
    std::vector<std::uint32_t> place_of(std::size_t{std::ranges::max(range)} + 1, no_index);
    const auto keep = [&](std::uint32_t i) {
        std::uint32_t& place = place_of[range[i]];
        if (place == no_index) place = first + i;
    };
    for (std::uint32_t i = 0; i < range.size(); i += 3) keep(i);
    for (std::uint32_t i = 0; i < range.size(); ++i) {
        keep(i);
        places.push_back(i % 3 == 0 ? first + i : place_of[range[i]]);
    }
}

}  // namespace strata
