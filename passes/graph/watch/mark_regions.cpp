#include "passes/graph/watch/mark_regions.h"

#include <algorithm>
#include <bit>

namespace strata {

void UnitBits::add(std::span<const std::uint32_t> words) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= words[i];
    if (units_ % 32 != 0) words_.back() &= (1u << units_ % 32) - 1;
}

void UnitBits::add(std::uint64_t begin, std::uint64_t end) {
    for (std::uint64_t unit = begin; unit < end;) {
        const std::uint64_t last = std::min(end, unit / 32 * 32 + 32);
        const std::uint32_t many = std::uint32_t(last - unit);
        words_[unit / 32] |= (many == 32 ? ~0u : (1u << many) - 1) << unit % 32;
        unit = last;
    }
}

void UnitBits::add(const Shape& shape, const TexelBox& box) {
    const std::uint64_t width = shape.extent.width, height = shape.extent.height, samples = shape.samples;
    const std::uint64_t columns_end = std::min<std::uint64_t>(width, std::uint64_t{box.first_column} + box.columns);
    const std::uint64_t rows_end = std::min<std::uint64_t>(height, std::uint64_t{box.first_row} + box.rows);
    const std::uint64_t layers_end = std::min<std::uint64_t>(shape.layers, std::uint64_t{box.first_layer} + box.layers);
    for (std::uint64_t layer = box.first_layer; layer < layers_end; ++layer)
        for (std::uint64_t row = box.first_row; row < rows_end; ++row) {
            const std::uint64_t start = (layer * height + row) * width;
            if (box.first_column < columns_end) add((start + box.first_column) * samples, (start + columns_end) * samples);
        }
}

void UnitBits::add(const UnitBits& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= other.words_[i];
}

void UnitBits::keep_only(const UnitBits& other) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= other.words_[i];
}

std::uint64_t UnitBits::count() const {
    std::uint64_t count = 0;
    for (const std::uint32_t word : words_) count += std::uint64_t(std::popcount(word));
    return count;
}

UnitBits used_units(const MarkRegion& region, const Shape& shape, std::span<const std::uint32_t> marks) {
    UnitBits used(region.units);
    if (region.is_marked) used.add(marks.subspan(region.first_word, region.words()));
    if (region.is_whole) used.add_all();
    for (const TexelBox& box : region.boxes) used.add(shape, box);
    return used;
}

}  // namespace strata
