#include "passes/gbuffer/nearest.h"

#include <array>
#include <string_view>

#include "capture_format/frame/frame.h"
#include "passes/gbuffer/coverage/mask_tests.h"
#include "passes/reference/place_code.h"
#include "passes/stage_input.h"

namespace strata::gbuffer {
namespace {

glm::dvec4 emitted(const Frame& frame, const SurfacePoint& p) {
    return {p.model == LightingModel::unlit ? p.base_color * frame.pre_exposure + p.emissive : p.emissive, 1};
}

constexpr std::array<std::string_view, 5> texel_images = {"surface_normal", "surface_color", "surface_material", "emission",
                                                          "depth_layers"};
/// One sample's texels in these images.
using Texels = std::array<glm::dvec4, texel_images.size()>;

Texels texels_of(const Frame& frame, const NearestSurface& s) {
    if (!s.exists) return {};
    return {glm::dvec4(s.point.normal, s.point.position.z), glm::dvec4(s.point.base_color, s.point.roughness),
            glm::dvec4(double(s.point.model), s.point.metallic, s.point.occlusion, place_code(s.offset)), emitted(frame, s.point),
            glm::dvec4(s.depth, 0, 0, 0)};
}

}  // namespace

SurfacesOfSamples nearest_surfaces(const Frame& frame, ShadeAt shade_at, std::uint32_t masked) {
    const std::vector<std::uint32_t> draws = opaque_draws(frame);
    const VisiblePoints visible = visible_points(frame, draws, {.shade_at = shade_at}, mask_model(frame, masked, shade_at));
    const auto surface_of = [&](const RasterPoint& point) {
        NearestSurface surface{.exists = point.draw != no_index, .undecided = point.undecided};
        if (!surface.exists) return surface;
        surface.point = surface_at(frame, point);
        surface.depth = point.depth;
        if (shade_at == ShadeAt::sample) surface.offset = sample_position(frame.view.samples, point.sample) - 0.5;
        return surface;
    };
    SurfacesOfSamples surfaces;
    for (const RasterPoint& point : visible.points) surfaces.nearest.push_back(surface_of(point));
    for (const RasterPoint& point : visible.rivals)
        surfaces.rivals.push_back({visible.index(point.x, point.y, point.sample), surface_of(point)});
    return surfaces;
}

ImageSet surface_images(const Frame& frame, const SurfacesOfSamples& surfaces) {
    const ReferenceImage empty(frame.view.width, frame.view.height, frame.view.samples);
    ImageSet images;
    for (const std::string_view name : texel_images) images.emplace(name, empty);
    images.at("depth_layers").channels = 1;
    for (auto& [name, image] : images) image.undecided.resize(surfaces.nearest.size());
    for (std::size_t i = 0; i < surfaces.nearest.size(); ++i) {
        const Texels texels = texels_of(frame, surfaces.nearest[i]);
        for (std::size_t k = 0; k < texels.size(); ++k) {
            ReferenceImage& image = images.find(texel_images[k])->second;
            image.texels[i] = texels[k];
            image.undecided[i] = surfaces.nearest[i].undecided;
        }
    }
    for (const RivalSurface& rival : surfaces.rivals) {
        const Texels texels = texels_of(frame, rival.surface);
        for (std::size_t k = 0; k < texels.size(); ++k)
            images.find(texel_images[k])->second.alternatives.push_back({rival.texel, texels[k]});
    }
    if (frame.view.samples == 1) images.emplace("depth", images.at("depth_layers"));
    return images;
}

}  // namespace strata::gbuffer
