// Percentage-closer soft shadows in double, by brute force over the maps as they were drawn.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/settings.h"
#include "passes/shadows/lookup.h"
#include "passes/shadows/pcss/soft_kernel.h"
#include "passes/shadows/shadow_map_params.h"
#include "passes/stage_input.h"

namespace strata::shadows {

namespace {

// Half the widest penumbra, and the other texel of a bilinear comparison.
constexpr double soft_reach = 32 + 1;

// Interleaved gradient noise (Jimenez 2014).
double pixel_turn(const Receiver& receiver) {
    const auto fraction = [](double x) { return x - std::floor(x); };
    const double inner = 0.06711056 * receiver.x + 0.00583715 * receiver.y;
    return 2 * std::numbers::pi * (fraction(52.9829189 * fraction(inner)) - 0.5);
}

Filtered soft_lookup(const LookupScene& scene, const ShadowView& view, const Receiver& receiver) {
    if (!view.soft) return fixed_lookup(scene, view, receiver);
    const auto at = biased_lookup(scene, view, receiver, {.radius = 0.5, .reach = soft_reach});
    if (!at) return {};
    const Towards to = towards(scene.frame, scene.lights[view.light], receiver.position);
    const glm::dvec4 depth_row = glm::transpose(view.view_to_map)[2];
    const bool is_sun = !has_range(scene.lights[view.light].type);
    const double w = (view.view_to_map * glm::dvec4(receiver.position, 1)).w;
    const double doubtful_meters = 2e-6 * (1 + glm::length(receiver.position) + (is_sun ? 0 : to.distance));
    SoftLookup soft{.at = *at, .source = view.source_width, .texel = view.texel};
    soft.gradient = plane_gradient(view, *at, receiver.normal);
    soft.near = is_sun ? 0 : depth_row.w;
    soft.depth_meters = is_sun ? 1 / glm::length(glm::dvec3(depth_row)) : 0;
    soft.turn = scene.filter.noise != 0 ? pixel_turn(receiver) : 0;
    soft.texel_doubt += doubtful_meters / (view.texel * w) + (scene.filter.noise != 0 ? 0.02 : 0);
    soft.search = scene.filter.search_taps;
    soft.filter = scene.filter.filter_taps;
    Filtered result = filter_soft(scene.maps, soft);
    // Seen edge on from the light a plane's rise over the map is anything; such a receiver is next to unlit.
    if (std::abs(glm::dot(receiver.normal, to.direction)) < 0.01) result.undecided = true;
    return result;
}

}  // namespace

ImageSet pcss_model(const StageInput& input, const Settings& settings) {
    return visibility_model(input, settings.as<ShadowMapParams>().filter, soft_lookup);
}

}  // namespace strata::shadows
