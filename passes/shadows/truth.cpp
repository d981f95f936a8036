// Traced shadows.
#include "passes/shadows/truth.h"

#include <algorithm>

#include "passes/reference/rays.h"
#include "passes/shadows/receivers.h"
#include "passes/shadows/shadow_views.h"

namespace strata {

namespace {

// Metres a ray starts off its surface. Positions come from float depth: wrong by 6e-8 z along the eye's ray, which a ray
// that leaves at a grazing angle of 0.1 degrees sees 600 times larger.
double start(const Receiver& receiver) { return 1e-3 + 1e-4 * receiver.position.z; }

// What counts as infinitely far for the sun's rays, in metres.
constexpr double sun_distance = 1e9;

}  // namespace

ImageSet shadows_truth(const StageInput& input) {
    const std::vector<std::uint32_t> shadowed = shadowed_lights(shadow_views(input.frame));
    const auto depth = input.before.find("depth_layers");
    if (shadowed.empty() || depth == input.before.end()) return {};
    const std::vector<Light> lights = shadow_lights(input.frame);
    const RayScene scene(input.frame, RayMask::shadow_casters);
    const ReferenceImage& shape = depth->second;
    const auto layers = static_cast<std::uint32_t>(shadowed.size()) * shape.layers;
    ReferenceImage visibility(shape.width, shape.height, layers, glm::dvec4(1, 0, 0, 1));
    for_each_receiver(input, [&](const Receiver& receiver) {
        for (std::uint32_t k = 0; k < shadowed.size(); ++k) {
            const Towards to = towards(input.frame, lights[shadowed[k]], receiver.position);
            const double begin = start(receiver), end = std::min(to.distance, sun_distance) - begin;
            const bool lit = end <= begin || scene.clear(receiver.position, to.direction, begin, end);
            visibility.at(receiver.x, receiver.y, k * shape.layers + receiver.sample).x = lit ? 1 : 0;
        }
    });
    return {{"visibility", visibility}};
}

}  // namespace strata
