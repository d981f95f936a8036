#include "replay/measure/worst_region.h"

#include <algorithm>

namespace strata {
namespace {

/// Where blocks begin along an edge: the last ends where the image does.
std::vector<std::uint32_t> block_starts(std::uint32_t edge) {
    std::vector<std::uint32_t> starts;
    for (std::uint32_t at = 0; at + region_block < edge; at += region_block / 2) starts.push_back(at);
    starts.push_back(edge > region_block ? edge - region_block : 0);
    return starts;
}

/// Numbers of pixels over the limit in boxes, from a table of sums.
class Counts {
public:
    Counts(const std::vector<bool>& is_over, std::uint32_t width, std::uint32_t height)
        : stride_(std::size_t(width) + 1), sums_(stride_ * (height + 1)) {
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                sum(x + 1, y + 1) =
                    std::uint32_t(is_over[std::size_t(y) * width + x]) + sum(x, y + 1) + sum(x + 1, y) - sum(x, y);
    }

    std::uint64_t in(const PixelBox& box) const {
        const std::uint32_t right = box.x + box.width, below = box.y + box.height;
        return std::uint64_t{sum(right, below)} + sum(box.x, box.y) - sum(box.x, below) - sum(right, box.y);
    }

private:
    std::uint32_t& sum(std::uint32_t x, std::uint32_t y) { return sums_[y * stride_ + x]; }
    std::uint32_t sum(std::uint32_t x, std::uint32_t y) const { return sums_[y * stride_ + x]; }

    std::size_t stride_;
    std::vector<std::uint32_t> sums_;
};

/// The smallest box around the pixels over the limit in a box.
PixelBox shrunk(PixelBox box, const Counts& counts) {
    while (counts.in({box.x, box.y, 1, box.height}) == 0) ++box.x, --box.width;
    while (counts.in({box.x + box.width - 1, box.y, 1, box.height}) == 0) --box.width;
    while (counts.in({box.x, box.y, box.width, 1}) == 0) ++box.y, --box.height;
    while (counts.in({box.x, box.y + box.height - 1, box.width, 1}) == 0) --box.height;
    return box;
}

}  // namespace

std::optional<WorstRegion> worst_region(const std::vector<bool>& is_over, std::uint32_t width, std::uint32_t height) {
    if (width == 0 || height == 0) return std::nullopt;
    const Counts counts(is_over, width, height);
    const std::vector<std::uint32_t> columns = block_starts(width), rows = block_starts(height);
    const std::uint32_t block_width = std::min(width, region_block), block_height = std::min(height, region_block);
    const auto block = [&](std::size_t i) {
        return PixelBox{columns[i % columns.size()], rows[i / columns.size()], block_width, block_height};
    };
    std::vector<std::uint64_t> in_block(columns.size() * rows.size());
    for (std::size_t i = 0; i < in_block.size(); ++i) in_block[i] = counts.in(block(i));
    const auto densest = std::ranges::max_element(in_block);
    if (*densest == 0) return std::nullopt;
    WorstRegion worst{.block_density = double(*densest) / (double(block_width) * block_height)};

    // Blocks that hang together with the densest.
    std::vector<bool> is_taken(in_block.size());
    std::vector<std::size_t> open{static_cast<std::size_t>(densest - in_block.begin())};
    is_taken[open.front()] = true;
    std::uint32_t left = width, top = height, right = 0, below = 0;
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        const PixelBox box = block(i);
        left = std::min(left, box.x), top = std::min(top, box.y);
        right = std::max(right, box.x + box.width), below = std::max(below, box.y + box.height);
        const std::size_t column = i % columns.size(), row = i / columns.size();
        const auto take = [&](std::size_t at_column, std::size_t at_row) {
            if (at_column >= columns.size() || at_row >= rows.size()) return;
            const std::size_t other = at_row * columns.size() + at_column;
            if (is_taken[other] || 2 * in_block[other] < *densest) return;
            is_taken[other] = true;
            open.push_back(other);
        };
        take(column + 1, row), take(column, row + 1);
        if (column > 0) take(column - 1, row);
        if (row > 0) take(column, row - 1);
    }
    worst.box = shrunk({left, top, right - left, below - top}, counts);
    worst.pixels = counts.in(worst.box);
    worst.density = double(worst.pixels) / (double(worst.box.width) * worst.box.height);
    return worst;
}

}  // namespace strata
