#include "passes/indirect/lpv/kept/kept.h"

#include <algorithm>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "passes/frame_images.h"
#include "passes/indirect/lpv/kept/kept.shared.h"
#include "passes/indirect/lpv/kept/keys.h"
#include "passes/indirect/lpv/propagation/propagation.h"

namespace strata::indirect {
namespace {

std::uint32_t count_of(const std::vector<Blocker>& blockers) { return static_cast<std::uint32_t>(blockers.size()); }
std::uint32_t count_of(const std::vector<Portal>& portals) { return static_cast<std::uint32_t>(portals.size()); }

/// Light that comes in slices is shown late.
Remembered remembered(const LpvParams& params) { return params.slice > 0 ? Remembered::history : Remembered::work; }

/// A cell of the lattice as shaders count them: differences of near cells are right whatever the lattice is.
uvec3 wrapped(const glm::i64vec3& cell) { return uvec3(cell); }

/// Modulo the grid's cells.
uvec3 turned(const glm::i64vec3& first, const uvec3& cells) {
    const glm::i64vec3 size(cells);
    return uvec3((first % size + size) % size);
}

Buffer identities_on_device(Graph& graph, const Frame& frame) {
    const std::vector<uvec2> identities = barrier_identities(frame);
    Buffer buffer = graph.create("identities of blockers and portals", identities.size() * sizeof(uvec2));
    for (std::uint32_t first = 0; first < identities.size(); first += identities_per_push) {
        IdentityPush push{
            .first = first, .count = std::min(identities_per_push, std::uint32_t(identities.size()) - first), .of = {}};
        std::copy_n(identities.begin() + first, push.count, push.of);
        graph.compute("indirect/lpv/kept/identities.comp").stores("Identities", buffer).push(push).groups({1, 1, 1});
    }
    return buffer;
}

KeptGrid decide(Graph& graph, const FrameImages& frame, const LpvParams& params, DeviceGrid& grid, Buffer& starting) {
    const GridKeys keys = keys_of(frame, params, grid);
    const std::uint32_t steps = iterations(params, grid);
    KeptGrid kept{.state = graph.remember(grid.name("state of kept grid"), sizeof(KeptState), remembered(params)),
                  .work = graph.create(grid.name("work of kept grid"), sizeof(KeptWork)),
                  .lattice = keys.lattice};
    grid.gates = graph.create(grid.name("gates of grid"), (gate_first_step + std::uint64_t{steps}) * sizeof(uvec3));
    graph.compute("indirect/lpv/kept/decide.comp")
        .updates("State", kept.state)
        .stores("Work", kept.work)
        .stores("Gates", grid.gates)
        .updates("Starting", starting)
        .push(DecidePush{.light = keys.light,
                         .place = keys.place,
                         .linked = keys.linked,
                         .lattice = keys.lattice,
                         .first = wrapped(first_cell(grid.grid)),
                         .cells = grid.grid.cells,
                         .iterations = steps,
                         .slice = params.slice,
                         .blockers = count_of(frame.recorded->blockers),
                         .portals = count_of(frame.recorded->portals),
                         .grid = grid.number})
        .groups({1, 1, 1});
    return kept;
}

void find_faces(Graph& graph, const FrameImages& frame, Remembered as, const KeptGrid& kept, const Buffer& identities,
                DeviceGrid& grid) {
    const std::uint64_t bytes = std::uint64_t{grid.cells()} * 3 * sizeof(float);
    const std::uint32_t count = count_of(frame.recorded->blockers) + count_of(frame.recorded->portals);
    Buffer barriers = graph.remember(grid.name("barriers of kept grid"), count * sizeof(KeptBarrier), as);
    Buffer kept_links = graph.remember(grid.name("links by world cell of kept grid"), bytes, as);
    grid.links = graph.remember(grid.name("links of kept grid"), bytes, as);
    const LightGrid& g = grid.grid;
    gated(fix_blockers(graph.compute("indirect/lpv/kept/faces.comp"), frame)
              .updates("Links", grid.links)
              .updates("KeptLinks", kept_links)
              .loads("Work", kept.work)
              .loads("Identities", identities)
              .loads("Barriers", barriers)
              .takes_first(grid.eye.records)
              .push(FacesPush{.grid = grid.lit_place,
                              .lattice = kept.lattice,
                              .first = wrapped(first_cell(g)),
                              .turn = turned(first_cell(g), g.cells)}),
          grid, gate_faces, {g.cells.x, g.cells.y, 3 * g.cells.z});
    gated(fix_blockers(graph.compute("indirect/lpv/kept/barriers.comp"), frame)
              .updates("Barriers", barriers)
              .loads("Identities", identities)
              .takes_first(grid.eye.records)
              .push(grid.lit_place),
          grid, gate_barriers, {count});
}

void recall_light(Graph& graph, const LpvParams& params, KeptGrid& kept, DeviceGrid& grid) {
    const Buffer shown = graph.remember(grid.name("light of kept grid"), grid.total_bytes(), remembered(params));
    if (params.slice == 0) {
        grid.total = shown;
        return;
    }
    kept.shown = shown;
    grid.total = graph.remember(grid.name("coming light of kept grid"), grid.total_bytes());
    grid.even = graph.remember(grid.name("light of even steps of kept grid"), grid.step_bytes());
    grid.odd = graph.remember(grid.name("light of odd steps of kept grid"), grid.step_bytes());
}

}  // namespace

KeptGrids recall(Graph& graph, const FrameImages& frame, const LpvParams& params, std::vector<DeviceGrid>& grids) {
    KeptGrids kept;
    const std::uint32_t last = grids.empty() ? 0 : grids.back().number;
    Buffer starting = graph.create("grids that are lit anew", (starting_word(last) + 1) * sizeof(std::uint32_t));
    graph.clear(starting, 0);
    for (DeviceGrid& grid : grids) kept.push_back(decide(graph, frame, params, grid, starting));
    const bool any_links = std::ranges::any_of(grids, &DeviceGrid::has_links);
    const Buffer identities = any_links ? identities_on_device(graph, *frame.recorded) : Buffer();
    for (std::size_t i = 0; i < grids.size(); ++i) {
        grids[i].starting = starting;
        if (grids[i].has_links) find_faces(graph, frame, remembered(params), kept[i], identities, grids[i]);
        recall_light(graph, params, kept[i], grids[i]);
    }
    return kept;
}

void keep(Graph& graph, std::vector<DeviceGrid>& grids, KeptGrids& kept) {
    for (std::size_t i = 0; i < grids.size(); ++i) {
        DeviceGrid& grid = grids[i];
        if (kept[i].shown) {
            gated(graph.compute("indirect/lpv/kept/show.comp")
                      .loads("Coming", grid.total)
                      .stores("Shown", kept[i].shown)
                      .fixes("cell_storage", grid.storage)
                      .fixes("channels", grid.channels)
                      .push(grid.place),
                  grid, gate_show, grid.threads());
            grid.total = kept[i].shown;
        }
        graph.compute("indirect/lpv/kept/leave.comp")
            .stores("State", kept[i].state)
            .loads("Work", kept[i].work)
            .groups({1, 1, 1});
    }
}

}  // namespace strata::indirect
