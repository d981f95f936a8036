// Finding and opening devices. What one must have is in feature_table.cpp.
#include "replay/gpu/device.h"

#include <malloc.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <fstream>

#include "capture_format/nearest_name.h"
#include "replay/gpu/feature_table.h"
#include "replay/gpu/kept_pipelines.h"
#include "replay/gpu/library_build.h"
#include "replay/gpu/opened_device.h"

namespace strata {
namespace {

std::string cpu_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        const auto colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
    }
    return "unknown";
}

/// A driver that renders on the CPU allocates the transformed vertices of every draw anew. By glibc's defaults each of them goes
/// back to the kernel, and zeroing its pages again took lavapipe 22.3 a third of a frame of 1024 spheres.
void keep_freed_memory() {
    mallopt(M_MMAP_THRESHOLD, 32 << 20);  // glibc takes no more
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

std::string kind_of(vk::PhysicalDeviceType type) {
    switch (type) {
        case vk::PhysicalDeviceType::eDiscreteGpu:
            return "discrete";
        case vk::PhysicalDeviceType::eIntegratedGpu:
            return "integrated";
        case vk::PhysicalDeviceType::eVirtualGpu:
            return "virtual";
        case vk::PhysicalDeviceType::eCpu:
            return "cpu";
        default:
            return "other";
    }
}

/// Lower is chosen first.
int rank(const DeviceInfo& device) {
    constexpr std::string_view order[] = {"discrete", "integrated", "virtual", "other", "cpu"};
    return static_cast<int>(std::ranges::find(order, device.kind) - std::begin(order));
}

/// SwiftShader says nothing of itself that changes with its code.
std::string driver_version(const vk::PhysicalDeviceDriverProperties& driver) {
    if (driver.driverID != vk::DriverId::eGoogleSwiftshader || driver.driverInfo[0] != '\0') return driver.driverInfo;
    return "build " + build_of_library("vk_swiftshader").value_or("unknown");
}

DeviceInfo describe(const vk::raii::PhysicalDevice& device, std::uint32_t index) {
    const auto chain = device.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties,
                                             vk::PhysicalDeviceSubgroupProperties>();
    const auto& properties = chain.get<vk::PhysicalDeviceProperties2>().properties;
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return {.index = index,
            .name = properties.deviceName,
            .driver = driver.driverName,
            .driver_version = driver_version(driver),
            .cpu = cpu_name(),
            .kind = kind_of(properties.deviceType),
            .software = properties.deviceType == vk::PhysicalDeviceType::eCpu,
            .vector_width = chain.get<vk::PhysicalDeviceSubgroupProperties>().subgroupSize,
            .max_buffer_bytes = properties.limits.maxStorageBufferRange,
            .max_image_extent = properties.limits.maxImageDimension2D,
            .snap_steps = 1u << properties.limits.subPixelPrecisionBits,
            .capabilities = capabilities_of(device),
            .lacks = first_missing(device)};
}

std::vector<DeviceInfo> describe_all(const std::vector<vk::raii::PhysicalDevice>& devices) {
    std::vector<DeviceInfo> described;
    for (const auto& device : devices) described.push_back(describe(device, static_cast<std::uint32_t>(described.size())));
    return described;
}

/// Takes what the user names away from every device.
Result<void> leave_out(std::vector<DeviceInfo>& devices, const std::vector<std::string>& without) {
    const std::vector<std::string_view> features = baseline_features();
    for (const std::string& wanted : without) {
        std::vector<std::string_view> known = features;
        bool is_known = std::ranges::find(features, wanted) != features.end();
        for (DeviceInfo& device : devices)
            if (is_known && device.lacks.empty()) device.lacks = fmt::format("the feature {} (by --without)", wanted);
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Capability::count_); ++i) {
            const auto capability = static_cast<Capability>(i);
            known.push_back(name(capability));
            if (name(capability) != wanted) continue;
            is_known = true;
            for (DeviceInfo& device : devices) std::erase(device.capabilities, capability);
        }
        if (!is_known)
            return fail(Fault::usage, "device.unknown_feature", "no device feature is called '{feature}'{suggestion}", wanted,
                        did_you_mean(wanted, known));
    }
    return {};
}

std::string list_of(const std::vector<DeviceInfo>& devices) {
    std::string list;
    for (const DeviceInfo& device : devices) {
        list +=
            fmt::format("\n  {}: {} ({}, {} {})", device.index, device.name, device.kind, device.driver, device.driver_version);
        if (!device.lacks.empty()) list += fmt::format(", lacks {}", device.lacks);
    }
    return list.empty() ? " none" : list;
}

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

bool is_meant(const DeviceInfo& device, const std::string& gpu) {
    const bool is_index = !gpu.empty() && std::ranges::all_of(gpu, [](unsigned char c) { return std::isdigit(c) != 0; });
    if (is_index) return gpu == std::to_string(device.index);
    const auto has_it = [&](const std::string& text) { return lower(text).find(lower(gpu)) != std::string::npos; };
    return has_it(device.name) || has_it(device.driver) || has_it(device.driver_version);
}

/// The best of those that are meant; one that can replay before one that cannot.
Result<DeviceInfo> choose(const std::vector<DeviceInfo>& devices, const std::string& gpu) {
    const DeviceInfo* best = nullptr;
    const auto order = [](const DeviceInfo& device) { return std::pair(!device.lacks.empty(), rank(device)); };
    for (const DeviceInfo& device : devices) {
        if (is_meant(device, gpu) && (!best || order(device) < order(*best))) best = &device;
    }
    if (!best && gpu.empty()) return fail(Fault::device_lacks, "device.none", "this machine has no Vulkan device");
    if (!best)
        return fail(Fault::usage, "device.unknown", "no device is called '{device}'; there are:{known}", gpu, list_of(devices));
    if (best->lacks.empty()) return *best;
    if (gpu.empty())
        return fail(Fault::device_lacks, "device.none_can_replay", "no device of this machine can replay:{known}",
                    list_of(devices));
    return fail(Fault::device_lacks, "device.lacks_feature", "{device} lacks {feature}; there are:{known}", best->name,
                best->lacks, list_of(devices));
}

/// A driver without its hardware fails here, and the machine then has no device.
Result<std::vector<vk::raii::PhysicalDevice>> physical_devices(const Instance& instance) {
    try {
        return instance.handle().enumeratePhysicalDevices();
    } catch (const vk::SystemError& problem) {
        return fail(Fault::device_lacks, "device.cannot_list", "the devices of this machine cannot be listed: {reason}",
                    problem.what());
    }
}

}  // namespace

Result<std::vector<DeviceInfo>> list_devices() {
    const auto instance = Instance::create(Validation::off);
    if (!instance) return instance.error();
    return physical_devices(*instance).and_then([](auto& devices) { return describe_all(devices); });
}

Result<std::unique_ptr<Device>> Device::open(const DeviceChoice& choice) {
    auto instance = Instance::create(choice.validation ? Validation::on : Validation::off);
    if (!instance) return instance.error();
    auto devices = physical_devices(*instance);
    if (!devices) return devices.error();
    try {
        auto described = describe_all(*devices);
        if (const auto left_out = leave_out(described, choice.without); !left_out) return left_out.error();
        auto chosen = strata::choose(described, choice.gpu);
        if (!chosen) return chosen.error();
        if (chosen->software) keep_freed_memory();
        auto physical = std::move((*devices)[chosen->index]);
        return std::unique_ptr<Device>(
            std::make_unique<OpenedDevice>(*std::move(instance), std::move(physical), *chosen, choice.memory_budget));
    } catch (const vk::OutOfDeviceMemoryError& problem) {
        return fail(Fault::device_lacks, "device.out_of_memory", "the device has too little memory to be opened: {reason}",
                    problem.what());
    } catch (const vk::OutOfHostMemoryError& problem) {
        return fail(Fault::device_lacks, "device.out_of_host_memory",
                    "this machine has too little memory to open the device: {reason}", problem.what());
    } catch (const vk::SystemError& problem) {
        return fail(Fault::device_failed, "device.cannot_open", "the device cannot be opened: {reason}", problem.what());
    }
}

OpenedDevice::OpenedDevice(Instance instance, vk::raii::PhysicalDevice physical, DeviceInfo info, std::uint64_t memory_budget)
    : instance_(std::move(instance)),
      info_(std::move(info)),
      physical_(std::move(physical)),
      timestamp_period_ns_(double{physical_.getProperties().limits.timestampPeriod}),
      timestamp_mask_(strata::timestamp_mask(physical_)),
      counts_invocations_(strata::counts_invocations(physical_)),
      device_(make_device(physical_, info_.capabilities)),
      queue_(device_, *queue_family(physical_), 0),
      commands_(device_, vk::CommandPoolCreateInfo(vk::CommandPoolCreateFlagBits::eTransient, *queue_family(physical_))),
      memory_(physical_, device_, memory_budget),
      pipelines_(*this) {}

OpenedDevice::~OpenedDevice() = default;

void keep_pipelines(Device& device, std::size_t at_most) { static_cast<OpenedDevice&>(device).pipelines().keep_at_most(at_most); }

void OpenedDevice::set_label(vk::ObjectType type, std::uint64_t handle, std::string_view name) const {
    if (!instance_.has_labels()) return;
    const std::string text(name);
    device_.setDebugUtilsObjectNameEXT({type, handle, text.c_str()});
}

vk::raii::CommandBuffer OpenedDevice::begin_commands() const {
    auto made = device_.allocateCommandBuffers({*commands_, vk::CommandBufferLevel::ePrimary, 1});
    made.front().begin({vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    return std::move(made.front());
}

void OpenedDevice::submit(vk::raii::CommandBuffer& commands) const {
    // Longer than any frame on a CPU driver; an endless shader loop is stopped by nobody else there.
    constexpr std::uint64_t patience_ns = std::uint64_t(std::chrono::nanoseconds(std::chrono::minutes(30)).count());
    const vk::raii::Fence fence(device_, vk::FenceCreateInfo());
    const vk::CommandBufferSubmitInfo buffer(*commands);
    queue_.submit2(vk::SubmitInfo2().setCommandBufferInfos(buffer), *fence);
    if (device_.waitForFences(*fence, VK_TRUE, patience_ns) == vk::Result::eTimeout) {
        throw vk::DeviceLostError("the device did not finish within 30 minutes");
    }
}

void OpenedDevice::run_once(const std::function<void(const vk::raii::CommandBuffer&)>& record) const {
    auto commands = begin_commands();
    record(commands);
    commands.end();
    submit(commands);
}

}  // namespace strata
