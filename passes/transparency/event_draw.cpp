#include "passes/transparency/event_draw.h"

#include <utility>

#include "passes/texture_uses.h"

namespace strata {

DrawPass draw_events(Graph& graph, std::string shader, const DrawList& list, const FrameImages& images) {
    const bool soft = images.features->has(Feature::soft_particles);
    DrawPass pass = graph.draw(std::move(shader), list);
    pass.tests_depth(images.depth)
        .samples("depth_layers", soft ? images.depth_layers : Image{})
        .fixes("soft_fade", soft ? 1u : 0u)
        .fixes("sample_near", images.samples > 1 ? images.recorded->view.near : 0.f)
        .fixes("first_emitter", static_cast<std::uint32_t>(images.recorded->draws.size()));
    return fix_textures(pass, images, Surfaces::transparent);
}

}  // namespace strata
