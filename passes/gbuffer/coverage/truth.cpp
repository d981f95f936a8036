#include "passes/gbuffer/coverage/truth.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "passes/reference/fragments.h"
#include "passes/reference/pcg.h"
#include "passes/reference/raster.h"
#include "passes/reference/shade.h"
#include "passes/reference/surfaces.h"

namespace strata::gbuffer {
namespace {

// Along each side of a pixel.
constexpr std::uint32_t fine = 16;
// Steps of 1/256 from a place's middle to its corner, and to where a snapped corner may lie.
constexpr double place_radius = 184;

bool is_masked(const Frame& frame, std::uint32_t draw) {
    const Material* material = material_of(frame, draw);
    return material != nullptr && material->alpha_mode == AlphaMode::mask;
}

std::vector<std::uint32_t> masked_draws(const Frame& frame) {
    std::vector<std::uint32_t> draws = opaque_draws(frame);
    std::erase_if(draws, [&](std::uint32_t draw) { return !is_masked(frame, draw); });
    return draws;
}

std::vector<std::uint32_t> solid_draws(const Frame& frame) {
    std::vector<std::uint32_t> draws = opaque_draws(frame);
    std::erase_if(draws, [&](std::uint32_t draw) { return is_masked(frame, draw); });
    return draws;
}

/// A pixel for each place.
Frame with_fine_pixels(Frame frame) {
    frame.view.width *= fine;
    frame.view.height *= fine;
    frame.view.samples = 1;
    return frame;
}

/// Somewhere in the place, the same in every run.
glm::dvec2 jittered(std::uint32_t x, std::uint32_t y) {
    const std::uint32_t random = pcg(pcg(x) + y);
    return glm::dvec2(x, y) + (glm::dvec2(random & 0xffffu, random >> 16) + 0.5) / 65536.0;
}

/// Sums over each half of a pixel's places.
struct Counted {
    std::array<double, 2> area{}, alpha{};
};

struct Place {
    double solid = 0;  ///< depth of the nearest surface that is not masked
    bool is_covered = false;
    double passes = 1;  ///< product of 1 - alpha
};

class MaskCounter {
public:
    explicit MaskCounter(const Frame& frame)
        : frame_(with_fine_pixels(frame)),
          solid_(frame_, solid_draws(frame_), place_radius),
          masked_(frame_, masked_draws(frame_), place_radius) {}

    std::vector<Counted> pixels() const {
        const std::uint32_t width = frame_.view.width / fine, height = frame_.view.height / fine;
        std::vector<Counted> counted(std::size_t(width) * height);
        oneapi::tbb::parallel_for(std::uint32_t{0}, height, [&](std::uint32_t y) {
            for (std::uint32_t row = y * fine; row < (y + 1) * fine; ++row) {
                const std::vector<Place> places = row_of_places(row);
                for (std::uint32_t x = 0; x < places.size(); ++x) {
                    Counted& pixel = counted[std::size_t(y) * width + x / fine];
                    const std::size_t half = (x + row) % 2;
                    pixel.area[half] += places[x].is_covered ? 1 : 0;
                    pixel.alpha[half] += 1 - places[x].passes;
                }
            }
        });
        return counted;
    }

private:
    std::vector<glm::dvec3> rays_of_row(std::uint32_t y) const {
        std::vector<glm::dvec3> rays;
        for (std::uint32_t x = 0; x < frame_.view.width; ++x) {
            const glm::dvec2 at = jittered(x, y);
            rays.push_back(pixel_ray(frame_, at.x, at.y));
        }
        return rays;
    }

    /// Calls visit(point, depth, barycentric) for every triangle that the ray of a place meets, which is not its middle's.
    template <typename Visit>
    void meet(const Raster& raster, std::uint32_t y, const std::vector<glm::dvec3>& rays, const Visit& visit) const {
        raster.row(y, {.near_misses = true, .near_seams = true}, [&](const RasterPoint& point, const RasterTriangle& triangle) {
            const double depth = double(frame_.view.near) * triangle.rays.inverse_z(rays[point.x]);
            const glm::dvec3 barycentric = triangle.rays.barycentric(rays[point.x]);
            const bool is_inside = std::min({barycentric.x, barycentric.y, barycentric.z}) >= 0;
            if (is_inside && depth > 0 && depth <= 1) visit(point, depth, barycentric);
        });
    }

    std::vector<Place> row_of_places(std::uint32_t y) const {
        std::vector<Place> places(frame_.view.width);
        const std::vector<glm::dvec3> rays = rays_of_row(y);
        meet(solid_, y, rays, [&](const RasterPoint& point, double depth, const glm::dvec3&) {
            places[point.x].solid = std::max(places[point.x].solid, depth);
        });
        meet(masked_, y, rays, [&](const RasterPoint& point, double depth, const glm::dvec3& barycentric) {
            Place& place = places[point.x];
            if (depth <= place.solid) return;
            const double alpha = alpha_at(frame_, point.draw, point.triangle, barycentric);
            place.is_covered = place.is_covered || reaches_cutoff(alpha, *material_of(frame_, point.draw));
            place.passes *= 1 - std::clamp(alpha, 0.0, 1.0);
        });
        return places;
    }

    Frame frame_;
    Raster solid_, masked_;
};

}  // namespace

bool has_masks(const Frame& frame) {
    return std::ranges::any_of(opaque_draws(frame), [&](std::uint32_t draw) { return is_masked(frame, draw); });
}

void add_true_coverage(ImageSet& truth, const Frame& frame) {
    if (!has_masks(frame)) return;
    const VisiblePoints behind = visible_points(frame, solid_draws(frame), {.shade_at = ShadeAt::sample});
    const std::vector<Counted> counted = MaskCounter(frame).pixels();
    constexpr double places = fine * fine;
    ReferenceImage& depth = truth.at("depth_layers");
    depth.standard_error.resize(depth.texels.size());
    for (std::size_t i = 0; i < depth.texels.size(); ++i) {
        const auto& [area, alpha] = counted[i % counted.size()];
        depth.texels[i].y = (area[0] + area[1]) / places;
        depth.texels[i].z = (alpha[0] + alpha[1]) / places;
        depth.texels[i].w = behind.points[i].depth;
        depth.standard_error[i] = {0, std::abs(area[0] - area[1]) / places, std::abs(alpha[0] - alpha[1]) / places};
    }
}

}  // namespace strata::gbuffer
