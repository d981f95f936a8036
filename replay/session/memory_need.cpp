#include "replay/session/memory_need.h"

#include <algorithm>
#include <cstring>

#include "passes/frame_images.h"
#include "passes/stages.h"

namespace strata {
namespace {

// One-texel images, at most one per format and kind: a page each, and there are fewer than a hundred.
constexpr std::uint64_t stand_ins = 1 << 20;

constexpr std::size_t largest_named = 3;

/// A copy of mip 0 for the host; several samples are spread into layers first.
std::uint64_t read_back_bytes(const Executor& executor, Shape shape) {
    shape.mips = 1;
    if (shape.samples == 1) return executor.buffer_bytes(bytes(shape));
    Shape layers = shape;
    layers.layers = shape.samples;
    layers.samples = 1;
    if (row(layers.format).kind == FormatKind::depth) layers.format = Format::r32f;
    return executor.image_bytes(layers) + executor.buffer_bytes(bytes(layers));
}

void count_images(const Executor& executor, const Plan& plan, MemoryNeed& need) {
    for (const MemorySlot& slot : plan.slots) {
        if (slot.images.empty()) continue;
        const std::uint64_t bytes = executor.image_bytes(slot.shape);
        need.images += bytes;
        need.largest.emplace_back(plan.images[slot.images.front()].name, bytes);
    }
    for (const BufferRecord& buffer : plan.buffers)
        if (!buffer.import) need.largest.emplace_back(buffer.name, executor.buffer_bytes(buffer.bytes));
    std::ranges::stable_sort(need.largest, std::ranges::greater(), &std::pair<std::string, std::uint64_t>::second);
    need.largest.resize(std::min(need.largest.size(), largest_named));
}

double mib(std::uint64_t bytes) { return double(bytes) / (1 << 20); }

}  // namespace

MemoryNeed memory_need(const Executor& executor, const Plan& plan, const RunOptions& options,
                       std::span<const std::uint64_t> scene) {
    MemoryNeed need{.other = stand_ins};
    for (const std::uint64_t bytes : scene) {
        need.scene += executor.buffer_bytes(bytes);
        need.upload = std::max(need.upload, executor.buffer_bytes(bytes));  // at most: large ones go in pieces
    }
    count_images(executor, plan, need);
    for (const std::uint32_t id : plan.used_buffers) need.buffers += executor.buffer_bytes(plan.buffers[id].bytes);
    for (const BufferRecord& buffer : plan.buffers)
        if (buffer.remembered) need.buffers += executor.buffer_bytes(buffer.bytes);
    if (options.kept_images == KeptImages::read)
        for (const Image image : plan.kept_images)
            if (!plan.images[image.id].import) need.read_back += read_back_bytes(executor, plan.images[image.id].shape);
    for (const Buffer buffer : plan.kept_buffers) need.read_back += executor.buffer_bytes(plan.buffers[buffer.id].bytes);
    for (const Peek& peek : options.peeks) need.read_back += read_back_bytes(executor, plan.images[peek.image.id].shape);
    return need;
}

std::string text(const MemoryNeed& need) {
    std::string text = fmt::format(
        "{:.1f} of images, {:.1f} of buffers, {:.1f} of scene, {:.1f} to read back, {:.1f} "
        "of small things",
        mib(need.images), mib(need.buffers), mib(need.scene), mib(need.read_back), mib(need.other));
    for (std::size_t i = 0; i < need.largest.size(); ++i)
        text += fmt::format("{}'{}' {:.1f}", i == 0 ? "; the largest are " : ", ", need.largest[i].first,
                            mib(need.largest[i].second));
    return text;
}

std::vector<Life> lives_of(const Plan& plan) {
    std::map<std::pair<bool, std::uint32_t>, Life> lives;  // by kind and id
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
        for (const Use& use : uses(plan.steps[i])) {
            const bool is_image = bool(use.image);
            const std::uint32_t id = is_image ? use.image.id : use.buffer.id;
            const bool is_given = is_image ? plan.images[id].import.has_value()
                                           : plan.buffers[id].import.has_value() && !plan.buffers[id].remembered;
            if (is_given) continue;
            const std::uint64_t size = is_image ? bytes(plan.images[id].shape) : plan.buffers[id].bytes;
            lives.try_emplace({is_image, id}, Life{is_image, id, size, i, i}).first->second.last = i;
        }
    const auto keep = [&](bool is_image, std::uint32_t id) {
        if (const auto life = lives.find({is_image, id}); life != lives.end()) life->second.last = plan.steps.size();
    };
    for (const Image image : plan.kept_images) keep(true, image.id);
    for (const Buffer buffer : plan.kept_buffers) keep(false, buffer.id);
    std::vector<Life> all;
    for (const auto& [key, life] : lives) all.push_back(life);
    return all;
}

MemoryOverTime memory_over_time(const Plan& plan) {
    MemoryOverTime over_time;
    const std::vector<Life> lives = lives_of(plan);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        const Scope& scope = plan.scopes[plan.steps[i].step.scope];
        StageMemory& stage = over_time.stages[std::string(name(scope.stage))];
        std::uint64_t alive = 0;
        for (const Life& life : lives) {
            if (life.first <= i && i <= life.last) alive += life.bytes;
            if (life.first == i) stage.allocated += life.bytes;
        }
        over_time.alive.push_back(alive);
        stage.peak = std::max(stage.peak, alive);
        if (alive <= over_time.peak) continue;
        over_time.peak = alive;
        over_time.fullest_scope = scope;
        over_time.fullest_step = plan.steps[i].step.name;
    }
    return over_time;
}

}  // namespace strata
