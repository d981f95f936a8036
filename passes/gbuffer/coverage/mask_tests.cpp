#include "passes/gbuffer/coverage/mask_tests.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "passes/gbuffer/coverage/bands.h"
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/reference/shade.h"
#include "passes/reference/textures.h"
#include "passes/reference/triangles.h"

namespace strata::gbuffer {
namespace {

// A float that filters a texture is this near at least (passes/reference/visible_points.cpp).
constexpr double rounding = 1.0 / 2048;

MaskPoint mask_point_at(const Frame& frame, const RasterPoint& point) {
    const Corners corners = view_corners(frame, draw_space(frame, point.draw), point.draw, point.triangle);
    const TextureUse& use = material_of(frame, point.draw)->base_color_texture;
    const glm::dvec3& b = point.barycentric;
    const glm::dvec3 position = b.x * corners[0] + b.y * corners[1] + b.z * corners[2];
    const TriangleRays rays(corners);
    const auto at = [&](const glm::dvec3& where) {
        const Attributes a = attributes_at(frame, point.draw, point.triangle, where);
        return glm::dvec3(transformed(use, a.uv[use.uv_set == 0 ? 0 : 1]), a.color.w);
    };
    const double sign_x = point.x % 2 == 0 ? 1 : -1, sign_y = point.y % 2 == 0 ? 1 : -1;
    const glm::dvec2 step(2 / (double(frame.view.width) * double(frame.view.projection[0][0])),
                          2 / (double(frame.view.height) * double(frame.view.projection[1][1])));
    const glm::dvec3 ray = position / position.z, here = at(b);
    const glm::dvec3 along_x = sign_x * (at(rays.barycentric(ray + glm::dvec3(sign_x * step.x, 0, 0))) - here);
    const glm::dvec3 along_y = sign_y * (at(rays.barycentric(ray + glm::dvec3(0, sign_y * step.y, 0))) - here);
    return {.uv = here, .uv_x = along_x, .uv_y = along_y, .vertex = here.z, .vertex_x = along_x.z, .vertex_y = along_y.z};
}

MaskCover decided(bool with_less, bool with_more, bool exactly) {
    if (with_less == with_more) return exactly ? MaskCover::kept : MaskCover::cut;
    return exactly ? MaskCover::maybe_kept : MaskCover::maybe_cut;
}

/// So many pixels from the point, over a footprint so many pixels wide.
double alpha_beside(const Frame& frame, const Material& material, const MaskPoint& l, glm::dvec2 pixels, double width) {
    const double own = double(material.base_color.w) * (l.vertex + pixels.x * l.vertex_x + pixels.y * l.vertex_y);
    if (material.base_color_texture.texture == no_index) return own;
    const Texture& texture = frame.textures[material.base_color_texture.texture];
    const glm::dvec2 uv = l.uv + pixels.x * l.uv_x + pixels.y * l.uv_y;
    return own * filtered(texture, uv, level_of_detail(texture, width * l.uv_x, width * l.uv_y)).w;
}

class Model {
public:
    Model(const Frame& frame, std::uint32_t mode, ShadeAt shade_at) : frame_(&frame), mode_(mode), shade_at_(shade_at) {
        if (mode != masked_mip_coverage) return;
        for (const Material& material : frame.materials)
            if (material.alpha_mode == AlphaMode::mask)
                for (std::uint32_t mip = 0; mip < mask_scale_mips; ++mip)
                    scales_[&material].push_back(mip_scale_model(frame, material, mip));
    }

    MaskCover operator()(const RasterPoint& point) const {
        const MaskPoint here = mask_point_at(*frame_, point);
        const Material& material = *material_of(*frame_, point.draw);
        switch (mode_) {
            case masked_per_sample:
                return against_cutoff(material, alpha(material, here, own_place(point), 1));
            case masked_per_sample_fine:
                return against_cutoff(material,
                                      alpha(material, here, own_place(point), 1 / std::sqrt(double(frame_->view.samples))));
            case masked_mip_coverage:
                return by_scaled_alpha(material, here);
            case masked_hardware:
                return by_device(material, here, shade_at_ == ShadeAt::sample ? -sample_offset(point) : glm::dvec2(0));
            default:
                return by_bands(material, here, place_of(point), {.at = point.sample, .of = frame_->view.samples});
        }
    }

    /// Of one sample per pixel.
    MaskCover at_point(const Material& material, const MaskPoint& here, const BandPlace& place) const {
        if (mode_ == masked_clip) return against_cutoff(material, alpha(material, here, {}, 1));
        if (mode_ == masked_mip_coverage) return by_scaled_alpha(material, here);
        return by_bands(material, here, place, {.at = 0, .of = 1});
    }

private:
    struct Sample {
        std::uint32_t at, of;
    };

    BandPlace place_of(const RasterPoint& p) const {
        return {.x = p.x, .y = p.y, .draw = p.draw, .triangle = corner_indices(*frame_, p.draw, p.triangle)[0]};
    }

    glm::dvec2 own_place(const RasterPoint& point) const {
        if (shade_at_ == ShadeAt::sample) return {};
        return sample_offset(point);
    }

    /// From the pixel's center.
    glm::dvec2 sample_offset(const RasterPoint& point) const { return sample_position(frame_->view.samples, point.sample) - 0.5; }

    /// Vulkan says what alphas of 0 and 1 cover and leaves the others to the device. Alpha is the pixel center's, which lies so
    /// many pixels from here; a filter that a float puts a little aside must say the same.
    MaskCover by_device(const Material& material, const MaskPoint& l, glm::dvec2 center) const {
        constexpr double aside = 0.05;
        bool none = true, all = true;
        for (const glm::dvec2 step : {glm::dvec2(0), {aside, 0}, {-aside, 0}, {0, aside}, {0, -aside}})
            for (const double width : {1 - aside, 1 + aside}) {
                const double a = alpha(material, l, center + step, width);
                none = none && a <= 0;
                all = all && a >= 1 - 1e-9;
            }
        if (none || all) return all ? MaskCover::kept : MaskCover::cut;
        return alpha(material, l, center, 1) >= double(material.mask_cutoff) ? MaskCover::maybe_kept : MaskCover::maybe_cut;
    }

    double alpha(const Material& material, const MaskPoint& l, glm::dvec2 pixels, double width) const {
        return alpha_beside(*frame_, material, l, pixels, width);
    }

    double scale(const Material& material, const MaskPoint& l) const {
        if (material.base_color_texture.texture == no_index) return 1;
        const Texture& texture = frame_->textures[material.base_color_texture.texture];
        const double most = std::min(texture.mips, mask_scale_mips) - 1;
        const double lod = std::clamp(level_of_detail(texture, l.uv_x, l.uv_y), 0.0, most);
        const std::vector<double>& of = scales_.at(&material);
        const auto fine = static_cast<std::size_t>(lod);
        return glm::mix(of[fine], of[std::min<std::size_t>(fine + 1, mask_scale_mips - 1)], lod - double(fine));
    }

    static MaskCover against_cutoff(const Material& material, double alpha) {
        return cover_by_cutoff(alpha, material.mask_cutoff);
    }

    MaskCover by_scaled_alpha(const Material& material, const MaskPoint& l) const {
        return against_cutoff(material, alpha(material, l, {}, 1) * scale(material, l));
    }

    MaskCover by_bands(const Material& material, const MaskPoint& l, const BandPlace& place, Sample sample) const {
        const double here = alpha(material, l, {}, 1);
        double change = 1;
        if (mode_ == masked_sharpened)
            change =
                std::max(1e-4, std::abs(alpha(material, l, {1, 0}, 1) - here) + std::abs(alpha(material, l, {0, 1}, 1) - here));
        const auto covers = [&](double a) {
            if (mode_ == masked_sharpened) a = std::clamp((a - double(material.mask_cutoff)) / change + 0.5, 0.0, 1.0);
            return (sample_mask(mode_, sample.of, a, place) >> sample.at & 1u) != 0;
        };
        // Patterns of one more sample need not hold those of one less, and a steepened alpha passes several bands.
        const bool exactly = covers(here);
        bool agrees = true;
        for (int step = -4; step <= 4; ++step) agrees &= covers(here + step * rounding / 4) == exactly;
        return decided(exactly, agrees == exactly, exactly);
    }

    const Frame* frame_;
    std::uint32_t mode_;
    ShadeAt shade_at_;
    std::map<const Material*, std::vector<double>> scales_;
};

/// Alphas of a mip's texels.
std::vector<double> alphas_of(const Texture& texture, std::uint32_t mip) {
    std::vector<double> alphas;
    for (std::uint32_t y = 0; y < std::max(1u, texture.height >> mip); ++y)
        for (std::uint32_t x = 0; x < std::max(1u, texture.width >> mip); ++x) alphas.push_back(texel(texture, mip, x, y).w);
    return alphas;
}

}  // namespace

double alpha_at(const Frame& frame, const Material& material, const MaskPoint& point) {
    return alpha_beside(frame, material, point, {}, 1);
}

MaskCover cover_by_cutoff(double alpha, double cutoff) {
    return decided(alpha - rounding >= cutoff, alpha + rounding >= cutoff, alpha >= cutoff);
}

double mip_scale_model(const Frame& frame, const Material& material, std::uint32_t mip) {
    const std::uint32_t number = material.base_color_texture.texture;
    if (number == no_index || !(material.base_color.w > 0)) return 1;
    const Texture& texture = frame.textures[number];
    const double cutoff = double(material.mask_cutoff) / double(material.base_color.w);
    const auto share = [](const std::vector<double>& alphas, double least) {
        return double(std::ranges::count_if(alphas, [&](double a) { return a >= least; })) / double(alphas.size());
    };
    const double wanted = share(alphas_of(texture, 0), cutoff);
    mip = std::min(mip, texture.mips - 1);
    if (mip == 0 || wanted == 0 || wanted == 1) return 1;
    // Every threshold that parts different alphas, from the lowest up, one below all of them and one above all of them.
    std::vector<double> alphas = alphas_of(texture, mip), levels = alphas;
    std::ranges::sort(levels);
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    std::vector<double> thresholds{levels.front() * (1 - 1e-3)};
    for (std::size_t i = 1; i < levels.size(); ++i) thresholds.push_back((levels[i] + levels[i - 1]) / 2);
    thresholds.push_back(levels.back() * (1 + 1e-3));
    const auto best = std::ranges::min_element(thresholds, {}, [&](double t) { return std::abs(share(alphas, t) - wanted); });
    return *best > 0 ? cutoff / *best : 1;
}

PointMaskTest point_mask_model(const Frame& frame, std::uint32_t mode) {
    const auto model = std::make_shared<const Model>(frame, mode, ShadeAt::pixel_center);
    return [model](const Material& material, const MaskPoint& point, const BandPlace& place) {
        return model->at_point(material, point, place);
    };
}

MaskTest mask_model(const Frame& frame, std::uint32_t mode, ShadeAt shade_at) {
    // One sample has nothing to share out: see declare_coverage().
    if (mode == masked_clip || (mode == masked_hardware && frame.view.samples == 1)) return cutoff_test(frame);
    return [model = std::make_shared<const Model>(frame, mode, shade_at)](const RasterPoint& point) { return (*model)(point); };
}

}  // namespace strata::gbuffer
