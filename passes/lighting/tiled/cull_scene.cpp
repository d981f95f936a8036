#include "passes/lighting/tiled/cull_scene.h"

#include "capture_format/frame/frame.h"
#include "passes/scene/light_records.h"
#include "passes/scene/scene_facts.h"

namespace strata::lighting {
namespace {

ViewRecord view_record(const View& v) {
    return {.ndc_scale = {v.projection[0][0], -v.projection[1][1]},
            .ndc_offset = {v.projection[2][0] + v.jitter.x, -(v.projection[2][1] + v.jitter.y)},
            .extent = {v.width, v.height}};
}

}  // namespace

CullScene cull_scene(const Frame& frame) { return {light_records(frame, SceneFacts(frame).lights()), view_record(frame.view)}; }

}  // namespace strata::lighting
