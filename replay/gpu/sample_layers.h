// A multisampled image for the host, which can only read single samples: a plan of its own spreads it into an array with one
// layer per sample.
#pragma once

#include "passes/graph/plan.h"
#include "replay/gpu/descriptors.h"
#include "replay/gpu/imports.h"
#include "replay/gpu/pipelines.h"
#include "replay/gpu/plan_memory.h"

namespace strata {

/// Lives until what it recorded has run.
class SampleLayers {
public:
    SampleLayers(OpenedDevice&, DeviceImage& multisampled, const Samplers&, Placeholders&);

    /// Records the copy. The layers are ready to be copied from; the image is left in some other layout than before.
    DeviceImage& record(const vk::raii::CommandBuffer&, PipelineStore&);

private:
    Plan plan_;
    Imports imports_;
    PlanMemory memory_;
    DescriptorSets sets_;
    PlanResources resources_;
};

}  // namespace strata
