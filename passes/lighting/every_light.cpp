#include "passes/lighting/every_light.h"

#include "passes/reference/decoded.h"
#include "passes/reference/placed_light.h"
#include "passes/shadows/shadow_views.h"

namespace strata::lighting {

EveryLight::EveryLight(const StageInput& input, LightForm form)
    : frame_(&input.frame),
      form_(form),
      normal_(&input.before.at("surface_normal")),
      color_(&input.before.at("surface_color")),
      material_(&input.before.at("surface_material")) {
    for (const Light& light : shadow_lights(input.frame)) {
        const bool from_anywhere = form == LightForm::exact && is_area(light.type);
        lights_.push_back({.light = light,
                           .from = light_point(input.frame, light),
                           .blockers = from_anywhere ? all_blockers(input.frame, light) : light_blockers(input.frame, light)});
    }
    const auto visibility = input.before.find("visibility");
    if (visibility == input.before.end()) return;
    visibility_ = &visibility->second;
    std::uint32_t layer = 0;
    for (const std::uint32_t light : shadowed_lights(shadow_views(input.frame))) {
        lights_[light].visibility_layer = layer;
        layer += input.frame.view.samples;
    }
}

SurfacePoint EveryLight::surface(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    return decoded_surface(*frame_, {normal_->at(x, y, sample), color_->at(x, y, sample), material_->at(x, y, sample)}, x, y);
}

glm::dvec3 EveryLight::at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const {
    if (normal_->at(x, y, sample).w <= 0) return glm::dvec3(0);
    const SurfacePoint p = surface(x, y, sample);
    glm::dvec3 sum(0);
    const glm::dvec3 off = off_surface(p.position, p.normal);
    for (const ShadowedLight& l : lights_) {
        const double visible = l.visibility_layer == no_index ? 1 : visibility_->at(x, y, l.visibility_layer + sample).x;
        if (visible == 0) continue;
        if (form_ == LightForm::exact && is_area(l.light.type)) {
            ExactOptions options;
            if (!l.light.blockers.empty())
                options.visible = [&](const glm::dvec4& from) {
                    return clear_between(l.blockers, off, glm::dvec3(from)) ? 1. : 0.;
                };
            sum += visible * exact_reflected(*frame_, p, l.light, options);
        } else if (lets_through(l.blockers, l.from, off)) {
            sum += visible * reflected(*frame_, p, l.light);
        }
    }
    return sum;
}

}  // namespace strata::lighting
