#include "passes/lighting/every_light.h"

#include <utility>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/light_types.h"
#include "passes/edges/plain_pixels.h"
#include "passes/reference/decoded.h"
#include "passes/reference/light_sets.h"
#include "passes/reference/placed_light.h"
#include "passes/stage_input.h"

namespace strata::lighting {
namespace {

constexpr double largest_half = 65504;

LightBlockers asked_blockers(const Frame& frame, const Light& light, LightForm form) {
    const bool from_anywhere = form == LightForm::exact && is_area(light.type);
    return from_anywhere ? all_blockers(frame, light) : light_blockers(frame, light);
}

}  // namespace

EveryLight::EveryLight(const StageInput& input, LightForm form, LightFilter filter)
    : frame_(&input.frame),
      form_(form),
      filter_(std::move(filter)),
      normal_(&input.before.at("surface_normal")),
      color_(&input.before.at("surface_color")),
      material_(&input.before.at("surface_material")) {
    for (const Light& light : shining_lights(input.frame)) {
        lights_.push_back({.light = light,
                           .from = light_point(input.frame, light),
                           .blockers = filter_.asks_blockers ? asked_blockers(input.frame, light, form) : LightBlockers{}});
    }
    const auto visibility = input.before.find("visibility");
    if (visibility == input.before.end()) return;
    visibility_ = &visibility->second;
    std::uint32_t layer = 0;
    for (const std::uint32_t light : mapped_lights(input.frame)) {
        lights_[light].visibility_layer = layer;
        layer += input.frame.view.samples;
    }
}

SurfacePoint EveryLight::surface(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return decoded_surface(*frame_, {normal_->at(x, y, sample), color_->at(x, y, sample), material_->at(x, y, sample)}, x, y);
}

glm::dvec3 EveryLight::arriving(const ShadowedLight& l, const SurfacePoint& p) const {
    const glm::dvec3 above = off_surface(p.position, facing_normal(p));
    if (form_ == LightForm::real_time || !is_area(l.light.type)) {
        if (!lets_through(l.blockers, l.from, above)) return glm::dvec3(0);
        if (form_ == LightForm::exact) return exact_reflected(*frame_, p, l.light);
        return filter_.reflects ? filter_.reflects(*frame_, p, l.light) : reflected(*frame_, p, l.light);
    }
    ExactOptions options;
    if (!l.blockers.blockers.empty())
        options.visible = [&](const glm::dvec4& from) { return clear_between(l.blockers, above, glm::dvec3(from)) ? 1.0 : 0.0; };
    return exact_reflected(*frame_, p, l.light, options);
}

glm::dvec3 EveryLight::at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    if (normal_->at(x, y, sample).w <= 0) return glm::dvec3(0);
    const SurfacePoint p = surface(x, y, sample);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (filter_.lists && !filter_.lists({x, y}, i)) continue;
        const ShadowedLight& l = lights_[i];
        const double visible = l.visibility_layer == no_index ? 1 : visibility_->at(x, y, l.visibility_layer + sample).x;
        if (visible > 0) sum += visible * arriving(l, p);
    }
    return sum;
}

ImageSet light_of_shaded_samples(const StageInput& input, const LightFilter& filter) {
    const EveryLight every_light(input, LightForm::real_time, filter);
    ReferenceImage light(every_light.width(), every_light.height(), every_light.samples());
    tbb::parallel_for(0u, light.height, [&](std::uint32_t y) {
        for (std::uint32_t x = 0; x < light.width; ++x)
            for (std::uint32_t sample = 0; sample < light.layers; ++sample) {
                const glm::dvec3 sum = every_light.at(x, y, is_plain_pixel(input, x, y) ? 0 : sample);
                light.at(x, y, sample) = glm::dvec4(glm::clamp(sum, -largest_half, largest_half), 1);
            }
    });
    return {{"light", light}};
}

}  // namespace strata::lighting
