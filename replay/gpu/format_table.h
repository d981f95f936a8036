// The device's names of the formats a pass may ask for, and what a device must be able to do with each.
#pragma once

#include <vulkan/vulkan_raii.hpp>

#include "passes/graph/format.h"

namespace strata {

struct Shape;  // passes/graph/step.h

vk::Format device_format(Format);
vk::ImageAspectFlags aspect_of(Format);

/// What the baseline asks of the format: sampled, copied, and where the table says so stored, drawn to and blended.
vk::FormatFeatureFlags needed_features(Format);
/// How an image of the shape may be used: all the format can do (a multisampled image is never a storage image).
vk::ImageUsageFlags image_usage(const Shape&);

}  // namespace strata
