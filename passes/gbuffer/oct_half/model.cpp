// Layout C of docs/algorithms/deferred.md 2.1 in double, half floats exact: attributes stored and read back.
#include "passes/gbuffer/oct_half/model.h"

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {

glm::dvec2 oct_half_coordinates(const glm::dvec3& n) {
    const glm::dvec2 p = to_octahedron(n);
    return {nearest_half(p.x), nearest_half(p.y)};
}

ImageSet oct_half_model(const StageInput& input, const Settings& settings) {
    return half_depth_images(input, settings, [](const glm::dvec3& n) { return from_octahedron(oct_half_coordinates(n)); });
}

}  // namespace strata::gbuffer
