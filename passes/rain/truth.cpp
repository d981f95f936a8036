#include "passes/rain/truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <tbb/parallel_for.h>
#include <glm/gtc/quaternion.hpp>

#include "capture_format/frame/frame.h"
#include "passes/rain/formulas.h"
#include "passes/rain/look.h"
#include "passes/reference/decoded.h"
#include "passes/reference/directions.h"
#include "passes/reference/rays.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

// Farther than anything casts: of a scene in meters.
constexpr double above_everything = 1e6;

/// Calls visit(texel, surface) for every surface of the images before the stage; rows run in parallel.
template <typename Visit>
void for_every_surface(const StageInput& input, const Visit& visit) {
    const ReferenceImage &normal = input.before.at("surface_normal"), &color = input.before.at("surface_color"),
                         &material = input.before.at("surface_material");
    tbb::parallel_for(0u, normal.height * normal.layers, [&](std::uint32_t row) {
        for (std::uint32_t x = 0; x < normal.width; ++x) {
            const std::size_t i = std::size_t(row) * normal.width + x;
            if (normal.texels[i].w <= 0) continue;
            const DecodedTexels texels{normal.texels[i], color.texels[i], material.texels[i]};
            visit(i, decoded_surface(input.frame, texels, x, row % normal.height));
        }
    });
}

std::vector<glm::dvec3> recorded_direction(const StageInput& input) { return {glm::dvec3(input.frame.rain.direction)}; }

/// All around the recorded direction.
std::vector<glm::dvec3> turning_directions(const StageInput& input) {
    constexpr int count = 64;
    const glm::dvec3 mean = glm::normalize(glm::dvec3(input.frame.rain.direction));
    const glm::dvec3 aside = glm::normalize(glm::cross(mean, std::abs(mean.x) < .5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1)));
    const glm::dvec3 tilted = glm::angleAxis(glm::radians(rain::wind_spread), aside) * mean;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < count; ++i) directions.push_back(glm::angleAxis(2 * std::numbers::pi * i / count, mean) * tilted);
    return directions;
}

ImageSet wet_images(const StageInput& input, const rain::Look& look, const std::vector<glm::dvec3>& directions) {
    if (!input.before.contains("surface_normal")) return {};
    const ReferenceImage arriving = rain::traced_rain(input, directions);
    ImageSet images{{"surface_color", input.before.at("surface_color")},
                    {"surface_normal", input.before.at("surface_normal")},
                    {"surface_material", input.before.at("surface_material")}};
    for_every_surface(input, [&](std::size_t i, const SurfacePoint& dry) {
        const SurfacePoint wet = rain::wet_surface(input.frame, dry, look, arriving.texels[i].x);
        images.at("surface_color").texels[i] = glm::dvec4(wet.base_color, wet.roughness);
        images.at("surface_normal").texels[i] = glm::dvec4(wet.normal, images.at("surface_normal").texels[i].w);
    });
    return images;
}

}  // namespace

namespace rain {

ReferenceImage traced_rain(const StageInput& input, std::span<const glm::dvec3> directions) {
    const RayScene scene(input.frame, RayMask::shadow_casters);
    const ReferenceImage& shape = input.before.at("surface_normal");
    ReferenceImage arriving(shape.width, shape.height, shape.layers);
    for_every_surface(input, [&](std::size_t i, const SurfacePoint& p) {
        const glm::dvec3 start = off_surface_of_depth(p.position, facing_normal(p));
        const auto arrives = [&](const glm::dvec3& direction) {
            return scene.clear(start, -(input.frame.view.to_view * direction), 0, above_everything);
        };
        arriving.texels[i].x = double(std::ranges::count_if(directions, arrives)) / double(directions.size());
    });
    return arriving;
}

}  // namespace rain

ImageSet rain_truth(const StageInput& input) { return wet_images(input, {}, recorded_direction(input)); }

ImageSet xray_rain_truth(const StageInput& input) {
    return wet_images(input, {.form = rain::form_xray}, recorded_direction(input));
}

ImageSet rain_in_wind_truth(const StageInput& input) { return wet_images(input, {}, turning_directions(input)); }

ImageSet xray_rain_in_wind_truth(const StageInput& input) {
    return wet_images(input, {.form = rain::form_xray}, turning_directions(input));
}

}  // namespace strata
