// Pipelines by what they are made of: shaders, constants, attachments, blending, depth, culling. Equal ones are made once and
// kept as long as the device: a CPU driver compiles at the first use of each, for up to seconds.
#pragma once

#include <cstdint>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/plan.h"

namespace strata {

class OpenedDevice;
struct RasterState;

struct Pipeline {
    std::vector<vk::raii::DescriptorSetLayout> sets;  ///< by set number, empty layouts for gaps
    vk::raii::PipelineLayout layout;
    vk::raii::Pipeline handle;
};

/// A pipeline by itself, that no store keeps. The flags are for who wants to know what the compiler made of it.
Pipeline make_pipeline(const vk::raii::Device&, const PlannedStep&, const RasterState&, vk::PipelineCreateFlags = {});

class PipelineStore {
public:
    explicit PipelineStore(OpenedDevice&);

    /// Makes what the first `steps` steps of a plan need and is not there yet, on all cores: on a CPU driver that is most of the
    /// time to the first picture. What cannot be made is left for find() to fail at, and so is what a stop came before.
    void make(const Plan&, std::size_t steps, const std::stop_token&);
    /// The pipeline of a compute or raster step. Images are those of the plan.
    const Pipeline& find(const PlannedStep&, const std::vector<ImageRecord>& images);
    std::size_t created() const { return pipelines_.size(); }
    /// What making them took so far.
    double milliseconds() const { return milliseconds_; }

private:
    Pipeline made(const PlannedStep&, const RasterState&) const;

    OpenedDevice* device_;
    std::map<std::string, Pipeline> pipelines_;
    double milliseconds_ = 0;
};

vk::DescriptorType descriptor_type(BindingKind);
/// Shader stages a step's pipeline has.
vk::ShaderStageFlags shader_stages(const Step&);

}  // namespace strata
