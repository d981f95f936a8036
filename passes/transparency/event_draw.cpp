#include "passes/transparency/event_draw.h"

#include <utility>

#include "passes/texture_uses.h"

namespace strata {
namespace {

DrawPass bound(DrawPass pass, const FrameImages& images, Image depth_layers) {
    pass.samples("depth_layers", depth_layers)
        .fixes("soft_fade", images.features->has(Feature::soft_particles) ? 1u : 0u)
        .fixes("sample_near", images.samples > 1 ? images.recorded->view.near : 0.f)
        .fixes("first_emitter", static_cast<std::uint32_t>(images.recorded->draws.size()));
    return fix_textures(pass, images, Surfaces::transparent);
}

}  // namespace

DrawPass draw_events(Graph& graph, std::string shader, const DrawList& list, const FrameImages& images) {
    const bool soft = images.features->has(Feature::soft_particles);
    return bound(graph.draw(std::move(shader), list), images, soft ? images.depth_layers : Image{}).tests_depth(images.depth);
}

DrawPass draw_events_untested(Graph& graph, std::string shader, const DrawList& list, const FrameImages& images) {
    return bound(graph.draw(std::move(shader), list), images, images.depth_layers);
}

}  // namespace strata
