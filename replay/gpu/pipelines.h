// Pipelines by what they are made of: shaders, constants, attachments, blending, depth, culling. Equal ones are made once for a
// device, whichever executor runs them, and kept while they are among the latest used: a CPU driver compiles at the first use of
// each, for up to seconds, and holds 2.5 MB for it.
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
    std::size_t created() const { return created_; }
    /// How many are kept from here on.
    void keep_at_most(std::size_t count) { most_kept_ = count; }
    /// What making them took so far.
    double milliseconds() const { return milliseconds_; }

private:
    struct Kept {
        Pipeline pipeline;
        std::uint64_t used = 0;  ///< the latest plan of which it was, counted
    };
    Pipeline made(const PlannedStep&, const RasterState&) const;
    const Pipeline& keep(std::string key, Pipeline);
    /// Drops those that were not used for longest, and none of the latest plan's.
    void drop_old();

    OpenedDevice* device_;
    std::map<std::string, Kept> pipelines_;
    std::uint64_t plans_ = 0;
    std::size_t created_ = 0;
    std::size_t most_kept_ = 32;  ///< as many as a group of a report's rows uses, and some
    double milliseconds_ = 0;
};

vk::DescriptorType descriptor_type(BindingKind);
/// Shader stages a step's pipeline has.
vk::ShaderStageFlags shader_stages(const Step&);

}  // namespace strata
