#include "passes/transparency/voxel/volume/color_column.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/transparency/voxel/sparse/sparse.h"

namespace strata::transparency {

bool packs_colors(const VoxelParams& params, std::uint32_t channels) {
    return channels == 3 && params.packing == packing_rgb10 && params.splat != splat_words && params.splat != splat_multiply &&
           !is_sparse(params);
}

ColumnFormat color_format(const VoxelParams& params) {
    return {.slices = params.slices, .splat = params.splat, .field_bits = color_bits, .full_code = color_full_code};
}

std::uint32_t color_scale(const ColumnFormat& gray) {
    const double scale = color_format({}).codes_per_depth() / gray.codes_per_depth();
    return static_cast<std::uint32_t>(std::lround(color_scale_one * scale));
}

std::uint32_t source_of(const Frame& frame, std::uint32_t submission) {
    if (submission >= frame.draws.size()) return source_gray;
    const glm::vec3 k = frame.materials[frame.draws[submission].material].transmission;
    return k.x == k.y && k.y == k.z ? source_gray : source_color;
}

void ColorColumn::add(std::uint32_t slice, glm::uvec3 codes) {
    const glm::uvec3 before = fields(slice);
    for (int c = 0; c < 3; ++c) {
        if (format_.splat == splat_saturating) codes[c] = std::min(codes[c], color_full_code - before[c]);
        if (format_.splat == splat_overflow_minimum && before[c] + codes[c] > color_full_code)
            overflow_[c] = std::min(overflow_[c], slice);
    }
    words_[slice] += codes.x + (codes.y << color_bits) + (codes.z << 2 * color_bits);
}

glm::uvec3 ColorColumn::fields(std::uint32_t slice) const {
    const std::uint32_t word = words_[slice];
    return glm::uvec3(word, word >> color_bits, word >> 2 * color_bits) & ((1u << color_bits) - 1);
}

std::vector<glm::uvec3> ColorColumn::integral(const Column& gray) const {
    const std::vector<std::uint32_t> gray_sums = gray.integral();
    const std::uint32_t scale = color_scale(gray.format());
    std::vector<glm::uvec3> sums;
    glm::uvec3 sum(0);
    for (std::uint32_t slice = 0; slice < format_.slices; ++slice) {
        glm::uvec3 total;
        for (int c = 0; c < 3; ++c) {
            sum[c] = slice >= overflow_[c] ? color_full_code : std::min(sum[c] + fields(slice)[c], color_full_code);
            total[c] = std::min(sum[c] + (gray_sums[slice] * scale + color_scale_one / 2) / color_scale_one, color_full_code);
        }
        sums.push_back(total);
    }
    return sums;
}

}  // namespace strata::transparency
