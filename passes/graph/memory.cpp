// Whole images are handed on, by equal shape: no raw aliasing of memory, so what a slot needs does not depend on the device.
#include <algorithm>
#include <limits>

#include "capture_format/frame/no_index.h"
#include "passes/graph/compiling.h"
#include "passes/graph/graph.h"

namespace strata {
namespace {

/// First and last surviving step that uses an image.
struct Life {
    std::uint32_t image = 0;
    std::size_t first = 0, last = 0;
};

std::vector<Life> lives_of_created_images(const Graph& graph, const Plan& plan) {
    std::vector<Life> lives;  // in order of their first step
    for (std::size_t step = 0; step < plan.steps.size(); ++step) {
        for (const Use& use : uses(plan.steps[step])) {
            if (!use.image || graph.record(use.image).import) continue;
            const auto known = std::ranges::find(lives, use.image.id, &Life::image);
            if (known == lives.end()) lives.push_back({use.image.id, step, step});
            else known->last = step;
        }
    }
    for (const Image kept : graph.kept_images()) {
        const auto life = std::ranges::find(lives, kept.id, &Life::image);
        if (life != lives.end()) life->last = std::numeric_limits<std::size_t>::max();  // read after the last step
    }
    return lives;
}

void count_buffers(const Graph& graph, Plan& plan) {
    for (const PlannedStep& planned : plan.steps) {
        for (const Use& use : uses(planned)) {
            if (!use.buffer || graph.record(use.buffer).import) continue;
            if (std::ranges::find(plan.used_buffers, use.buffer.id) == plan.used_buffers.end())
                plan.used_buffers.push_back(use.buffer.id);
        }
    }
    std::ranges::sort(plan.used_buffers);
    for (const std::uint32_t id : plan.used_buffers) plan.buffer_bytes += graph.buffers()[id].bytes;
}

}  // namespace

void assign_memory(const Graph& graph, Plan& plan) {
    std::vector<std::size_t> busy_until;  // per slot: the last step of its present owner
    plan.slot_of_image.assign(graph.images().size(), no_index);
    for (const Life& life : lives_of_created_images(graph, plan)) {
        const Shape& shape = graph.images()[life.image].shape;
        std::size_t slot = 0;
        while (slot < plan.slots.size() && (plan.slots[slot].shape != shape || busy_until[slot] >= life.first)) ++slot;
        if (slot == plan.slots.size()) {
            plan.slots.push_back({shape, bytes(shape), {}});
            plan.image_bytes += bytes(shape);
            busy_until.push_back(0);
        }
        plan.slots[slot].images.push_back(life.image);
        plan.slot_of_image[life.image] = static_cast<std::uint32_t>(slot);
        busy_until[slot] = life.last;
    }
    count_buffers(graph, plan);
}

}  // namespace strata
