#include "passes/lighting/tiled/cull_scene.h"

#include <utility>

#include "passes/lighting/light_records.h"

namespace strata::lighting {
namespace {

ViewRecord view_record(const View& v) {
    return {.ndc_scale = {v.projection[0][0], -v.projection[1][1]},
            .ndc_offset = {v.projection[2][0] + v.jitter.x, -(v.projection[2][1] + v.jitter.y)},
            .extent = {v.width, v.height}};
}

}  // namespace

CullScene cull_scene(const Frame& frame) {
    LightRecords made = light_records(frame);
    return {.view = view_record(frame.view),
            .lights = std::move(made.lights),
            .blockers = std::move(made.blockers),
            .light_blockers = std::move(made.light_blockers),
            .blocker_portals = std::move(made.blocker_portals),
            .clip_planes = std::move(made.clip_planes)};
}

}  // namespace strata::lighting
