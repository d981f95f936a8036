// Alpha blending in double: one object after another in painter's order, its triangles as they were submitted.
#include <utility>

#include "passes/technique.h"
#include "passes/transparency/object_order.h"
#include "passes/transparency/sample_blend.h"

namespace strata::transparency {
namespace {

/// The frame with one transparent object and no other draws; the particles of an emitter far to near.
void keep_only(Frame& frame, const Frame& whole, std::uint32_t index) {
    frame.draws.clear();
    frame.emitters.clear();
    if (index < whole.draws.size()) {
        frame.draws.push_back(whole.draws[index]);
        return;
    }
    const Emitter& emitter = whole.emitters[index - whole.draws.size()];
    frame.emitters.push_back(emitter);
    frame.emitters[0].particles.clear();
    for (const std::uint32_t particle : back_to_front_particles(whole, emitter))
        frame.emitters[0].particles.push_back(emitter.particles[particle]);
}

glm::dvec3 in_submission_order(std::span<const Fragment> fragments, glm::dvec3 radiance) {
    for (const Fragment& f : fragments) radiance = f.color + f.emission + f.transmittance * radiance;
    return radiance;
}

}  // namespace

ImageSet alpha_blend_model(const StageInput& input, const Settings&) {
    ReferenceImage color = input.before.at("color");
    Frame alone = input.frame;
    for (const std::uint32_t index : back_to_front_draws(input.frame)) {
        keep_only(alone, input.frame, index);
        color = blended(std::move(color), alone, input.before, in_submission_order);
    }
    return {{"color", std::move(color)}};
}

}  // namespace strata::transparency
