#include "passes/lighting/every_light.h"

#include "passes/reference/decoded.h"
#include "passes/shadows/shadow_views.h"

namespace strata::lighting {

EveryLight::EveryLight(const StageInput& input, LightForm form)
    : frame_(&input.frame),
      form_(form),
      normal_(&input.before.at("surface_normal")),
      color_(&input.before.at("surface_color")),
      material_(&input.before.at("surface_material")) {
    for (const Light& light : shadow_lights(input.frame))
        lights_.push_back(
            {.light = light, .from = light_point(input.frame, light), .blockers = light_blockers(input.frame, light)});
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
    const glm::dvec3 off = off_surface(p.position, facing_normal(p));
    for (const ShadowedLight& l : lights_) {
        if (!lets_through(l.blockers, l.from, off)) continue;
        const double visible = l.visibility_layer == no_index ? 1 : visibility_->at(x, y, l.visibility_layer + sample).x;
        if (visible == 0) continue;
        sum += visible * (form_ == LightForm::exact ? exact_reflected(*frame_, p, l.light) : reflected(*frame_, p, l.light));
    }
    return sum;
}

}  // namespace strata::lighting
