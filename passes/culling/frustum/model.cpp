// The same test in double: sphere against the planes of the view's pyramid and its near plane, from the projection's terms.
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/culling/draw_command.shared.h"
#include "passes/culling/view_planes.h"
#include "passes/culling/visible_image.h"
#include "passes/reference/fragments.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::culling {

ImageSet frustum_model(const StageInput& input, const Settings&) {
    const std::vector<std::uint32_t> draws = opaque_draws(input.frame);
    ReferenceImage visible(visible_width, visible_rows(draws.size()), 1, glm::dvec4(0, 0, 0, 1));
    visible.channels = 1;
    visible.undecided.assign(visible.texels.size(), false);
    for (std::size_t i = 0; i < draws.size(); ++i) {
        const Sphere sphere = bounding_sphere(input.frame, draws[i]);
        const double size = size_with_distance(sphere);
        const double depth = reach_into_view(input.frame.view, {sphere.center, sphere.radius + double(bound_slack) * size});
        visible.texels[i] = glm::dvec4(depth >= 0 ? 1 : 0, 0, 0, 1);
        // Device arithmetic on these sums is good to a few 2^-23 of their size.
        visible.undecided[i] = std::abs(depth) < 4e-6 * size;
    }
    return {{"visible", visible}};
}

}  // namespace strata::culling
