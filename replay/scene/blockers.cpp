// Blockers and portals as records, and what each light has of them.
#include <cassert>

#include "passes/reference/blockers.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/shadows/shadow_views.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

BlockerRecord record(const PlacedBlocker& blocker) {
    return {
        .normal = glm::vec3(blocker.normal),
        .half_u = float(blocker.half_u),
        .center = glm::vec3(blocker.center),
        .half_v = float(blocker.half_v),
        .u = glm::vec3(blocker.u),
        .one_sided = blocker.one_sided ? 1u : 0u,
    };
}

BlockerPortalRecord record(const PlacedPortal& portal) {
    return {
        .center = glm::vec2(portal.center),
        .half_extent = glm::vec2(portal.half_extent),
        .turn = glm::vec2(portal.turn),
        .blocker = portal.blocker,
    };
}

void add(const LightBlockers& found, LightRecord& light, SceneRecords& scene) {
    light.first_blocker = static_cast<uint>(scene.light_blockers.size());
    light.blockers = static_cast<uint>(found.blockers.size());
    light.first_portal = static_cast<uint>(scene.blocker_portals.size());
    light.portals = static_cast<uint>(found.portals.size());
    if (light.blockers > 0) light.features |= feature_blockers;
    if (light.portals > 0) light.features |= feature_portals;
    for (const LightBlocker& use : found.blockers) scene.light_blockers.push_back({use.blocker, use.portals});
    for (const PlacedPortal& portal : found.portals) scene.blocker_portals.push_back(record(portal));
}

}  // namespace

void add_blockers(const Frame& frame, SceneRecords& scene) {
    for (const Blocker& blocker : frame.blockers) scene.blockers.push_back(record(placed_blocker(frame, blocker)));
    const std::vector<Light> lights = shadow_lights(frame);
    assert(lights.size() == scene.lights.size());
    for (std::size_t i = 0; i < lights.size(); ++i) add(light_blockers(frame, lights[i]), scene.lights[i], scene);
}

}  // namespace strata
