// What a plan takes of the device before any of it is taken: what a memory budget is held against, and the figures of a run.
#pragma once

#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "passes/graph/plan.h"
#include "replay/gpu/executor.h"

namespace strata {

/// Bytes as the device counts them, which is a little more than the texels.
struct MemoryNeed {
    std::uint64_t images = 0, buffers = 0;  ///< of the plan
    std::uint64_t read_back = 0;            ///< copies on their way to the host
    std::uint64_t scene = 0;                ///< meshes, textures, lights
    std::uint64_t upload = 0;               ///< on the scene's way to the device, before there is anything of the plan
    std::uint64_t other = 0;                ///< what stands in for images a shader names and the frame lacks
    std::vector<std::pair<std::string, std::uint64_t>> largest;  ///< images, largest first, three at most
    std::uint64_t total() const { return scene + other + std::max(images + buffers + read_back, upload); }
};

/// scene: sizes of its buffers.
MemoryNeed memory_need(const Executor&, const Plan&, const RunOptions&, std::span<const std::uint64_t> scene);

/// "250.0 of images, 31.2 of buffers, ...; the largest are 'color' 133.0, ...", in MiB.
std::string text(const MemoryNeed&);

/// The steps that use an image or buffer of a plan's own, and the texels or bytes it takes.
struct Life {
    bool is_image = false;
    std::uint32_t id = 0;
    std::uint64_t bytes = 0;
    std::size_t first = 0, last = 0;  ///< what is kept lives to the end: last is the number of steps
};
/// Of every image and buffer that a step uses; buffers first.
std::vector<Life> lives_of(const Plan&);

/// What the steps of a stage hold.
struct StageMemory {
    std::uint64_t allocated = 0;  ///< images and buffers they are the first to use
    std::uint64_t peak = 0;       ///< the most that is alive at one of them, whatever stage made it
};

/// What is alive when, by the plan: images and buffers of its own, texels alone.
struct MemoryOverTime {
    std::map<std::string, StageMemory> stages;
    Scope fullest_scope;  ///< where the most is alive
    std::string fullest_step;
    std::uint64_t peak = 0;
    std::vector<std::uint64_t> alive;  ///< at each step
};
MemoryOverTime memory_over_time(const Plan&);

}  // namespace strata
