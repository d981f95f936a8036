#include "tests/support/traced_maps.h"

#include "passes/reference/rays.h"
#include "passes/scene/shadow_views.h"

namespace strata {

ReferenceImage traced_maps(const Frame& frame) {
    const RayScene scene(frame, RayMask::shadow_casters);
    const auto views = shadow_views(frame);
    ReferenceImage maps(views[0].size, views[0].size, static_cast<std::uint32_t>(views.size()), glm::dvec4(0, 0, 0, 1));
    for (std::uint32_t slot = 0; slot < maps.layers; ++slot) {
        const glm::dmat4 to_view = glm::inverse(views[slot].view_to_map);
        for (std::uint32_t i = 0; i < maps.width * maps.height; ++i) {
            const glm::dvec2 uv = (glm::dvec2(i % maps.width, i / maps.width) + 0.5) / double(views[slot].size);
            const glm::dvec4 near = to_view * glm::dvec4(uv, 1, 1), far = to_view * glm::dvec4(uv, 1e-3, 1);
            const glm::dvec3 origin = glm::dvec3(near) / near.w, step = glm::dvec3(far) / far.w - origin;
            const auto hit = scene.closest(origin, step, 0, 1);
            if (!hit) continue;
            const glm::dvec4 m = views[slot].view_to_map * glm::dvec4(origin + hit->distance * step, 1);
            maps.at(i % maps.width, i / maps.width, slot).x = double(float(m.z / m.w));
        }
    }
    return maps;
}

}  // namespace strata
