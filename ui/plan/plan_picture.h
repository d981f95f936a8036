// A plan as what is drawn of it: steps as columns in order, images and buffers as rows, who touches what, who shares memory with
// whom. Values alone: a plan points at shaders that may be gone by the time it is drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "replay/session/session.h"

namespace strata::ui {

struct PlanStep {
    Scope scope;
    std::string name, work;             ///< as in StepRecord; "compute, 10 x 6 x 1 groups"
    std::vector<std::string> barriers;  ///< before it
    std::string short_name() const { return name.substr(name.rfind('/') + 1); }
};

/// Everything one step does to one image or buffer.
struct PlanTouch {
    std::size_t step = 0;
    bool reads = false, writes = false;
    std::string access;  ///< "depth_tested and sampled"
};

struct PlanResource {
    bool is_image = false, is_imported = false, is_kept = false;
    std::string name, shape;  ///< of an image: "64 x 36 rgba16f"
    std::uint64_t bytes = 0;
    std::optional<std::size_t> memory;  ///< which PlanMemory it lies in; none where it comes from outside of the plan
    std::vector<PlanTouch> touches;     ///< in the order of steps, one per step
    std::size_t last = 0;               ///< the step until which it lives; of what is kept: the number of steps
    std::size_t first() const { return touches.front().step; }
    const PlanTouch* touch(std::size_t step) const;
    /// The last step at or before `step` that writes it.
    std::optional<std::size_t> writer(std::size_t step) const;
};

/// Memory of one shape, and who has it one after the other.
struct PlanMemory {
    std::uint64_t bytes = 0;
    std::vector<std::size_t> resources;
};

struct PlanPicture {
    std::vector<PlanStep> steps;
    std::vector<PlanResource> resources;  ///< that a step touches, in the order of their first step
    std::vector<PlanMemory> memory;       ///< largest first
    std::vector<std::string> at_the_end;  ///< barriers after the last step
    std::vector<SkippedStage> skipped;
    std::vector<CulledStep> culled;
    MemoryOverTime over_time;
    std::uint64_t image_bytes = 0, buffer_bytes = 0, unshared_bytes = 0;  ///< unshared: images, if none shared memory
    std::size_t barriers() const;
};

PlanPicture picture_of(const Session::PlannedFrame&);

}  // namespace strata::ui
