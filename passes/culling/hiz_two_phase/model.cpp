// The answer in double. It does not depend on what was visible before: after phase 2 the depth of all that occludes is complete,
// so the model rasterizes all of it (in one phase, the largest alone) and tests every draw once.
#include "passes/culling/hiz_two_phase/model.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/culling/hiz_two_phase/hiz_two_phase_params.h"
#include "passes/culling/view_planes.h"
#include "passes/culling/visible_image.h"
#include "passes/reference/fragments.h"
#include "passes/reference/raster.h"
#include "passes/reference/shade.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::culling {
namespace {

/// Smallest and largest a / z over a circle around (along, z), all of it in front: the tangents through the eye, which are the
/// direction to its center turned by the angle whose sine is radius over distance.
glm::dvec2 slopes(double along, double z, double radius) {
    const double tangent = std::sqrt(along * along + z * z - radius * radius);
    return {(tangent * along - radius * z) / (tangent * z + radius * along),
            (tangent * along + radius * z) / (tangent * z - radius * along)};
}

/// What the device's rounding may make of a draw's test: spheres and pixels a little smaller or larger.
struct Rounding {
    double slack;   ///< of bound_slack
    double pixels;  ///< beside pixel_slack
    double depth;   ///< beside depth_slack, relative
};
constexpr Rounding toward_hidden{0.5, -2e-3, -4e-6}, toward_visible{1.5, 2e-3, 4e-6};

Sphere padded(const Sphere& sphere, double slack) {
    return {sphere.center, sphere.radius + slack * double(bound_slack) * size_with_distance(sphere)};
}

bool is_drawn(const View& view, const Sphere& exact, const DepthPyramid& pyramid, std::uint32_t across, Rounding rounding) {
    const Sphere sphere = padded(exact, rounding.slack);
    if (reach_into_view(view, sphere) < 0) return false;
    std::optional<SphereBounds> bounds = bounds_in_picture(view, sphere);
    if (!bounds) return true;
    bounds->low -= double(pixel_slack) + rounding.pixels;
    bounds->high += double(pixel_slack) + rounding.pixels;
    const PixelRange pixels = pixels_of(view, *bounds);
    if (pixels.empty()) return false;
    return bounds->nearest * (1 + double(depth_slack) + rounding.depth) >= pyramid.farthest(pixels, across);
}

/// Depth per pixel, its farthest sample's: at least, of samples that are surely covered, and at most.
struct PictureDepth {
    std::vector<double> least, most;
};

PictureDepth picture_depth(const Frame& frame, const std::vector<std::uint32_t>& draws) {
    const View& view = frame.view;
    const std::size_t pixels = std::size_t(view.width) * view.height;
    PictureDepth depth{std::vector<double>(pixels, 1e300), std::vector<double>(pixels, 1e300)};
    const Raster raster(frame, draws);
    oneapi::tbb::parallel_for(std::uint32_t{0}, view.height, [&](std::uint32_t y) {
        std::vector<double> least(std::size_t(view.width) * view.samples), most(least.size());
        raster.row(y, {.near_misses = true}, [&](const RasterPoint& point, const RasterTriangle&) {
            const std::size_t slot = std::size_t(point.x) * view.samples + point.sample;
            const double tolerance = depth_tolerance(point);
            most[slot] = std::max(most[slot], point.depth + tolerance);
            if (!point.undecided) least[slot] = std::max(least[slot], point.depth - tolerance);
        });
        for (std::size_t slot = 0; slot < least.size(); ++slot) {
            const std::size_t pixel = std::size_t(y) * view.width + slot / view.samples;
            depth.least[pixel] = std::min(depth.least[pixel], least[slot]);
            depth.most[pixel] = std::min(depth.most[pixel], most[slot]);
        }
    });
    return depth;
}

bool occludes(const Frame& frame, std::uint32_t draw) { return material_of(frame, draw)->alpha_mode == AlphaMode::opaque; }

/// The bin of a draw in view, or none.
std::optional<std::uint32_t> bin_of(const View& view, const Sphere& exact, Rounding rounding) {
    const Sphere sphere = padded(exact, rounding.slack);
    if (reach_into_view(view, sphere) < 0) return {};
    if (sphere.center.z - sphere.radius < double(view.near)) return size_bins - 1;
    return size_bin(sphere.radius / sphere.center.z * (1 + rounding.depth));
}

/// The largest draws, by whole bins from the largest on, at least one bin and at most so many draws in more than one.
std::uint32_t smallest_chosen_bin(const std::array<std::uint32_t, size_bins>& sizes, std::uint32_t occluders) {
    std::uint32_t smallest = size_bins, sum = 0;
    for (std::uint32_t bin = size_bins; bin-- > 0;) {
        if (sum > 0 && sum + sizes[bin] > occluders) break;
        sum += sizes[bin];
        smallest = bin;
    }
    return smallest;
}

/// What is drawn as occluders: surely, and perhaps.
struct Occluders {
    std::vector<std::uint32_t> surely, perhaps;
};

Occluders largest_draws(const Frame& frame, const std::vector<std::uint32_t>& draws, std::uint32_t occluders) {
    std::array<std::uint32_t, size_bins> fewest{}, most{};
    const auto count = [](auto& sizes, std::optional<std::uint32_t> bin) {
        if (bin) ++sizes[*bin];
    };
    const auto bin = [&](std::uint32_t draw, Rounding rounding) {
        return bin_of(frame.view, bounding_sphere(frame, draw), rounding);
    };
    for (const std::uint32_t draw : draws) {
        count(fewest, bin(draw, toward_hidden));
        count(most, bin(draw, toward_visible));
    }
    const std::uint32_t one = smallest_chosen_bin(fewest, occluders), other = smallest_chosen_bin(most, occluders);
    Occluders chosen;
    for (const std::uint32_t draw : draws) {
        const auto small = bin(draw, toward_hidden), large = bin(draw, toward_visible);
        if (small && *small >= std::max(one, other)) chosen.surely.push_back(draw);
        if (large && *large >= std::min(one, other)) chosen.perhaps.push_back(draw);
    }
    return chosen;
}

}  // namespace

std::optional<SphereBounds> bounds_in_picture(const View& view, const Sphere& sphere) {
    const double nearest_z = sphere.center.z - sphere.radius;
    if (nearest_z < double(view.near)) return {};
    const glm::dmat4 p(view.projection);
    const glm::dvec2 extent(view.width, view.height);
    SphereBounds bounds{.nearest = double(view.near) / nearest_z};
    for (int axis = 0; axis < 2; ++axis) {
        const double offset = p[2][axis] + double(view.jitter[axis]);
        const glm::dvec2 of_clip = slopes(sphere.center[axis], sphere.center.z, sphere.radius) * p[axis][axis] + offset;
        const glm::dvec2 pixels = (of_clip * 0.5 + 0.5) * extent[axis];
        bounds.low[axis] = std::min(pixels.x, pixels.y);
        bounds.high[axis] = std::max(pixels.x, pixels.y);
    }
    return bounds;
}

PixelRange pixels_of(const View& view, const SphereBounds& bounds) {
    glm::dvec2 least(1), most(0);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample) {
        least = glm::min(least, sample_position(view.samples, sample));
        most = glm::max(most, sample_position(view.samples, sample));
    }
    const glm::dvec2 extent(view.width, view.height);
    const glm::dvec2 first = glm::ceil(bounds.low - most), last = glm::floor(bounds.high - least);
    return {glm::ivec2(glm::clamp(first, glm::dvec2(0), extent)), glm::ivec2(glm::clamp(last, glm::dvec2(-1), extent - 1.0))};
}

DepthPyramid::DepthPyramid(std::uint32_t width, std::uint32_t height, std::vector<double> depth) {
    levels_.push_back({width, height, std::move(depth)});
    while (levels_.back().width > 1 || levels_.back().height > 1) {
        const Level& fine = levels_.back();
        Level coarse{(fine.width + 1) / 2, (fine.height + 1) / 2, {}};
        coarse.depth.assign(std::size_t(coarse.width) * coarse.height, 1e300);
        for (std::uint32_t y = 0; y < fine.height; ++y)
            for (std::uint32_t x = 0; x < fine.width; ++x) {
                double& texel = coarse.depth[std::size_t(y / 2) * coarse.width + x / 2];
                texel = std::min(texel, fine.at(x, y));
            }
        levels_.push_back(std::move(coarse));
    }
}

double DepthPyramid::farthest(const PixelRange& pixels, std::uint32_t across) const {
    const auto texels = [&](std::uint32_t level) { return (pixels.last >> int(level)) - (pixels.first >> int(level)) + 1; };
    std::uint32_t level = 0;
    while (std::max(texels(level).x, texels(level).y) > int(across)) ++level;
    double least = 1e300;
    for (int y = pixels.first.y >> level; y <= pixels.last.y >> level; ++y)
        for (int x = pixels.first.x >> level; x <= pixels.last.x >> level; ++x)
            least = std::min(least, levels_[level].at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
    return least;
}

std::uint32_t size_bin(double radius_over_depth) {
    const std::uint32_t bin = std::bit_cast<std::uint32_t>(static_cast<float>(radius_over_depth)) >> size_bin_shift;
    return std::clamp(bin, smallest_size_bin, smallest_size_bin + size_bins - 1) - smallest_size_bin;
}

ImageSet hiz_two_phase_model(const StageInput& input, const Settings& settings) {
    const auto params = settings.as<HizParams>();
    const Frame& frame = input.frame;
    const std::vector<std::uint32_t> draws = opaque_draws(frame);
    std::vector<std::uint32_t> all;
    std::ranges::copy_if(draws, std::back_inserter(all), [&](std::uint32_t draw) { return occludes(frame, draw); });
    const Occluders drawn = params.phases == phases_two ? Occluders{all, all} : largest_draws(frame, all, params.occluders);
    const View& view = frame.view;
    const DepthPyramid least(view.width, view.height, picture_depth(frame, drawn.surely).least);
    const DepthPyramid most(view.width, view.height, picture_depth(frame, drawn.perhaps).most);
    ReferenceImage visible(visible_width, visible_rows(draws.size()), 1, glm::dvec4(0, 0, 0, 1));
    visible.channels = 1;
    visible.undecided.assign(visible.texels.size(), false);
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Sphere sphere = bounding_sphere(frame, draws[i]);
        const bool at_most = is_drawn(view, sphere, least, params.across, toward_visible);
        visible.texels[i].x = at_most ? 1 : 0;
        visible.undecided[i] = at_most != is_drawn(view, sphere, most, params.across, toward_hidden);
    }
    return {{"visible", visible}};
}

}  // namespace strata::culling
