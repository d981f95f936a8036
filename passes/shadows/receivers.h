// The samples of the G-buffer as receivers of shadow, in double: what the stage's truth, judge and models go through.
#pragma once

#include <cstdint>
#include <functional>

#include <glm/glm.hpp>

namespace strata {

struct Frame;       // capture_format/frame.h
struct Light;       // capture_format/frame/light.h
struct StageInput;  // passes/stage_input.h

/// A visible surface under a sample, view space.
struct Receiver {
    std::uint32_t x = 0, y = 0, sample = 0;
    glm::dvec3 position{0};
    glm::dvec3 normal{0};  ///< unit and shading, from "surface_normal", of hair facing the eye; zero where the input has none
};

/// Calls `visit` for every sample of "depth_layers" that a surface covers; rows run in parallel.
void for_each_receiver(const StageInput&, const std::function<void(const Receiver&)>& visit);

/// Unit vector towards a light, and how far it is (infinite for directional ones).
struct Towards {
    glm::dvec3 direction{0};
    double distance = 0;
};
Towards towards(const Frame&, const Light&, const glm::dvec3& position);

}  // namespace strata
