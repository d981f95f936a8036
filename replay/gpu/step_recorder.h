// Records the steps of a plan into a command buffer: barriers, then the work. Layouts follow the barriers as they are recorded.
#pragma once

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/plan.h"
#include "replay/gpu/descriptors.h"
#include "replay/gpu/pipelines.h"
#include "replay/gpu/plan_memory.h"

namespace strata {

/// Everything waits for everything.
void full_barrier(const vk::raii::CommandBuffer&);

class StepRecorder {
public:
    StepRecorder(const vk::raii::CommandBuffer&, const Plan&, PlanResources&, PipelineStore&, DescriptorSets&);

    void barriers(const std::vector<Barrier>&);
    void work(const PlannedStep&);

private:
    void record(const PlannedStep&, const ComputeWork&);
    void record(const PlannedStep&, const DrawWork&);
    void record(const PlannedStep&, const FullscreenWork&);
    void record(const PlannedStep&, const CopyWork&);
    void record(const PlannedStep&, const ClearWork&);

    /// Pipeline, descriptor sets and push constants.
    void bind(const PlannedStep&);
    /// What a step draws of its attachments: all of them where it says nothing.
    struct Pixels {
        std::optional<Extent> viewport;
        std::optional<Rows> rows = {};
        std::optional<PixelColumns> columns = {};
    };
    /// Begins a rendering scope over the step's attachments, or over the viewport where it has none. Rows and columns are its
    /// scissor and its render area: the viewport, and with it every coverage and depth, is the same with and without them.
    void begin_rendering(const PlannedStep&, const Pixels&);
    vk::RenderingAttachmentInfo attach(const PlannedStep&, const Attachment&);

    const vk::raii::CommandBuffer* commands_;
    const Plan* plan_;
    PlanResources* resources_;
    PipelineStore* pipelines_;
    DescriptorSets* sets_;
};

}  // namespace strata
