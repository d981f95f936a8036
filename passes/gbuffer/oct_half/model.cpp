// Layout C of docs/algorithms/deferred.md 2.1 in double, half floats exact: attributes stored and read back.
#include "passes/gbuffer/oct_half/model.h"

#include "passes/gbuffer/codes.h"
#include "passes/gbuffer/layout_model.h"
#include "passes/technique.h"

namespace strata::gbuffer {

glm::dvec2 oct_half_coordinates(const glm::dvec3& n) {
    const glm::dvec2 p = to_octahedron(n);
    return {nearest_half(p.x), nearest_half(p.y)};
}

ImageSet oct_half_model(const StageInput& input, const Settings& settings) {
    const double near = input.frame.view.near;
    return stored_images(input, settings, [near](NearestSurface& s, const SampleAt&) {
        s.point = stored_material(s.point);
        s.point.normal = from_octahedron(oct_half_coordinates(s.point.normal));
        s.point.position.z = half_depth(s.point.position.z, near);
    });
}

}  // namespace strata::gbuffer
