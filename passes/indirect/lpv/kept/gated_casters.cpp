#include "passes/indirect/lpv/kept/gated_casters.h"

#include "passes/culling/draw_command.shared.h"
#include "passes/indirect/lpv/kept/kept.shared.h"

namespace strata::indirect {

FrameImages GatedCasters::seen_by(std::span<DeviceGrid* const> grids) {
    FrameImages seen = *frame_;
    DrawList& casters = seen.casters;
    if (!grids.front()->gates || casters.count == 0) return seen;
    std::uint32_t bits = 0;
    for (const DeviceGrid* grid : grids) bits |= grid->starting_bit();
    const auto [commands, is_new] = commands_.try_emplace(bits);
    if (is_new) {
        commands->second = graph_->create("commands of gated casters", std::uint64_t{casters.count} * sizeof(DrawCommand));
        graph_->compute("indirect/lpv/kept/casters.comp")
            .loads("AllCommands", casters.commands)
            .loads("Starting", grids.front()->starting)
            .stores("Commands", commands->second)
            .push(CastersPush{.first = casters.first, .count = casters.count, .grids = bits})
            .over({casters.count});
    }
    casters.commands = commands->second;
    casters.first = 0;
    return seen;
}

}  // namespace strata::indirect
