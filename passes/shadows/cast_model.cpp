#include "passes/shadows/cast_model.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/gbuffer/coverage/mask_tests.h"
#include "passes/reference/fragments.h"
#include "passes/reference/pcg.h"
#include "passes/reference/textures.h"
#include "passes/reference/triangles.h"

namespace strata::shadows {
namespace {

// Texels by which the ends of a side may move where positions snap to 1/256.
constexpr double snap = 1.5 / 256;
// Of the device's depth: positions up to 100 m away as floats, over a depth range of as many meters.
constexpr double depth_rounding = 2e-6;

/// What a texel holds so far.
struct Texel {
    double nearest = 0;   ///< depth of the casters that are there
    double slack = 0;     ///< of that depth: where positions snap, it is another place's
    double certain = 0;   ///< nearest of those that are there whatever is rounded
    double doubtful = 0;  ///< nearest of the others
};

struct Depths {
    double middle = 0, least = 0, most = 0;
};

/// Columns and rows, both ends included.
struct Texels {
    glm::ivec2 low{0}, high{0};
};

class Caster {
public:
    Caster(const CasterMap& map, const Corners& corners) : size_(map.size) {
        for (std::size_t k = 0; k < 3; ++k) at_[k] = map.view_to_map * glm::dvec4(corners[k], 1);
    }

    /// Of the point of the triangle's plane that a place of the map sees, in texels: the sums of b (u w - x) and b (v w - y) over
    /// the corners are 0.
    glm::dvec3 barycentric(glm::dvec2 place) const {
        const glm::dvec2 uv = place / double(size_);
        glm::dvec3 across, down;
        for (int k = 0; k < 3; ++k) {
            const glm::dvec4& corner = at_[std::size_t(k)];
            across[k] = corner.x - uv.x * corner.w;
            down[k] = corner.y - uv.y * corner.w;
        }
        const glm::dvec3 b = glm::cross(across, down);
        return b / (b.x + b.y + b.z);
    }

    /// At the middle of a texel, and the least and the most of all places to which rounding may move it.
    Depths depths(glm::uvec2 texel) const {
        const glm::dvec2 middle = glm::dvec2(texel) + 0.5;
        const double here = depth(barycentric(middle));
        Depths found{here, here, here};
        for (const glm::dvec2 aside : {glm::dvec2(-snap), {snap, -snap}, {-snap, snap}, glm::dvec2(snap)}) {
            const double there = depth(barycentric(middle + aside));
            found.least = std::min(found.least, there);
            found.most = std::max(found.most, there);
        }
        return found;
    }

    /// Those of the map that the triangle may touch: all where a corner lies behind the light.
    Texels bounds() const {
        const auto last = static_cast<double>(size_) - 1;
        if (std::min({at_[0].w, at_[1].w, at_[2].w}) <= 0) return {glm::ivec2(0), glm::ivec2(int(size_) - 1)};
        glm::dvec2 low(HUGE_VAL), high(-HUGE_VAL);
        for (const glm::dvec4& corner : at_) {
            const glm::dvec2 place = glm::dvec2(corner.x, corner.y) / corner.w * double(size_);
            low = glm::min(low, place);
            high = glm::max(high, place);
        }
        return {glm::ivec2(glm::clamp(glm::floor(low - 1.0), 0.0, last + 1)),
                glm::ivec2(glm::clamp(glm::ceil(high), -1.0, last))};
    }

private:
    /// Depth there; none outside of the triangle or of the map's range.
    double depth(const glm::dvec3& b) const {
        if (!(std::min({b.x, b.y, b.z}) >= 0)) return 0;
        const glm::dvec4 point = b.x * at_[0] + b.y * at_[1] + b.z * at_[2];
        const double depth = point.z / point.w;
        return point.w > 0 && depth <= 1 ? std::max(depth, 0.0) : 0;
    }

    std::uint32_t size_;
    std::array<glm::dvec4, 3> at_;
};

/// A triangle of a draw, with what its alpha test asks.
class MaskedCaster {
public:
    MaskedCaster(const Frame& frame, std::uint32_t draw, std::uint32_t triangle)
        : frame_(&frame), material_(material_of(frame, draw)), draw_(draw), triangle_(triangle) {}

    bool has_holes() const { return material_->alpha_mode == AlphaMode::mask; }

    MaskCover cover(const gbuffer::PointMaskTest& test, const Caster& caster, glm::uvec2 texel, glm::uvec2 in_layer) const {
        const glm::dvec2 middle = glm::dvec2(texel) + 0.5;
        // The neighbors in the texel's quad, which begin at even texels of the layer.
        const double side_x = in_layer.x % 2 == 0 ? 1 : -1, side_y = in_layer.y % 2 == 0 ? 1 : -1;
        const glm::dvec3 here = alpha_parts(caster.barycentric(middle));
        const glm::dvec3 along_x = side_x * (alpha_parts(caster.barycentric(middle + glm::dvec2(side_x, 0))) - here);
        const glm::dvec3 along_y = side_y * (alpha_parts(caster.barycentric(middle + glm::dvec2(0, side_y))) - here);
        const gbuffer::MaskPoint point{
            .uv = here, .uv_x = along_x, .uv_y = along_y, .vertex = here.z, .vertex_x = along_x.z, .vertex_y = along_y.z};
        const std::uint32_t first = corner_indices(*frame_, draw_, triangle_)[0];
        if (!test) return gbuffer::cover_by_cutoff(gbuffer::alpha_at(*frame_, *material_, point), dither_step(in_layer, first));
        return test(*material_, point, {.x = in_layer.x, .y = in_layer.y, .draw = draw_, .triangle = first});
    }

private:
    /// Bayer's matrix (1973), whose rows and columns change places by the surface.
    double dither_step(glm::uvec2 texel, std::uint32_t triangle) const {
        constexpr int bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
        const std::uint32_t surface = pcg(pcg(draw_) + triangle);
        return (bayer[(texel.y ^ surface >> 2) % 4][(texel.x ^ surface) % 4] + 0.5) / 16;
    }

    /// uv of the base color's texture, and the alpha of the vertices' colors.
    glm::dvec3 alpha_parts(const glm::dvec3& barycentric) const {
        const TextureUse& use = material_->base_color_texture;
        const Attributes a = attributes_at(*frame_, draw_, triangle_, barycentric);
        return {transformed(use, a.uv[use.uv_set == 0 ? 0 : 1]), a.color.w};
    }

    const Frame* frame_;
    const Material* material_;
    std::uint32_t draw_, triangle_;
};

class Map {
public:
    Map(const Frame& frame, const CasterMap& map, std::uint32_t mask)
        : map_(&map),
          test_(mask == gbuffer::masked_dithered ? nullptr : gbuffer::point_mask_model(frame, mask)),
          texels_(std::size_t(map.size) * map.size) {}

    void draw(const Caster& caster, const MaskedCaster& masked) {
        const Texels touched = caster.bounds();
        oneapi::tbb::parallel_for(touched.low.y, touched.high.y + 1, [&](int y) {
            for (int x = touched.low.x; x <= touched.high.x; ++x) draw_texel(caster, masked, {x, y});
        });
    }

    ReferenceImage image() const {
        ReferenceImage made(map_->size, map_->size, 1, glm::dvec4(0, 0, 0, 1));
        made.undecided.resize(texels_.size());
        for (std::size_t i = 0; i < texels_.size(); ++i) {
            const Texel& drawn = texels_[i];
            made.texels[i].x = drawn.nearest;
            made.texels[i].y = drawn.slack + depth_rounding;
            made.undecided[i] = drawn.doubtful > drawn.certain + depth_rounding;
        }
        return made;
    }

private:
    void draw_texel(const Caster& caster, const MaskedCaster& masked, glm::uvec2 texel) {
        const Depths depths = caster.depths(texel);
        if (depths.most <= 0) return;
        const MaskCover cover = masked.has_holes() ? masked.cover(test_, caster, texel, texel + map_->offset) : MaskCover::kept;
        if (cover == MaskCover::cut) return;
        Texel& at = texels_[std::size_t(texel.y) * map_->size + texel.x];
        if (depths.least > 0 && cover == MaskCover::kept) at.certain = std::max(at.certain, depths.least);
        else at.doubtful = std::max(at.doubtful, depths.most);
        if (cover == MaskCover::maybe_cut || depths.middle <= at.nearest) return;
        at.nearest = depths.middle;
        at.slack = depths.most - std::max(depths.least, 0.0);
    }

    const CasterMap* map_;
    gbuffer::PointMaskTest test_;  ///< empty: alpha is dithered
    std::vector<Texel> texels_;
};

}  // namespace

ReferenceImage cast_model(const Frame& frame, const CasterMap& map, std::uint32_t mask) {
    Map drawn(frame, map, mask);
    for (const std::uint32_t draw : opaque_draws(frame)) {
        if (!frame.draws[draw].casts_shadow) continue;
        const DrawSpace space = draw_space(frame, draw);
        for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle)
            drawn.draw({map, view_corners(frame, space, draw, triangle)}, {frame, draw, triangle});
    }
    return drawn.image();
}

}  // namespace strata::shadows
