// One rule: every use waits for the previous one, except repeating the same read. A chain of read barriers keeps the first
// write visible to every later stage. States are kept per mip and layer of each memory slot, so an heir starts from what the
// previous owner did last, wherever that was.
#include <algorithm>
#include <functional>

#include "capture_format/frame/no_index.h"
#include "passes/graph/compiling.h"
#include "passes/graph/graph.h"

namespace strata {
namespace {

/// What was last done to one mip of one layer, and for which image (a slot changes owners).
struct State {
    AccessSet last;
    std::uint32_t owner = no_index;
};

/// The barrier one mip of one layer needs, if any.
struct Need {
    AccessSet before, after;
    bool wanted = false, discard = false;
    friend bool operator==(const Need&, const Need&) = default;
};

bool waits(AccessSet before, AccessSet after) { return !(before == after && !writes(before)); }

class Tracker {
public:
    Tracker(const Graph& graph, const Plan& plan)
        : graph_(graph),
          plan_(plan),
          slots_(plan.slots.size()),
          imports_(graph.images().size()),
          buffers_(graph.buffers().size()) {
        for (std::size_t slot = 0; slot < slots_.size(); ++slot) slots_[slot].resize(parts_of(plan.slots[slot].shape));
        for (std::size_t id = 0; id < imports_.size(); ++id)
            if (graph.images()[id].import)
                imports_[id].assign(parts_of(graph.images()[id].shape), {Access::copied_from, static_cast<std::uint32_t>(id)});
    }

    /// Everything one step does, as barriers before it.
    std::vector<Barrier> step(const std::vector<Use>& all) {
        std::vector<Barrier> barriers;
        std::vector<std::uint32_t> done_images, done_buffers;
        for (const Use& use : all) {
            std::vector<std::uint32_t>& done = use.image ? done_images : done_buffers;
            const std::uint32_t id = use.image ? use.image.id : use.buffer.id;
            if (std::ranges::find(done, id) != done.end()) continue;
            done.push_back(id);
            use.image ? image(use.image, all, barriers) : buffer(use.buffer, all, barriers);
        }
        return barriers;
    }

    bool touched(Image image) const { return graph_.record(image).import || plan_.slot_of_image[image.id] != no_index; }
    bool touched(Buffer buffer) const { return !buffers_[buffer.id].empty(); }

private:
    static std::size_t parts_of(const Shape& shape) { return std::size_t{shape.mips} * shape.layers; }

    void image(Image image, const std::vector<Use>& all, std::vector<Barrier>& barriers) {
        const Shape& shape = graph_.shape(image);
        const std::uint32_t slot = plan_.slot_of_image[image.id];
        std::vector<State>& states = slot == no_index ? imports_[image.id] : slots_[slot];
        std::vector<Need> needs(states.size());
        for (std::uint32_t mip = 0; mip < shape.mips; ++mip) {
            for (std::uint32_t layer = 0; layer < shape.layers; ++layer) {
                const std::size_t at = std::size_t{mip} * shape.layers + layer;
                const AccessSet now = accesses_at(all, image, {mip, layer});
                if (now.empty()) continue;
                const bool foreign = states[at].owner != image.id;
                if (foreign || waits(states[at].last, now)) needs[at] = {states[at].last, now, true, foreign};
                states[at] = {now, image.id};
            }
        }
        emit(image, shape, needs, barriers);
    }

    static AccessSet accesses_at(const std::vector<Use>& all, Image image, Part part) {
        AccessSet set;
        for (const Use& use : all) {
            if (!use.image || use.image.id != image.id) continue;
            if (use.part.mip && *use.part.mip != *part.mip) continue;
            if (use.part.layer && *use.part.layer != *part.layer) continue;
            set |= use.access;
        }
        return set;
    }

    /// As few barriers as say the same: the whole image, whole mips, whole layers, or each part alone.
    static void emit(Image image, const Shape& shape, const std::vector<Need>& needs, std::vector<Barrier>& barriers) {
        const auto need = [&](std::uint32_t mip, std::uint32_t layer) { return needs[std::size_t{mip} * shape.layers + layer]; };
        const auto add = [&](const Need& n, Part part) {
            if (!n.wanted) return;
            barriers.push_back({image, {}, part, leading(n.before), leading(n.after), n.before, n.after, n.discard});
        };
        if (std::ranges::all_of(needs, [&](const Need& n) { return n == needs.front(); })) return add(needs.front(), {});
        bool whole_mips = true, whole_layers = true;
        for (std::uint32_t mip = 0; mip < shape.mips; ++mip) {
            for (std::uint32_t layer = 0; layer < shape.layers; ++layer) {
                whole_mips &= need(mip, layer) == need(mip, 0);
                whole_layers &= need(mip, layer) == need(0, layer);
            }
        }
        for (std::uint32_t mip = 0; mip < (whole_layers ? 1 : shape.mips); ++mip) {
            for (std::uint32_t layer = 0; layer < (whole_mips ? 1 : shape.layers); ++layer) {
                Part part;
                if (!whole_layers) part.mip = mip;
                if (!whole_mips) part.layer = layer;
                add(need(mip, layer), part);
            }
        }
    }

    void buffer(Buffer buffer, const std::vector<Use>& all, std::vector<Barrier>& barriers) {
        AccessSet now;
        for (const Use& use : all)
            if (!use.image && use.buffer.id == buffer.id) now |= use.access;
        AccessSet& last = buffers_[buffer.id];
        if (!last.empty() && waits(last, now))
            barriers.push_back({{}, buffer, {}, leading(last), leading(now), last, now, false});
        last = now;
    }

    const Graph& graph_;
    const Plan& plan_;
    std::vector<std::vector<State>> slots_;    ///< per slot, mip by mip, layer by layer
    std::vector<std::vector<State>> imports_;  ///< per image id, empty for created ones
    std::vector<AccessSet> buffers_;           ///< per buffer id
};

/// The host copies what is kept, and imports are left as the next plan expects them.
std::vector<Use> uses_after_the_frame(const Graph& graph, const Plan& plan, const Tracker& tracker) {
    std::vector<Use> all;
    std::vector<bool> used(graph.images().size());
    for (const PlannedStep& planned : plan.steps)
        for (const Use& use : uses(planned))
            if (use.image) used[use.image.id] = true;
    for (std::uint32_t id = 0; id < used.size(); ++id) {
        const Image image{id, graph.images()[id].version};
        const bool kept = std::ranges::any_of(graph.kept_images(), [id](Image k) { return k.id == id; });
        if ((used[id] && graph.images()[id].import) || (kept && tracker.touched(image)))
            all.push_back({.as = "end", .access = Access::copied_from, .image = image});
    }
    for (const Buffer kept : graph.kept_buffers())
        if (tracker.touched(kept)) all.push_back({.as = "end", .access = Access::copied_from, .buffer = kept});
    return all;
}

}  // namespace

void place_barriers(const Graph& graph, Plan& plan) {
    Tracker tracker(graph, plan);
    for (PlannedStep& planned : plan.steps) planned.barriers = tracker.step(uses(planned));
    plan.final_barriers = tracker.step(uses_after_the_frame(graph, plan, tracker));
}

}  // namespace strata
