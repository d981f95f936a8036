// What an access means to the device: who touches the resource, how, and in which layout an image must be.
#pragma once

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/access.h"
#include "passes/graph/format.h"

namespace strata {

struct DeviceAccess {
    vk::PipelineStageFlags2 stages;
    vk::AccessFlags2 mask;
    vk::ImageLayout layout;
};

/// Everything a step does at once to a resource; the kind is the image's. Depth that is sampled and depth that is only tested
/// share a layout, so that one step may do both; other accesses that disagree meet in the general layout.
DeviceAccess device_access(AccessSet, FormatKind = FormatKind::real);

}  // namespace strata
