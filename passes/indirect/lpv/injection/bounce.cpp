#include "passes/indirect/lpv/injection/bounce.h"

#include "passes/frame_images.h"
#include "passes/indirect/lpv/apply/apply.h"
#include "passes/indirect/lpv/surfels/surfels.h"

namespace strata::indirect {

DeviceGrid reflected(Graph& graph, const FrameImages& frame, const LpvParams& params, const DeviceGrid& lit) {
    DeviceGrid next = lit;
    ++next.bounce;
    next.total = {};
    next.scale = graph.create(next.name("fixed point of grid"), sizeof(float));
    graph.compute("indirect/lpv/injection/brightest.comp")
        .loads("Total", lit.total)
        .stores("Scale", next.scale)
        .fixes("cell_storage", lit.storage)
        .fixes("channels", lit.channels)
        .push(lit.place)
        .groups({1, 1, 1});
    next.sums = graph.create(next.name("injected light of grid"), lit.sums_bytes());
    graph.clear(next.sums, 0);
    draw_surfels(graph, frame, lit, "indirect/lpv/injection/reflect", [&](DrawStep& draw) {
        bind_taps(draw, frame, params, lit)
            .loads("Scale", next.scale)
            .updates("Sums", next.sums)
            .fixes("guards", lit.has_links ? 1u : 0u)
            .fixes("irradiance", irradiance_cell)
            .fixes("bias", params.injection);
    });
    return next;
}

}  // namespace strata::indirect
