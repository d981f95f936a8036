// Percentage-closer filtering in double, by brute force over the maps as they were drawn.
#include <algorithm>
#include <cmath>

#include "passes/reference/shade.h"
#include "passes/shadows/pcf/kernel.h"
#include "passes/shadows/receivers.h"
#include "passes/shadows/shadow_views.h"
#include "passes/technique.h"

namespace strata::shadows {

namespace {

struct Scene {
    const Frame& frame;
    const ReferenceImage& maps;
    std::vector<ShadowView> views;
    std::vector<Light> lights;
    std::int64_t taps = 4;
    double slope_limit = 4;
};

// Metres the receiver moves towards the light: its own bias and what a plane gains over the kernel's radius.
double bias(const Scene& scene, const ShadowView& view, const Receiver& receiver, const Towards& to) {
    const double w = (view.view_to_map * glm::dvec4(receiver.position, 1)).w;
    const double cosine = std::clamp(glm::dot(receiver.normal, to.direction), 1e-3, 1.0);
    const double slope = std::min(std::tan(std::acos(cosine)), scene.slope_limit);
    const double radius = std::sqrt(0.5) * double(scene.taps) + 0.5;
    return std::min(view.bias + radius * view.texel * w * slope, 0.5 * to.distance);
}

// Float positions are good to a few 2^-23 of their size; the sun's map depth divides metres by the depth range, a spot's is
// near / w and moves in proportion.
double doubt(const ShadowView& view, const Receiver& receiver, const glm::dvec4& at, double distance) {
    const glm::dvec4 depth_row = glm::transpose(view.view_to_map)[2];
    const double metres = 2e-6 * (1 + glm::length(receiver.position) + distance);
    const bool perspective = glm::dvec3(depth_row) == glm::dvec3(0);
    return perspective ? metres * at.z / (at.w * at.w) : metres * glm::length(glm::dvec3(depth_row)) + 1e-6;
}

Filtered filtered(const Scene& scene, std::uint32_t slot, const Receiver& receiver) {
    const ShadowView& view = scene.views[slot];
    const Towards to = towards(scene.frame, scene.lights[view.light], receiver.position);
    const double moved = bias(scene, view, receiver, to);
    const glm::dvec4 at = view.view_to_map * glm::dvec4(receiver.position + moved * to.direction, 1);
    if (at.w <= 0) return {};
    const glm::dvec2 u = glm::dvec2(at.x, at.y) / at.w * double(view.size);
    const double reach = double(scene.taps);
    if (std::min(u.x, u.y) < -reach || std::max(u.x, u.y) > view.size + reach) return {};
    const double distance = std::isinf(to.distance) ? 0 : to.distance;
    return filter_map(
        scene.maps,
        {.layer = slot, .size = view.size, .u = u, .depth = at.z / at.w, .doubt = doubt(view, receiver, at, distance)},
        scene.taps);
}

// Slots of one light: the first cascade that reaches the receiver's depth, blended over its last tenth into the next.
Filtered visible_share(const Scene& scene, std::uint32_t light, const Receiver& receiver) {
    for (std::uint32_t slot = 0; slot < scene.views.size(); ++slot) {
        const ShadowView& view = scene.views[slot];
        if (view.light != light || receiver.position.z >= view.range_end) continue;
        const double blended = cascade_blend * (view.range_end - view.range_begin);
        const double share = std::min((view.range_end - receiver.position.z) / blended, 1.0);
        const Filtered here = filtered(scene, slot, receiver);
        if (share == 1) return here;
        const bool last = slot + 1 == scene.views.size() || scene.views[slot + 1].light != light;
        const Filtered next = last ? Filtered{} : filtered(scene, slot + 1, receiver);
        return {glm::mix(next.lit, here.lit, share), here.undecided || next.undecided};
    }
    return {};
}

}  // namespace

ImageSet pcf_model(const StageInput& input, const Settings& settings) {
    const auto maps = input.before.find("shadow_maps"), depth = input.before.find("depth_layers");
    if (maps == input.before.end() || depth == input.before.end() || !input.before.contains("surface_normal")) return {};
    const Scene scene{.frame = input.frame,
                      .maps = maps->second,
                      .views = shadow_views(input.frame),
                      .lights = shadow_lights(input.frame),
                      .taps = std::int64_t(2) << static_cast<int>(settings.get("kernel")),
                      .slope_limit = settings.get("slope_limit")};
    const std::vector<std::uint32_t> shadowed = shadowed_lights(scene.views);
    const ReferenceImage& shape = depth->second;
    const auto layers = static_cast<std::uint32_t>(shadowed.size()) * shape.layers;
    ReferenceImage visibility(shape.width, shape.height, layers, glm::dvec4(1, 0, 0, 1));
    std::vector<char> undecided(visibility.texels.size(), 0);  // rows run in parallel: no packed bits
    for_each_receiver(input, [&](const Receiver& receiver) {
        for (std::uint32_t k = 0; k < shadowed.size(); ++k) {
            const Filtered result = visible_share(scene, shadowed[k], receiver);
            const std::size_t texel = visibility.index(receiver.x, receiver.y, k * shape.layers + receiver.sample);
            visibility.texels[texel].x = result.lit;
            undecided[texel] = result.undecided;
        }
    });
    visibility.undecided.assign(undecided.begin(), undecided.end());
    return {{"visibility", visibility}};
}

}  // namespace strata::shadows
