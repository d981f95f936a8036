// Things that stand around in several scenarios.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "captures/scenarios/frame_builder.h"

namespace strata::scenario {

/// A person 1.8 m tall made of capsules, boxes and a sphere; feet at `place.position`, looking along +z before the yaw.
/// The meshes are added once for any number of people.
class People {
public:
    explicit People(FrameBuilder&);
    void add(FrameBuilder&, std::uint32_t material, const Pose&) const;

private:
    std::uint32_t head_, torso_, limb_, foot_;
};

/// A box with its lower face at y = 0 of `place`, `half` in size.
void add_crate(FrameBuilder&, std::uint32_t material, glm::dvec3 half, const Pose&);

}  // namespace strata::scenario
