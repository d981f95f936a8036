// Which pixels need every sample shaded.
#include "passes/edges/truth.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string_view>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/raster.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"

namespace strata {

namespace {

constexpr std::array<std::string_view, 4> surface_images = {"gbuffer0", "gbuffer1", "gbuffer2", "emission"};

// Within one triangle all samples carry what was shaded at the pixel's center: they are equal to the bit. A mean of samples
// is no test: at 8 samples 46.7 % of pixels without an edge differ from theirs (docs/algorithms/deferred.md 3.2).
bool differs(const ReferenceImage& image, std::uint32_t x, std::uint32_t y) {
    // Bits and not numbers: zeros of both signs differ as words, and equal NaN do not.
    for (std::uint32_t sample = 1; sample < image.layers; ++sample) {
        if (std::memcmp(&image.at(x, y, sample), &image.at(x, y, 0), sizeof(glm::dvec4)) != 0) return true;
    }
    return false;
}

bool partly_covered(const ReferenceImage& depth, std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t sample = 1; sample < depth.layers; ++sample) {
        if ((depth.at(x, y, sample).x > 0) != (depth.at(x, y, 0).x > 0)) return true;
    }
    return false;
}

bool words_differ(const StageInput& input, std::uint32_t x, std::uint32_t y) {
    return std::ranges::any_of(surface_images, [&](std::string_view name) {
        const auto image = input.before.find(name);
        return image != input.before.end() && differs(image->second, x, y);
    });
}

/// Whether samples of equal words are read at different view depths: the layout has them from the depth buffer.
bool depths_differ(const StageInput& input, std::uint32_t x, std::uint32_t y) {
    const ReferenceImage& depth = input.before.at("depth_layers");
    if (depth.at(x, y).x <= 0) return false;
    const auto normal = input.before.find("surface_normal");
    if (normal == input.before.end()) return differs(depth, x, y);
    for (std::uint32_t sample = 1; sample < depth.layers; ++sample)
        if (normal->second.at(x, y, sample).w != normal->second.at(x, y, 0).w) return true;
    return false;
}

/// Whether the depths of all samples of the point's pixel are those of the triangle's plane.
bool is_plane_of_all(const StageInput& input, RasterPoint point, const RasterTriangle& triangle) {
    const ReferenceImage& depth = input.before.at("depth_layers");
    for (std::uint32_t sample = 0; sample < depth.layers; ++sample) {
        const glm::dvec2 at = glm::dvec2(point.x, point.y) + sample_position(depth.layers, sample);
        point.depth = double(input.frame.view.near) * triangle.rays.inverse_z(pixel_ray(input.frame, at.x, at.y));
        if (std::abs(depth.at(point.x, point.y, sample).x - point.depth) > depth_tolerance(point)) return false;
    }
    return true;
}

/// Makes edges of those marked pixels whose samples lie on no common plane of a triangle.
void keep_steps_of_depth(const StageInput& input, ReferenceImage& edges) {
    if (std::ranges::none_of(edges.texels, [](const glm::dvec4& texel) { return texel.x != 0; })) return;
    const Raster raster(input.frame, opaque_draws(input.frame));
    oneapi::tbb::parallel_for(std::uint32_t{0}, edges.height, [&](std::uint32_t y) {
        raster.row(y, {.near_misses = true, .near_seams = true}, [&](const RasterPoint& point, const RasterTriangle& triangle) {
            double& is_edge = edges.at(point.x, y).x;
            if (is_edge != 0 && is_plane_of_all(input, point, triangle)) is_edge = 0;
        });
    });
}

}  // namespace

ImageSet edges_truth(const StageInput& input) {
    const auto depth = input.before.find("depth_layers");
    if (depth == input.before.end() || depth->second.layers < 2) return {};
    ReferenceImage none(depth->second.width, depth->second.height, 1, glm::dvec4(0, 0, 0, 1));
    none.channels = 1;
    ReferenceImage edges = none, steps = none;
    for (std::uint32_t y = 0; y < edges.height; ++y) {
        for (std::uint32_t x = 0; x < edges.width; ++x) {
            edges.at(x, y).x = words_differ(input, x, y) || partly_covered(depth->second, x, y) ? 1 : 0;
            if (edges.at(x, y).x == 0 && depths_differ(input, x, y)) steps.at(x, y).x = 1;
        }
    }
    keep_steps_of_depth(input, steps);
    for (std::size_t i = 0; i < edges.texels.size(); ++i) edges.texels[i].x = std::max(edges.texels[i].x, steps.texels[i].x);
    return {{"edges", edges}};
}

}  // namespace strata
