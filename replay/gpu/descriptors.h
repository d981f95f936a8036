// The descriptor sets of a run: one per set of a step, every slot written.
#pragma once

#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/plan.h"
#include "replay/gpu/pipelines.h"
#include "replay/gpu/placeholders.h"
#include "replay/gpu/plan_memory.h"

namespace strata {

class Samplers {
public:
    explicit Samplers(OpenedDevice&);
    vk::Sampler of(Filter filter) const { return *(filter == Filter::linear ? linear_ : nearest_); }

private:
    vk::raii::Sampler nearest_, linear_;  // both clamp to the edge
};

/// A pool with room for every step of one run.
class DescriptorSets {
public:
    DescriptorSets(OpenedDevice&, const Plan&, const Samplers&, Placeholders&);

    /// The sets of a step, by set number. Images are described in the layouts they have now.
    std::vector<vk::DescriptorSet> make(const PlannedStep&, const Pipeline&, const PlanResources&);

private:
    vk::DescriptorImageInfo describe_image(const PlannedBinding&, const PlanResources&) const;
    vk::DescriptorBufferInfo describe_buffer(const PlannedBinding&, const PlanResources&) const;

    OpenedDevice* device_;
    const Samplers* samplers_;
    Placeholders* placeholders_;
    vk::raii::DescriptorPool pool_;
};

}  // namespace strata
