#include "passes/transparency/fragment_draw.h"

#include <cassert>
#include <utility>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/scene_facts.h"

namespace strata {
namespace {

/// What passes/indirect/volume_light.glsl declares. Without light volumes nothing of that file runs.
DrawStep& bind_volume_light(DrawStep& builder, const FrameImages& images) {
    const Frame& frame = *images.recorded;
    const bool is_lit = images.light_grids > 0;
    return builder.samples("volume_light", images.volume_light)
        .fixes("light_grids", images.light_grids)
        .fixes("irradiance", images.light_grid_rule)
        .fixes("blocker_count", is_lit ? static_cast<std::uint32_t>(frame.blockers.size()) : 0u)
        .fixes("portal_count", is_lit ? static_cast<std::uint32_t>(frame.portals.size()) : 0u);
}

DrawStep bound(DrawStep builder, const FrameImages& images, Image depth_layers) {
    builder.samples("depth_layers", depth_layers)
        .fixes("soft_fade", images.features->has(Feature::soft_particles) ? 1u : 0u)
        .fixes("sample_near", sample_near(images))
        .fixes("distorts", images.features->has(Feature::distortion) ? 1u : 0u)
        .fixes("has_interfaces", images.features->has(Feature::interface_layers) ? 1u : 0u)
        .fixes("has_fog", images.features->has(Feature::fog) ? 1u : 0u)
        .fixes("hands_on_material", 1u)
        .fixes("light_features", images.facts->light_features())
        .culls(hidden_side(images));
    return fix_materials(bind_volume_light(builder, images), images, Surfaces::transparent);
}

}  // namespace

Cull hidden_side(const FrameImages& images) {
    return shows_no_backs(*images.recorded, images.facts->lists().transparent) ? Cull::back : Cull::none;
}

DrawStep draw_fragments(Graph& graph, std::string shader, const DrawList& list, const FrameImages& images) {
    const bool soft = images.features->has(Feature::soft_particles);
    return bound(graph.draw(std::move(shader), list), images, soft ? images.depth_layers : Image{}).tests_depth(images.depth);
}

DrawStep draw_fragments_untested(Graph& graph, std::string shader, const DrawList& list, const FrameImages& images) {
    return bound(graph.draw(std::move(shader), list), images, images.depth_layers);
}

std::vector<DrawList> drawn_at(const FrameImages& images, Resolution resolution) {
    const Frame& frame = *images.recorded;
    const DrawList& list = images.transparent;
    // The list has this order, too.
    const std::vector<std::uint32_t>& draws = images.facts->lists().transparent;
    assert(draws.size() == list.count);
    std::vector<DrawList> stretches;
    bool goes_on = false;
    for (std::uint32_t i = 0; i < draws.size(); ++i) {
        const bool is_mesh = draws[i] < frame.draws.size();
        const Resolution at =
            is_mesh ? frame.draws[draws[i]].resolution : frame.emitters[draws[i] - frame.draws.size()].resolution;
        if (at == resolution && !goes_on) stretches.push_back({list.commands, list.indices, list.first + i, 0, list.of_places});
        goes_on = at == resolution;
        if (goes_on) ++stretches.back().count;
    }
    return stretches;
}

Image by_sample(Graph& graph, const Image& image) {
    return image ? spread(graph, image, graph.record(image).name + " by sample") : image;
}

}  // namespace strata
