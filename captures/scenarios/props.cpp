#include "captures/scenarios/props.h"

#include <glm/gtc/matrix_transform.hpp>

#include "captures/scenarios/shapes.h"

namespace strata::scenario {

People::People(FrameBuilder& builder)
    : head_(builder.add(sphere(0.12f, 16))),
      torso_(builder.add(capsule(0.2f, 0.18f, 16))),
      limb_(builder.add(capsule(0.075f, 0.3f, 12))),
      foot_(builder.add(box({0.06f, 0.04f, 0.13f}))) {}

void People::add(FrameBuilder& builder, std::uint32_t material, const Pose& place) const {
    const glm::dmat4 body = transform(place);
    const auto part = [&](std::uint32_t mesh, glm::dvec3 at, double lean) {
        Draw& draw = builder.draw(mesh, material, {});
        draw.to_world = body * glm::rotate(glm::translate(glm::dmat4(1), at), lean, glm::dvec3(0, 0, 1));
        draw.previous_to_world = draw.to_world;
    };
    part(head_, {0, 1.68, 0}, 0);
    part(torso_, {0, 1.15, 0}, 0);
    for (const double side : {-1.0, 1.0}) {
        part(limb_, {0.11 * side, 0.42, 0}, 0);
        part(limb_, {0.3 * side, 1.08, 0}, 0.25 * side);
        part(foot_, {0.11 * side, 0.04, 0.06}, 0);
    }
}

void add_crate(FrameBuilder& builder, std::uint32_t material, glm::dvec3 half, const Pose& place) {
    Pose raised = place;
    raised.position.y += half.y * place.scale.y;
    builder.draw(builder.add(box(glm::vec3(half))), material, raised);
}

}  // namespace strata::scenario
