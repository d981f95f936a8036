// Bounds of shadow maps in double.
#include "passes/shadows/bounds/bounds_model.h"

#include <algorithm>
#include <limits>

namespace strata::shadows {

namespace {

/// Texels from `begin` to `last`, both inside.
struct Rectangle {
    glm::ivec2 begin{0}, last{0};
};

template <typename Visit>
void visit_texels(const Rectangle& rectangle, const Visit& visit) {
    for (int y = rectangle.begin.y; y <= rectangle.last.y; ++y)
        for (int x = rectangle.begin.x; x <= rectangle.last.x; ++x) visit(glm::ivec2(x, y));
}

Slab extremes_of(const ReferenceImage& maps, const Lookup& at, const Rectangle& rectangle) {
    Slab found{.least = std::numeric_limits<double>::max(), .greatest = 0};
    visit_texels(rectangle, [&](glm::ivec2 texel) {
        const double depth = map_depth(maps, at, texel);
        found.least = std::min(found.least, depth);
        found.greatest = std::max(found.greatest, depth);
    });
    return found;
}

Rectangle window_of(const Lookup& at, const BoundsSettings& settings) {
    const glm::ivec2 begin = block_begin(at, settings.block) - static_cast<int>(settings.reach);
    return {begin, begin + static_cast<int>(settings.window()) - 1};
}

Rectangle footprint_of(const Lookup& at, std::int64_t taps) {
    const glm::ivec2 begin = glm::ivec2(glm::floor(at.u - 0.5)) - static_cast<int>(taps / 2 - 1);
    return {begin, begin + static_cast<int>(taps) - 1};
}

glm::dvec2 center_of(const Rectangle& rectangle) { return 0.5 * glm::dvec2(rectangle.begin + rectangle.last); }

/// By the normal equations of least squares, which are diagonal over a square.
glm::dvec2 slope_of(const ReferenceImage& maps, const Lookup& at, const Rectangle& window) {
    glm::dvec2 sum(0), squares(0);
    visit_texels(window, [&](glm::ivec2 texel) {
        const glm::dvec2 way = glm::dvec2(texel) - center_of(window);
        sum += way * map_depth(maps, at, texel);
        squares += way * way;
    });
    return sum / squares;
}

Rectangle whole_blocks(const Rectangle& texels, int block) {
    const glm::dvec2 size(block);
    return {glm::ivec2(glm::floor(glm::dvec2(texels.begin) / size)) * block,
            glm::ivec2(glm::floor(glm::dvec2(texels.last) / size)) * block + block - 1};
}

}  // namespace

glm::ivec2 block_begin(const Lookup& at, std::uint32_t block) {
    const glm::ivec2 texel = glm::clamp(glm::ivec2(glm::floor(at.u)), glm::ivec2(0), glm::ivec2(static_cast<int>(at.size) - 1));
    return texel / static_cast<int>(block) * static_cast<int>(block);
}

FittedSlab slab_of(const ReferenceImage& maps, const Lookup& at, const BoundsSettings& settings) {
    const Rectangle window = window_of(at, settings);
    const Slab level = extremes_of(maps, at, window);
    Slab tilted{.least = std::numeric_limits<double>::max(), .greatest = std::numeric_limits<double>::lowest()};
    tilted.slope = slope_of(maps, at, window);
    visit_texels(window, [&](glm::ivec2 texel) {
        const double over = map_depth(maps, at, texel) - glm::dot(tilted.slope, glm::dvec2(texel) - center_of(window));
        tilted.least = std::min(tilted.least, over);
        tilted.greatest = std::max(tilted.greatest, over);
    });
    const double width = tilted.greatest - tilted.least;
    const glm::ivec2 inside = glm::clamp(window.last, glm::ivec2(0), glm::ivec2(static_cast<int>(at.size) - 1));
    const bool is_inside = std::min(window.begin.x, window.begin.y) >= 0 && inside == window.last;
    const bool is_plane = width < double(plane_tolerance) && level.least > 0;
    const bool may_tilt = is_inside && (settings.form == BoundsForm::slabs || (settings.form == BoundsForm::planes && is_plane));
    return {may_tilt && width < level.greatest - level.least ? tilted : level, width};
}

Answer early_answer(const ReferenceImage& maps, const Lookup& at, std::int64_t taps, const BoundsSettings& settings) {
    if (at.size < settings.block) return Answer::expensive;
    const Rectangle footprint = footprint_of(at, taps);
    Rectangle window = window_of(at, settings);
    Slab slab;
    if (settings.form == BoundsForm::extremes && settings.reach == 0) {
        window = whole_blocks(footprint, static_cast<int>(settings.block));
        slab = extremes_of(maps, at, window);
    } else if (settings.form == BoundsForm::extremes) {
        slab = extremes_of(maps, at, window);
    } else {
        slab = slab_of(maps, at, settings).kept;
    }
    // Relative to the receiver's plane, at the corners of the footprint where that is lowest and highest.
    const glm::dvec2 rise = slab.slope - at.gradient;
    const glm::dvec2 a = rise * (glm::dvec2(footprint.begin) - center_of(window)),
                     b = rise * (glm::dvec2(footprint.last) - center_of(window));
    const glm::dvec2 low = glm::min(a, b), high = glm::max(a, b);
    double receiver = at.depth + glm::dot(at.gradient, center_of(window) + 0.5 - at.u);
    // Lookups compare with depth 0 where the receiver's plane lies behind everything. One that is level does everywhere.
    if (at.gradient == glm::dvec2(0)) receiver = std::max(receiver, 0.0);  // NaN stays
    if (receiver >= slab.greatest + high.x + high.y) return Answer::lit;
    if (!(receiver < slab.least + low.x + low.y)) return Answer::expensive;
    const bool is_drawn = at.gradient == glm::dvec2(0) || extremes_of(maps, at, window).least > 0;
    return is_drawn ? Answer::shadowed : Answer::expensive;
}

}  // namespace strata::shadows
