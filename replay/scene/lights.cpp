// The view, the lights and their shadow maps as records.
#include <cmath>

#include "passes/lighting/light_features.h"
#include "passes/reference/shade.h"
#include "passes/shadows/shadow_views.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

vec2 tangents(const Light& light) {
    const double u = std::tan(double(light.outer_angle));
    const bool square = light.type == LightType::square_spot;
    return {float(u), float(square ? std::tan(double(light.inner_angle)) : u)};
}

LightRecord record(const Frame& frame, const Light& light) {
    const bool is_spot = light.type == LightType::round_spot || light.type == LightType::square_spot;
    return {
        .position = glm::vec3(to_view(frame, light.position)),
        .type = static_cast<uint>(light.type),
        .direction = glm::vec3(frame.view.to_view * glm::dvec3(light.direction)),
        .range = light.range,
        .intensity = light.intensity,
        .source_radius = light.source_radius,
        .axis_u = glm::vec3(frame.view.to_view * glm::dvec3(light.axis_u)),
        .cos_inner = float(std::cos(double(light.inner_angle))),
        .cos_outer = float(std::cos(double(light.outer_angle))),
        .tan_half = is_spot ? tangents(light) : vec2(0),
        .half_extent = light.half_extent,
        .texture = light.texture,
        .features = light_features(light),
        .shadow = no_index,
        .shadow_slots = 0,
        .visibility_layer = no_index,
    };
}

// Keeps dot(n, p) + d >= 0 with p camera-relative.
void add_clip_planes(const Frame& frame, const Light& light, SceneRecords& scene) {
    scene.lights.back().first_clip = static_cast<uint>(scene.clip_planes.size());
    scene.lights.back().clips = static_cast<uint>(light.clip_planes.size());
    for (const ClipPlane& plane : light.clip_planes) {
        const double distance = plane.distance + glm::dot(plane.normal, frame.view.origin);
        scene.clip_planes.push_back({glm::vec3(frame.view.to_view * plane.normal), float(distance)});
    }
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
        .white = frame.film.white,
        .background = frame.background,
        .fog_density = frame.fog.density,
        .fog_color = frame.fog.color,
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

void add_lights(const Frame& frame, SceneRecords& scene) {
    for (const Light& light : shadow_lights(frame)) {
        scene.lights.push_back(record(frame, light));
        add_clip_planes(frame, light, scene);
    }
    add_blockers(frame, scene);

    std::uint32_t shadowed = 0;
    for (const ShadowView& view : shadow_views(frame)) {
        LightRecord& light = scene.lights[view.light];
        if (light.shadow == no_index) {
            light.shadow = static_cast<uint>(scene.shadows.size());
            light.visibility_layer = shadowed++ * frame.view.samples;
        }
        ++light.shadow_slots;
        scene.shadows.push_back({
            .view_to_map = glm::mat4(view.view_to_map),
            .light = view.light,
            .size = view.size,
            .bias = float(view.bias),
            .range_begin = float(view.range_begin),
            .range_end = float(view.range_end),
            .texel = float(view.texel),
        });
    }
    scene.view = view_record(frame);
    scene.view.light_count = static_cast<uint>(scene.lights.size());
    scene.view.shadow_count = static_cast<uint>(scene.shadows.size());
}

SceneRecords scene_records(const Frame& frame) {
    SceneRecords scene;
    add_geometry(frame, scene);
    add_materials(frame, scene);
    add_textures(frame, scene);
    add_lights(frame, scene);
    return scene;
}

}  // namespace strata
