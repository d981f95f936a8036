// The baseline a device must have: Vulkan 1.3, a table of features, the formats of passes/graph/format.h, 4 samples per pixel,
// subgroup arithmetic, and a queue that does everything.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "passes/capability.h"

namespace strata {

using FeatureChain = vk::StructureChain<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceVulkan11Features,
                                        vk::PhysicalDeviceVulkan12Features, vk::PhysicalDeviceVulkan13Features>;

/// Empty when the device can replay, else the first thing it lacks, as it reads after "lacks": "the feature timelineSemaphore".
std::string first_missing(const vk::raii::PhysicalDevice&);

/// The features of the baseline by Vulkan's names for them.
std::vector<std::string_view> baseline_features();

/// What the device has beyond the baseline.
Capabilities capabilities_of(const vk::raii::PhysicalDevice&);

/// Whether queries can count how often shaders ran.
bool counts_invocations(const vk::raii::PhysicalDevice&);
/// The family of the one queue: graphics and compute with timestamps.
std::optional<std::uint32_t> queue_family(const vk::raii::PhysicalDevice&);
/// The bits of that family's timestamps that count.
std::uint64_t timestamp_mask(const vk::raii::PhysicalDevice&);

/// Whether pipelines can say what the compiler made of them (VK_KHR_pipeline_executable_properties).
bool describes_pipelines(const vk::raii::PhysicalDevice&);
enum class PipelineDescriptions { off, on };

/// A device with the baseline and the capabilities switched on.
vk::raii::Device make_device(const vk::raii::PhysicalDevice&, const Capabilities&,
                             PipelineDescriptions = PipelineDescriptions::off);

}  // namespace strata
