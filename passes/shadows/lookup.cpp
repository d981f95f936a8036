// Lookups of shadow maps in double.
#include "passes/shadows/lookup.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/edges/plain_pixels.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"

namespace strata::shadows {

namespace {

// Slopes up to which receivers move towards the light; what is steeper, fixed kernels follow tap by tap.
constexpr double moved_slope = 4;

Towards to_light(const LookupScene& scene, const ShadowView& view, const Receiver& receiver) {
    return towards(scene.frame, scene.lights[view.light], receiver.position);
}

// Float positions are good to a few 2^-23 of their size; the sun's map depth divides meters by the depth range, a spot's is
// near / w and moves in proportion.
double doubt(const ShadowView& view, const Receiver& receiver, const glm::dvec4& at, double distance) {
    const glm::dvec4 depth_row = glm::transpose(view.view_to_map)[2];
    const double meters = 2e-6 * (1 + glm::length(receiver.position) + (std::isinf(distance) ? 0 : distance));
    const bool perspective = glm::dvec3(depth_row) == glm::dvec3(0);
    return perspective ? meters * at.z / (at.w * at.w) : meters * glm::length(glm::dvec3(depth_row)) + 1e-6;
}

// Between normal and light, across the axis of the light's map.
double tangent_of(const ShadowView& view, const Receiver& receiver, const Towards& to) {
    const double cosine = std::clamp(glm::dot(receiver.normal, to.direction), 1e-3, 1.0);
    const auto w_row = glm::dvec3(glm::transpose(view.view_to_map)[3]);  // the axis of a local light's map
    const glm::dvec3 axis = w_row == glm::dvec3(0) ? to.direction : w_row;
    return glm::length(glm::cross(receiver.normal, axis)) / cosine;
}

// The face of a cube that serves a receiver; undecided where two are equally near but for rounding and do not agree.
Filtered look_up_face(const LookupScene& scene, std::size_t first, const Receiver& receiver, const LookUp& look_up) {
    const Light& light = scene.lights[scene.views[first].light];
    const glm::dvec3 direction =
        glm::transpose(scene.frame.view.to_view) * (receiver.position - to_view(scene.frame, light.position));
    const std::uint32_t face = cube_face(direction);
    Filtered found = look_up(scene, scene.views[first + face], receiver);
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 other = direction;
        other[axis] *= 1 + 1e-5;
        const std::uint32_t other_face = cube_face(other);
        if (other_face != face && look_up(scene, scene.views[first + other_face], receiver).lit != found.lit)
            found.undecided = true;
    }
    return found;
}

// The first cascade that reaches the receiver's depth, blended over its last tenth into the next, the last into lit.
Filtered look_up_cascades(const LookupScene& scene, std::size_t first, const Receiver& receiver, const LookUp& look_up) {
    for (std::size_t slot = first; slot < scene.views.size(); ++slot) {
        const ShadowView& view = scene.views[slot];
        if (view.light != scene.views[first].light) break;
        if (receiver.position.z >= view.range_end) continue;
        const double blended = cascade_blend * (view.range_end - view.range_begin);
        const double share = std::min((view.range_end - receiver.position.z) / blended, 1.0);
        const Filtered here = look_up(scene, view, receiver);
        if (share == 1) return here;
        const bool last = slot + 1 == scene.views.size() || scene.views[slot + 1].light != view.light;
        const Filtered next = last ? Filtered{} : look_up(scene, scene.views[slot + 1], receiver);
        return {glm::mix(next.lit, here.lit, share), here.undecided || next.undecided};
    }
    return {};
}

Filtered look_up_light(const LookupScene& scene, std::uint32_t light, const Receiver& receiver, const LookUp& look_up) {
    const auto first = std::ranges::find(scene.views, light, &ShadowView::light) - scene.views.begin();
    const auto slot = static_cast<std::size_t>(first);
    if (has_faces(scene.lights[light])) return look_up_face(scene, slot, receiver, look_up);
    return look_up_cascades(scene, slot, receiver, look_up);  // a spot is one cascade without an end
}

}  // namespace

LookupScene::LookupScene(const Frame& recorded, const ReferenceImage& drawn, const ShadowFilter& settings)
    : frame(recorded),
      maps(drawn),
      views(shadow_views(recorded, static_cast<Allocation>(settings.allocation))),
      lights(shining_lights(recorded)),
      filter(settings) {}

std::optional<Lookup> biased_lookup(const LookupScene& scene, const ShadowView& view, const Receiver& receiver,
                                    KernelSize kernel) {
    const Towards to = to_light(scene, view, receiver);
    const double w = (view.view_to_map * glm::dvec4(receiver.position, 1)).w;
    const double slope = std::min({tangent_of(view, receiver, to), double(scene.filter.slope_limit), moved_slope});
    const double moved = std::min(view.bias + kernel.radius * view.texel * w * slope, 0.5 * to.distance);
    const glm::dvec4 at = view.view_to_map * glm::dvec4(receiver.position + moved * to.direction, 1);
    if (at.w <= 0) return std::nullopt;
    const glm::dvec2 u = glm::dvec2(at.x, at.y) / at.w * double(view.size);
    if (std::min(u.x, u.y) < -kernel.reach || std::max(u.x, u.y) > view.size + kernel.reach) return std::nullopt;
    return Lookup{.layer = view.layer,
                  .size = view.size,
                  .u = u,
                  .depth = at.z / at.w,
                  .doubt = doubt(view, receiver, at, to.distance),
                  .offset = view.offset,
                  .is_face = has_faces(scene.lights[view.light])};
}

// Planes go through the map's projection as covectors.
glm::dvec2 plane_gradient(const ShadowView& view, const Lookup& at, const glm::dvec3& normal) {
    const glm::dmat4 to_view = glm::inverse(view.view_to_map);
    const glm::dvec4 position = to_view * glm::dvec4(at.u / double(at.size), at.depth, 1);
    const glm::dvec4 plane(normal, -glm::dot(normal, glm::dvec3(position)) / position.w);
    const glm::dvec4 in_map = glm::transpose(to_view) * plane;
    if (in_map.z == 0) return glm::dvec2(0);
    return -glm::dvec2(in_map) / in_map.z / double(view.size);
}

std::optional<Lookup> fixed_place(const LookupScene& scene, const ShadowView& view, const Receiver& receiver) {
    const double taps = double(scene.taps());
    auto at = biased_lookup(scene, view, receiver, {.radius = std::sqrt(0.5) * taps + 0.5, .reach = taps});
    const Towards to = to_light(scene, view, receiver);
    const double tangent = tangent_of(view, receiver, to), slope = std::min(tangent, double(scene.filter.slope_limit));
    if (!at || slope <= moved_slope) return at;
    at->rise = slope / tangent * plane_gradient(view, *at, receiver.normal);
    at->risen = std::sqrt(0.5) * taps * moved_slope / slope * glm::length(at->rise);
    // A float's rounding of the normal and of the plane's rise weighs more the more the plane is seen edge on: by its tangent.
    at->doubt += 1e-6 * tangent * taps * glm::length(at->rise);
    if (std::abs(glm::dot(receiver.normal, to.direction)) < 2e-3) at->doubt = 1;
    return at;
}

Filtered fixed_lookup(const LookupScene& scene, const ShadowView& view, const Receiver& receiver) {
    const auto at = fixed_place(scene, view, receiver);
    return at ? filter_map(scene.maps, *at, scene.taps()) : Filtered{};
}

namespace {

/// Puts the receiver under the pixel's center, on the plane of all samples; false where not all have a surface.
bool move_to_center(const Frame& frame, const ReferenceImage& depth, Receiver& receiver) {
    double sum = 0;
    for (std::uint32_t sample = 0; sample < depth.layers; ++sample) {
        const double own = depth.at(receiver.x, receiver.y, sample).x;
        if (!(own > 0)) return false;
        sum += own;
    }
    receiver.position = pixel_ray(frame, receiver.x + 0.5, receiver.y + 0.5) * (double(frame.view.near) * depth.layers / sum);
    return true;
}

}  // namespace

ImageSet visibility_model(const StageInput& input, const ShadowFilter& filter, const LookUp& look_up) {
    const auto maps = input.before.find("shadow_maps"), depth = input.before.find("depth_layers");
    if (maps == input.before.end() || depth == input.before.end() || !input.before.contains("surface_normal")) return {};
    const LookupScene scene(input.frame, maps->second, filter);
    const std::vector<std::uint32_t> shadowed = mapped_lights(scene.frame);
    const ReferenceImage& shape = depth->second;
    const auto layers = static_cast<std::uint32_t>(shadowed.size()) * shape.layers;
    ReferenceImage visibility(shape.width, shape.height, layers, glm::dvec4(1, 0, 0, 1));
    std::vector<char> undecided(visibility.texels.size(), 0);  // rows run in parallel: no packed bits
    for_each_receiver(input, [&](Receiver receiver) {
        // In a plain pixel the shadow at its center stands for all samples.
        const bool is_plain = is_plain_pixel(input, receiver.x, receiver.y);
        if (is_plain && (receiver.sample > 0 || !move_to_center(input.frame, shape, receiver))) return;
        const std::uint32_t end = is_plain ? shape.layers : receiver.sample + 1;
        for (std::uint32_t k = 0; k < shadowed.size(); ++k) {
            const Filtered result = look_up_light(scene, shadowed[k], receiver, look_up);
            for (std::uint32_t sample = receiver.sample; sample < end; ++sample) {
                const std::size_t texel = visibility.index(receiver.x, receiver.y, k * shape.layers + sample);
                visibility.texels[texel].x = result.lit;
                undecided[texel] = result.undecided;
            }
        }
    });
    visibility.channels = 1;
    visibility.undecided.assign(undecided.begin(), undecided.end());
    return {{"visibility", visibility}};
}

}  // namespace strata::shadows
