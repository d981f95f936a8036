// The view, the lights and their shadow maps as records.
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/view.h"
#include "passes/scene/light_records.h"
#include "passes/scene/pre_exposure.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

ShadowRecord record(const ShadowView& view) {
    return {
        .view_to_map = glm::mat4(view.view_to_map),
        .light = view.light,
        .size = view.size,
        .bias = float(view.bias),
        .range_begin = float(view.range_begin),
        .range_end = float(view.range_end),
        .texel = float(view.texel),
        .source_width = float(view.source_width),
        .offset = view.offset,
        .layer = view.layer,
    };
}

ViewRecord view_record(const Frame& frame) {
    const View& v = frame.view;
    glm::mat4 projection = v.projection;
    projection[2][0] += v.jitter.x;
    projection[2][1] += v.jitter.y;
    return {
        .projection = projection,
        .to_world = glm::mat3(glm::transpose(v.to_view)),
        .ndc_scale = {projection[0][0], -projection[1][1]},
        .ndc_offset = {projection[2][0], -projection[2][1]},
        .extent = {v.width, v.height},
        .samples = v.samples,
        .near = v.near,
        .exposure = v.exposure,
        .pre_exposure = static_cast<float>(frame.pre_exposure),
        .white_level = static_cast<float>(white_level(frame).value_or(0)),
        .white = frame.film.white,
        .background = frame.background,
        .fog_density = frame.fog.density,
        .fog_color = frame.fog.color,
        .fog_path = static_cast<std::uint32_t>(frame.fog.path),
        .sky = frame.hemisphere.sky,
        .ground = frame.hemisphere.ground,
        .light_count = 0,
        .shadow_count = 0,
        .first_emitter = static_cast<uint>(frame.draws.size()),
        .seed = static_cast<uint>(frame.seed),
        .frame_index = static_cast<uint>(frame.index),
        .time = float(frame.time),
    };
}

}  // namespace

void add_lights(const SceneFacts& facts, SceneRecords& scene) {
    const Frame& frame = facts.frame();
    static_cast<LightRecords&>(scene) = light_records(frame, facts.lights());
    std::uint32_t shadowed = 0;
    const std::vector<ShadowView>& views = facts.shadow_views(Allocation::own);
    for (const ShadowView& view : views) {
        LightRecord& light = scene.lights[view.light];
        if (light.shadow == no_index) {
            light.shadow = static_cast<uint>(&view - views.data());
            light.visibility_layer = shadowed++ * frame.view.samples;
        }
        ++light.shadow_slots;
        scene.shadows.push_back(record(view));
    }
    for (const ShadowView& view : facts.shadow_views(Allocation::need)) scene.shadows.push_back(record(view));
    scene.view = view_record(frame);
    scene.view.light_count = static_cast<uint>(scene.lights.size());
    scene.view.shadow_count = static_cast<uint>(views.size());
}

SceneRecords scene_records(const SceneFacts& facts) {
    const Frame& frame = facts.frame();
    SceneRecords scene;
    add_geometry(facts, scene);
    add_materials(frame, scene);
    add_textures(frame, scene);
    add_lights(facts, scene);
    add_still(facts, scene);
    return scene;
}

}  // namespace strata
