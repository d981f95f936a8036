#include "replay/gpu/feature_table.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/core.h>

#include "passes/stages.h"
#include "replay/gpu/format_table.h"

namespace strata {
namespace {

template <typename Owner>
vk::Bool32& field(FeatureChain& chain, vk::Bool32 Owner::*member) {
    if constexpr (std::is_same_v<Owner, vk::PhysicalDeviceFeatures>) {
        return chain.get<vk::PhysicalDeviceFeatures2>().features.*member;
    } else {
        return chain.get<Owner>().*member;
    }
}

struct FeatureRow {
    std::string_view name;
    vk::Bool32& (*of)(FeatureChain&);
};

template <auto Member>
constexpr FeatureRow feature(std::string_view name) {
    return {name, [](FeatureChain& chain) -> vk::Bool32& { return field(chain, Member); }};
}

using Core = vk::PhysicalDeviceFeatures;
using V11 = vk::PhysicalDeviceVulkan11Features;
using V12 = vk::PhysicalDeviceVulkan12Features;
using V13 = vk::PhysicalDeviceVulkan13Features;

constexpr FeatureRow baseline[] = {
    feature<&V13::dynamicRendering>("dynamicRendering"),
    feature<&V13::synchronization2>("synchronization2"),
    feature<&V13::maintenance4>("maintenance4"),
    feature<&V13::shaderDemoteToHelperInvocation>("shaderDemoteToHelperInvocation"),
    feature<&V13::subgroupSizeControl>("subgroupSizeControl"),
    feature<&V12::timelineSemaphore>("timelineSemaphore"),
    feature<&V12::hostQueryReset>("hostQueryReset"),
    feature<&V12::scalarBlockLayout>("scalarBlockLayout"),
    feature<&Core::fragmentStoresAndAtomics>("fragmentStoresAndAtomics"),
    feature<&Core::vertexPipelineStoresAndAtomics>("vertexPipelineStoresAndAtomics"),
    feature<&Core::independentBlend>("independentBlend"),
    feature<&Core::sampleRateShading>("sampleRateShading"),
    feature<&Core::samplerAnisotropy>("samplerAnisotropy"),
    feature<&Core::occlusionQueryPrecise>("occlusionQueryPrecise"),
    feature<&Core::multiDrawIndirect>("multiDrawIndirect"),
    feature<&Core::drawIndirectFirstInstance>("drawIndirectFirstInstance"),
    feature<&Core::fullDrawIndexUint32>("fullDrawIndexUint32"),
    feature<&Core::shaderStorageImageExtendedFormats>("shaderStorageImageExtendedFormats"),
    feature<&Core::shaderStorageImageWriteWithoutFormat>("shaderStorageImageWriteWithoutFormat"),
    feature<&Core::shaderClipDistance>("shaderClipDistance"),
    feature<&Core::shaderCullDistance>("shaderCullDistance"),
};

/// A capability that is a feature of the device, and another one that its shaders use.
struct CapabilityRow {
    Capability capability;
    FeatureRow feature, other = feature;
};

constexpr CapabilityRow beyond_baseline[] = {
    {Capability::buffer_int64_atomics, feature<&V12::shaderBufferInt64Atomics>("shaderBufferInt64Atomics"),
     feature<&Core::shaderInt64>("shaderInt64")},
    {Capability::shader_output_layer, feature<&V12::shaderOutputLayer>("shaderOutputLayer")},
    {Capability::geometry_shaders, feature<&Core::geometryShader>("geometryShader")},
    {Capability::dual_source_blending, feature<&Core::dualSrcBlend>("dualSrcBlend")},
    {Capability::counted_draws, feature<&V12::drawIndirectCount>("drawIndirectCount")},
};

bool ends_long_loops(const vk::raii::PhysicalDevice& device) {
    const auto properties = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceVulkan12Properties>();
    return properties.get<vk::PhysicalDeviceVulkan12Properties>().driverID == vk::DriverId::eMesaLlvmpipe;
}

FeatureChain features_of(const vk::raii::PhysicalDevice& device) {
    return device.getFeatures2<vk::PhysicalDeviceFeatures2, V11, V12, V13>();
}

bool offers(const vk::raii::PhysicalDevice& device, std::string_view wanted) {
    const auto extensions = device.enumerateDeviceExtensionProperties();
    return std::ranges::any_of(extensions, [&](const auto& extension) { return extension.extensionName.data() == wanted; });
}

bool has_interlock(const vk::raii::PhysicalDevice& device) {
    if (!offers(device, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME)) return false;
    const auto chain = device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDeviceFragmentShaderInterlockFeaturesEXT>();
    return chain.get<vk::PhysicalDeviceFragmentShaderInterlockFeaturesEXT>().fragmentShaderPixelInterlock;
}

std::string missing_format(const vk::raii::PhysicalDevice& device) {
    for (const FormatRow& row : format_rows) {
        const auto needed = needed_features(row.format);
        const auto offered = device.getFormatProperties(device_format(row.format)).optimalTilingFeatures;
        if ((offered & needed) != needed) return fmt::format("the format {} ({})", row.name, vk::to_string(needed & ~offered));
    }
    return {};
}

/// Of what low-resolution prepasses keep, the formats that a device need not filter.
bool filters_floats(const vk::raii::PhysicalDevice& device) {
    constexpr Format formats[] = {Format::r32f, Format::rg32f, Format::rgba32f, Format::rgba16_unorm};
    return std::ranges::all_of(formats, [&](Format format) {
        const auto offered = device.getFormatProperties(device_format(format)).optimalTilingFeatures;
        return bool(offered & vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
    });
}

std::string missing_limit(const vk::raii::PhysicalDevice& device) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceSubgroupProperties>();
    const vk::PhysicalDeviceLimits& limits = chain.get<vk::PhysicalDeviceProperties2>().properties.limits;
    const vk::SampleCountFlags four = limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts &
                                      limits.sampledImageColorSampleCounts & limits.sampledImageIntegerSampleCounts &
                                      limits.sampledImageDepthSampleCounts;
    if (!(four & vk::SampleCountFlagBits::e4)) return "4 samples per pixel";

    const auto& subgroup = chain.get<vk::PhysicalDeviceSubgroupProperties>();
    using Operation = vk::SubgroupFeatureFlagBits;
    const vk::SubgroupFeatureFlags operations =
        Operation::eBasic | Operation::eVote | Operation::eArithmetic | Operation::eBallot;
    const vk::ShaderStageFlags stages = vk::ShaderStageFlagBits::eCompute | vk::ShaderStageFlagBits::eFragment;
    if ((subgroup.supportedOperations & operations) != operations) return "subgroup arithmetic and ballots";
    if ((subgroup.supportedStages & stages) != stages) return "subgroup operations in fragment shaders";
    return {};
}

}  // namespace

std::string first_missing(const vk::raii::PhysicalDevice& device) {
    const auto properties = device.getProperties();
    // RADV without a GPU (RADV_FORCE_FAMILY) compiles but crashes at the first memory or command buffer (Mesa 22.3).
    if (std::string_view(properties.deviceName).starts_with("Null hardware")) return "hardware: it only compiles";
    if (properties.apiVersion < VK_API_VERSION_1_3) {
        return fmt::format("Vulkan 1.3 (it has {}.{})", VK_API_VERSION_MAJOR(properties.apiVersion),
                           VK_API_VERSION_MINOR(properties.apiVersion));
    }
    auto offered = features_of(device);
    for (const FeatureRow& row : baseline) {
        if (!row.of(offered)) return fmt::format("the feature {}", row.name);
    }
    if (!queue_family(device)) return "a queue for graphics and compute with timestamps";
    if (auto limit = missing_limit(device); !limit.empty()) return limit;
    return missing_format(device);
}

std::vector<std::string_view> baseline_features() {
    std::vector<std::string_view> names;
    for (const FeatureRow& row : baseline) names.push_back(row.name);
    return names;
}

Capabilities capabilities_of(const vk::raii::PhysicalDevice& device) {
    Capabilities found;
    if (device.getProperties().apiVersion < VK_API_VERSION_1_3) return found;
    auto features = features_of(device);
    for (const CapabilityRow& row : beyond_baseline)
        if (row.feature.of(features) && row.other.of(features)) found.push_back(row.capability);
    if (has_interlock(device)) found.push_back(Capability::fragment_interlock);
    if (!ends_long_loops(device)) found.push_back(Capability::long_loops);
    if (filters_floats(device)) found.push_back(Capability::filtered_floats);
    // lavapipe 22.3 lacks both, 25.0 the first. Of devices that are no GPU none is asked for more than bits that stay as they
    // are.
    if (device.getProperties().deviceType != vk::PhysicalDeviceType::eCpu)
        found.insert(found.end(), {Capability::sample_varyings, Capability::helper_invocations});
    return found;
}

bool counts_invocations(const vk::raii::PhysicalDevice& device) { return device.getFeatures().pipelineStatisticsQuery; }

std::optional<std::uint32_t> queue_family(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    const vk::QueueFlags everything = vk::QueueFlagBits::eGraphics | vk::QueueFlagBits::eCompute;
    const auto found = std::ranges::find_if(families, [&](const auto& family) {
        return (family.queueFlags & everything) == everything && family.timestampValidBits > 0;
    });
    if (found == families.end()) return std::nullopt;
    return static_cast<std::uint32_t>(found - families.begin());
}

std::uint64_t timestamp_mask(const vk::raii::PhysicalDevice& device) {
    const std::uint32_t bits = device.getQueueFamilyProperties()[*queue_family(device)].timestampValidBits;
    return bits < 64 ? (std::uint64_t{1} << bits) - 1 : ~std::uint64_t{0};
}

bool describes_pipelines(const vk::raii::PhysicalDevice& device) {
    if (!offers(device, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME)) return false;
    const auto chain =
        device.getFeatures2<vk::PhysicalDeviceFeatures2, vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>();
    return chain.get<vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR>().pipelineExecutableInfo;
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, const Capabilities& capabilities,
                             PipelineDescriptions descriptions) {
    FeatureChain wanted;
    for (const FeatureRow& row : baseline) row.of(wanted) = VK_TRUE;
    for (const CapabilityRow& row : beyond_baseline)
        if (has(capabilities, row.capability)) row.feature.of(wanted) = row.other.of(wanted) = VK_TRUE;
    wanted.get<vk::PhysicalDeviceFeatures2>().features.pipelineStatisticsQuery = counts_invocations(physical);

    std::vector<const char*> extensions;
    vk::PhysicalDeviceFragmentShaderInterlockFeaturesEXT interlock;
    if (has(capabilities, Capability::fragment_interlock)) {
        extensions.push_back(VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME);
        interlock.fragmentShaderPixelInterlock = VK_TRUE;
        interlock.pNext = std::exchange(wanted.get<V13>().pNext, &interlock);
    }
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR described(VK_TRUE);
    if (descriptions == PipelineDescriptions::on) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        described.pNext = std::exchange(wanted.get<V13>().pNext, &described);
    }
    constexpr std::array priority = {1.0f};
    const vk::DeviceQueueCreateInfo queue({}, *queue_family(physical), priority);
    const vk::DeviceCreateInfo info({}, queue, {}, extensions, nullptr, &wanted.get<vk::PhysicalDeviceFeatures2>());
    return {physical, info};
}

}  // namespace strata
