#include "ui/plan/plan_picture.h"

#include <algorithm>
#include <map>
#include <utility>

#include "passes/graph/describe.h"
#include "ui/replayer/step_work.h"

namespace strata::ui {
namespace {

/// An image or a buffer of a plan.
using Key = std::pair<bool, std::uint32_t>;
Key key_of(Image image, Buffer buffer) { return {bool(image), image ? image.id : buffer.id}; }

class Collector {
public:
    explicit Collector(const Plan& plan) : plan_(plan) {}

    void take_step(std::size_t index) {
        const PlannedStep& planned = plan_.steps[index];
        PlanStep step{plan_.scopes[planned.step.scope], planned.step.name, work_text(planned), {}};
        for (const Barrier& barrier : planned.barriers) step.barriers.push_back(describe(plan_, barrier));
        picture.steps.push_back(std::move(step));
        std::map<Key, AccessSet> accesses;
        for (const Use& use : uses(planned)) {
            const Key key = key_of(use.image, use.buffer);
            accesses[key] |= use.access;
            PlanTouch& touch = touch_of(key, index);
            touch.reads |= reads(use.access);
            touch.writes |= writes(use.access);
        }
        for (const auto& [key, set] : accesses) touch_of(key, index).access = names(set);
    }

    void take_lives() {
        for (const Life& life : lives_of(plan_)) {
            PlanResource& resource = picture.resources[rows_.at({life.is_image, life.id})];
            resource.last = life.last;
            resource.is_kept = life.last == plan_.steps.size();
        }
        for (PlanResource& resource : picture.resources)
            if (resource.is_imported) resource.last = resource.touches.back().step;
    }

    void take_memory() {
        for (const MemorySlot& slot : plan_.slots) add_memory(slot.bytes, slot.images, true);
        for (const std::uint32_t buffer : plan_.used_buffers) add_memory(plan_.buffers[buffer].bytes, {buffer}, false);
        std::ranges::stable_sort(picture.memory, std::ranges::greater(), &PlanMemory::bytes);
        for (std::size_t i = 0; i < picture.memory.size(); ++i)
            for (const std::size_t resource : picture.memory[i].resources) picture.resources[resource].memory = i;
    }

    PlanPicture picture;

private:
    PlanTouch& touch_of(const Key& key, std::size_t step) {
        const auto [known, is_new] = rows_.try_emplace(key, picture.resources.size());
        if (is_new) picture.resources.push_back(resource_of(key));
        std::vector<PlanTouch>& touches = picture.resources[known->second].touches;
        if (touches.empty() || touches.back().step != step) touches.push_back({.step = step});
        return touches.back();
    }

    PlanResource resource_of(const Key& key) const {
        PlanResource made{.is_image = key.first};
        if (key.first) {
            const ImageRecord& image = plan_.images[key.second];
            made.name = image.name;
            made.shape = describe(image.shape);
            made.bytes = bytes(image.shape);
            made.is_imported = image.import.has_value();
        } else {
            const BufferRecord& buffer = plan_.buffers[key.second];
            made.name = buffer.name;
            made.bytes = buffer.bytes;
            made.is_imported = buffer.import.has_value();
        }
        return made;
    }

    void add_memory(std::uint64_t size, const std::vector<std::uint32_t>& ids, bool are_images) {
        PlanMemory memory{.bytes = size, .resources = {}};
        for (const std::uint32_t id : ids)
            if (const auto row = rows_.find({are_images, id}); row != rows_.end()) memory.resources.push_back(row->second);
        if (are_images) picture.unshared_bytes += size * memory.resources.size();
        if (!memory.resources.empty()) picture.memory.push_back(std::move(memory));
    }

    const Plan& plan_;
    std::map<Key, std::size_t> rows_;
};

}  // namespace

const PlanTouch* PlanResource::touch(std::size_t step) const {
    const auto found = std::ranges::find(touches, step, &PlanTouch::step);
    return found == touches.end() ? nullptr : &*found;
}

std::optional<std::size_t> PlanResource::writer(std::size_t step) const {
    std::optional<std::size_t> found;
    for (const PlanTouch& each : touches)
        if (each.writes && each.step <= step) found = each.step;
    return found;
}

std::size_t PlanPicture::barriers() const {
    std::size_t count = at_the_end.size();
    for (const PlanStep& step : steps) count += step.barriers.size();
    return count;
}

PlanPicture picture_of(const Session::PlannedFrame& planned) {
    const Plan& plan = planned.plan;
    Collector collector(plan);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) collector.take_step(i);
    collector.take_lives();
    collector.take_memory();
    PlanPicture picture = std::move(collector.picture);
    for (const Barrier& barrier : plan.final_barriers) picture.at_the_end.push_back(describe(plan, barrier));
    picture.skipped = planned.skipped;
    picture.culled = plan.culled;
    picture.over_time = memory_over_time(plan);
    picture.image_bytes = plan.image_bytes;
    picture.buffer_bytes = plan.buffer_bytes;
    return picture;
}

}  // namespace strata::ui
