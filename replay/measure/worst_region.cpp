#include "replay/measure/worst_region.h"

#include <algorithm>

namespace strata {
namespace {

/// Where blocks of a grid begin along an edge, half a block apart: the last ends where the image does.
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

bool overlap(const PixelBox& a, const PixelBox& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

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
    const std::uint32_t block_width = std::min(width, region_block), block_height = std::min(height, region_block);
    std::uint64_t most = 0;
    PixelBox densest;
    for (std::uint32_t y = 0; y + block_height <= height; ++y)
        for (std::uint32_t x = 0; x + block_width <= width; ++x) {
            const PixelBox block{x, y, block_width, block_height};
            const std::uint64_t count = counts.in(block);
            if (count > most) most = count, densest = block;
        }
    if (most == 0) return std::nullopt;
    WorstRegion worst{.block_density = double(most) / (double(block_width) * block_height)};

    // Blocks of a grid that hang together with the densest.
    const std::vector<std::uint32_t> columns = block_starts(width), rows = block_starts(height);
    const auto block = [&](std::size_t i) {
        return PixelBox{columns[i % columns.size()], rows[i / columns.size()], block_width, block_height};
    };
    std::vector<bool> is_taken(columns.size() * rows.size());
    std::vector<std::size_t> open;
    const auto take = [&](std::size_t column, std::size_t row) {
        const std::size_t i = row * columns.size() + column;
        if (column >= columns.size() || row >= rows.size() || is_taken[i] || 2 * counts.in(block(i)) < most) return;
        is_taken[i] = true;
        open.push_back(i);
    };
    for (std::size_t row = 0; row < rows.size(); ++row)
        for (std::size_t column = 0; column < columns.size(); ++column)
            if (overlap(block(row * columns.size() + column), densest)) take(column, row);
    std::uint32_t left = densest.x, top = densest.y, right = left + block_width, below = top + block_height;
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        const PixelBox box = block(i);
        left = std::min(left, box.x), top = std::min(top, box.y);
        right = std::max(right, box.x + box.width), below = std::max(below, box.y + box.height);
        const std::size_t column = i % columns.size(), row = i / columns.size();
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
