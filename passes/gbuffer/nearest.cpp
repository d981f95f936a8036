#include "passes/gbuffer/nearest.h"

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/coverage/mask_tests.h"
#include "passes/reference/place_code.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

glm::dvec4 emitted(const Frame& frame, const SurfacePoint& p) {
    return {p.model == LightingModel::unlit ? p.base_color * frame.pre_exposure + p.emissive : p.emissive, 1};
}

}  // namespace

std::vector<NearestSurface> nearest_surfaces(const Frame& frame, ShadeAt shade_at, std::uint32_t masked) {
    const std::vector<std::uint32_t> draws = opaque_draws(frame);
    const VisiblePoints visible = visible_points(frame, draws, {.shade_at = shade_at}, mask_model(frame, masked, shade_at));
    std::vector<NearestSurface> surfaces(visible.points.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const RasterPoint& point = visible.points[i];
        surfaces[i].undecided = point.undecided;
        surfaces[i].exists = point.draw != no_index;
        if (!surfaces[i].exists) continue;
        surfaces[i].point = surface_at(frame, point);
        surfaces[i].depth = point.depth;
        if (shade_at == ShadeAt::sample) surfaces[i].offset = sample_position(frame.view.samples, point.sample) - 0.5;
    }
    return surfaces;
}

ImageSet surface_images(const Frame& frame, const std::vector<NearestSurface>& surfaces) {
    const ReferenceImage empty(frame.view.width, frame.view.height, frame.view.samples);
    ReferenceImage normal = empty, color = empty, material = empty, emission = empty, depth = empty;
    std::vector<bool> undecided(surfaces.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const NearestSurface& s = surfaces[i];
        undecided[i] = s.undecided;
        if (!s.exists) continue;
        normal.texels[i] = glm::dvec4(s.point.normal, s.point.position.z);
        color.texels[i] = glm::dvec4(s.point.base_color, s.point.roughness);
        material.texels[i] = {double(s.point.model), s.point.metallic, s.point.occlusion, place_code(s.offset)};
        emission.texels[i] = emitted(frame, s.point);
        depth.texels[i] = {s.depth, 0, 0, 0};
    }
    ImageSet images{{"surface_normal", normal},
                    {"surface_color", color},
                    {"surface_material", material},
                    {"emission", emission},
                    {"depth_layers", depth}};
    images.at("depth_layers").channels = 1;
    if (frame.view.samples == 1) images.emplace("depth", images.at("depth_layers"));
    for (auto& [name, image] : images) image.undecided = undecided;
    return images;
}

}  // namespace strata::gbuffer
