#include "passes/occlusion/truth.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "passes/reference/estimated_image.h"
#include "passes/reference/rays.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

using occlusion::MaterialRule, occlusion::radii;

/// The share of a batch of rays that nothing stops.
double share_of_clear_rays(const RayScene& scene, const SurfacePoint& at, double radius, std::span<const glm::dvec2> places) {
    const Departure from = seen_surface(scene, at.position, facing_normal(at));
    std::size_t clear = 0;
    for (const glm::dvec2& place : places) clear += !from.closest(scene, cosine_direction(from.normal, place), radius);
    return double(clear) / double(places.size());
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

std::string length(double meters) { return meters < 1 ? fmt::format("{} cm", 100 * meters) : fmt::format("{} m", meters); }

/// What the truths are, for people, in the order of the radii.
std::array<std::string, radii.size()> sentences(MaterialRule rule) {
    constexpr TracedDirections directions;
    std::array<std::string, radii.size()> made;
    for (std::size_t i = 0; i < radii.size(); ++i)
        made[i] = fmt::format("{}visibility within {}, traced in double, {} directions per sample",
                              rule == MaterialRule::darker ? "the darker of the material's occlusion and " : "", length(radii[i]),
                              directions.side * directions.side * directions.batches);
    return made;
}

/// Views of what is kept as long as the program runs.
std::string_view truth_is(std::size_t radius, MaterialRule rule) {
    static const auto of_product = sentences(MaterialRule::product), of_darker = sentences(MaterialRule::darker);
    return (rule == MaterialRule::product ? of_product : of_darker)[radius];
}

}  // namespace

double occlusion_of(double visibility, double material, MaterialRule rule) {
    if (rule == MaterialRule::product || !(material > 0)) return visibility;
    return std::min(1.0, visibility / material);
}

ReferenceImage traced_visibility(const StageInput& input, double radius, const TracedDirections& directions) {
    const RayScene scene(input.frame, RayMask::opaque);
    const GivenSurfaces given{input.before.at("surface_normal"), input.before.at("surface_material")};
    ReferenceImage visibility =
        estimated_image(input.frame, given, directions.batches, {1, 0, 0, 1}, [&](const SurfacePoint& at, DrawnNumbers random) {
            return glm::dvec3(share_of_clear_rays(scene, at, radius, stratified(directions.side, random)), 0, 0);
        });
    visibility.channels = 1;
    return visibility;
}

ImageSet occlusion_truth(const StageInput& input) { return product[occlusion::default_radius](input); }

std::string_view occlusion_truth_is() { return truth_is(occlusion::default_radius, MaterialRule::product); }

std::vector<TruthRow> other_occlusion_truths() {
    std::vector<TruthRow> rows;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        if (i != occlusion::default_radius)
            rows.push_back({.name = occlusion::product_truths[i], .make = product[i], .is = truth_is(i, MaterialRule::product)});
        rows.push_back({.name = occlusion::darker_truths[i], .make = darker[i], .is = truth_is(i, MaterialRule::darker)});
    }
    return rows;
}

}  // namespace strata
