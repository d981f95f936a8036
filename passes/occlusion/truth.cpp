#include "passes/occlusion/truth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "passes/reference/decoded.h"
#include "passes/reference/directions.h"
#include "passes/reference/rays.h"

namespace strata {
namespace {

using occlusion::MaterialRule, occlusion::radii;

SurfacePoint sample_at(const StageInput& input, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    DecodedTexels texels{input.before.at("surface_normal").at(x, y, sample), {}, {}};
    texels.material = input.before.at("surface_material").at(x, y, sample);
    return decoded_surface(input.frame, texels, x, y);
}

/// A surface's place and side are all that visibility asks; of hair, the lighting model makes a side of the fibre.
bool is_first_again(const StageInput& input, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const ReferenceImage &normal = input.before.at("surface_normal"), &material = input.before.at("surface_material");
    return normal.at(x, y) == normal.at(x, y, sample) && material.at(x, y).x == material.at(x, y, sample).x;
}

/// The share of a batch of rays that nothing stops.
double share_of_clear_rays(const RayScene& scene, const SurfacePoint& at, double radius, std::span<const glm::dvec2> places) {
    const glm::dvec3 normal = facing_normal(at), start = ray_start(at.position, normal);
    std::size_t clear = 0;
    for (const glm::dvec2& place : places) clear += scene.clear(start, cosine_direction(normal, place), 0, radius);
    return double(clear) / double(places.size());
}

struct Estimate {
    double mean = 0, standard_error = 0;
};

Estimate estimate(std::span<const double> batches) {
    const double count = double(batches.size());
    Estimate result;
    for (const double batch : batches) result.mean += batch / count;
    double squares = 0;
    for (const double batch : batches) squares += (batch - result.mean) * (batch - result.mean);
    if (batches.size() > 1) result.standard_error = std::sqrt(squares / (count - 1) / count);
    return result;
}

template <std::size_t radius, MaterialRule rule>
ImageSet traced_truth(const StageInput& input) {
    ReferenceImage image = traced_visibility(input, radii[radius]);
    const ReferenceImage& material = input.before.at("surface_material");
    for (std::size_t i = 0; i < image.texels.size(); ++i)
        image.texels[i].x = occlusion_of(image.texels[i].x, material.texels[i].z, rule);
    return {{"occlusion", std::move(image)}};
}

constexpr std::array<Truth, 4> product = {traced_truth<0, MaterialRule::product>, traced_truth<1, MaterialRule::product>,
                                          traced_truth<2, MaterialRule::product>, traced_truth<3, MaterialRule::product>};
constexpr std::array<Truth, 4> darker = {traced_truth<0, MaterialRule::darker>, traced_truth<1, MaterialRule::darker>,
                                         traced_truth<2, MaterialRule::darker>, traced_truth<3, MaterialRule::darker>};
constexpr std::array<std::string_view, 4> product_is = {"visibility within 50 cm, traced in double, 576 directions per sample",
                                                        "visibility within 1 m, traced in double, 576 directions per sample",
                                                        "visibility within 2 m, traced in double, 576 directions per sample",
                                                        "visibility within 4 m, traced in double, 576 directions per sample"};
constexpr std::array<std::string_view, 4> darker_is = {
    "the darker of the material's occlusion and visibility within 50 cm, traced in double",
    "the darker of the material's occlusion and visibility within 1 m, traced in double",
    "the darker of the material's occlusion and visibility within 2 m, traced in double",
    "the darker of the material's occlusion and visibility within 4 m, traced in double"};

}  // namespace

double occlusion_of(double visibility, double material, MaterialRule rule) {
    if (rule == MaterialRule::product || !(material > 0)) return visibility;
    return std::min(1.0, visibility / material);
}

ReferenceImage traced_visibility(const StageInput& input, double radius, const TracedDirections& directions) {
    const RayScene scene(input.frame, RayMask::opaque);
    const ReferenceImage& normal = input.before.at("surface_normal");
    ReferenceImage visibility(normal.width, normal.height, normal.layers, glm::dvec4(1, 0, 0, 1));
    visibility.channels = 1;
    visibility.standard_error.resize(visibility.texels.size());
    const auto trace = [&](std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
        const SurfacePoint at = sample_at(input, x, y, sample);
        const std::size_t texel = normal.index(x, y, sample);
        std::vector<double> batches;
        for (std::uint32_t i = 0; i < directions.batches; ++i) {
            DrawnNumbers random(texel + 1, i + 1);
            batches.push_back(share_of_clear_rays(scene, at, radius, stratified(directions.side, random)));
        }
        const auto [mean, error] = estimate(batches);
        visibility.texels[texel].x = mean;
        visibility.standard_error[texel].x = error;
    };
    tbb::parallel_for(0u, normal.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < normal.width; ++x)
            for (std::uint32_t sample = 0; sample < normal.layers; ++sample) {
                if (normal.at(x, y, sample).w <= 0) continue;
                if (sample == 0 || !is_first_again(input, x, y, sample)) {
                    trace(x, y, sample);
                    continue;
                }
                visibility.at(x, y, sample) = visibility.at(x, y);
                visibility.standard_error[visibility.index(x, y, sample)] = visibility.standard_error[visibility.index(x, y)];
            }
    });
    return visibility;
}

ImageSet occlusion_truth(const StageInput& input) { return product[occlusion::default_radius](input); }

std::vector<TruthRow> other_occlusion_truths() {
    std::vector<TruthRow> rows;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (i != occlusion::default_radius)
            rows.push_back({.name = occlusion::product_truths[i], .make = product[i], .is = product_is[i]});
        rows.push_back({.name = occlusion::darker_truths[i], .make = darker[i], .is = darker_is[i]});
    }
    return rows;
}

}  // namespace strata
