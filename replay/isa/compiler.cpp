#include "replay/isa/compiler.h"

#include <cstring>

#include <vulkan/vulkan_raii.hpp>

#include "replay/gpu/feature_table.h"
#include "replay/gpu/instance.h"
#include "replay/gpu/pipelines.h"
#include "replay/gpu/raster_state.h"

namespace strata {
namespace {

double number(const vk::PipelineExecutableStatisticKHR& statistic) {
    switch (statistic.format) {
        case vk::PipelineExecutableStatisticFormatKHR::eBool32:
            return statistic.value.b32 ? 1 : 0;
        case vk::PipelineExecutableStatisticFormatKHR::eInt64:
            return static_cast<double>(statistic.value.i64);
        case vk::PipelineExecutableStatisticFormatKHR::eUint64:
            return static_cast<double>(statistic.value.u64);
        case vk::PipelineExecutableStatisticFormatKHR::eFloat64:
            return statistic.value.f64;
    }
    return 0;
}

std::string stages_of(vk::ShaderStageFlags stages) {
    using Bit = vk::ShaderStageFlagBits;
    constexpr std::pair<Bit, const char*> names[] = {
        {Bit::eCompute, "compute"}, {Bit::eVertex, "vertex"}, {Bit::eGeometry, "geometry"}, {Bit::eFragment, "fragment"}};
    std::string text;
    for (const auto& [bit, name] : names)
        if (stages & bit) text.append(text.empty() ? "" : " + ").append(name);
    return text;
}

/// Asked twice: for the sizes, then for the texts. The wrapper of 1.3.239 asks once.
std::vector<CompilerText> texts_of(const vk::raii::Device& device, const vk::PipelineExecutableInfoKHR& which) {
    const auto& call = *device.getDispatcher();
    const auto info = static_cast<VkPipelineExecutableInfoKHR>(which);
    std::uint32_t count = 0;
    call.vkGetPipelineExecutableInternalRepresentationsKHR(*device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableInternalRepresentationKHR> forms(
        count, {VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INTERNAL_REPRESENTATION_KHR, nullptr, {}, {}, VK_FALSE, 0, nullptr});
    call.vkGetPipelineExecutableInternalRepresentationsKHR(*device, &info, &count, forms.data());
    std::vector<std::string> bytes(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        bytes[i].resize(forms[i].dataSize);
        forms[i].pData = bytes[i].data();
    }
    call.vkGetPipelineExecutableInternalRepresentationsKHR(*device, &info, &count, forms.data());
    std::vector<CompilerText> texts;
    for (std::uint32_t i = 0; i < count; ++i)
        if (forms[i].isText) texts.push_back({forms[i].name, bytes[i].substr(0, bytes[i].find('\0'))});
    return texts;
}

CompiledPipeline compile(const vk::raii::Device& device, const PipelineRequest& request, CompilerTexts texts) {
    const bool is_compute = std::holds_alternative<ComputeWork>(request.step.step.work);
    const RasterState state = is_compute ? RasterState{} : raster_state(request.step, request.images, /*on_llvmpipe=*/false);
    using Flag = vk::PipelineCreateFlagBits;
    vk::PipelineCreateFlags flags = Flag::eCaptureStatisticsKHR;
    if (texts == CompilerTexts::kept) flags |= Flag::eCaptureInternalRepresentationsKHR;
    const Pipeline pipeline = make_pipeline(device, request.step, state, flags);

    CompiledPipeline compiled;
    const auto programs = device.getPipelineExecutablePropertiesKHR({*pipeline.handle});
    for (std::uint32_t i = 0; i < programs.size(); ++i) {
        const vk::PipelineExecutableInfoKHR which(*pipeline.handle, i);
        Executable& made = compiled.executables.emplace_back();
        made.stage = stages_of(programs[i].stages);
        if (made.stage.empty()) made.stage = std::string(programs[i].name.data());
        made.wave_lanes = programs[i].subgroupSize;
        for (const auto& statistic : device.getPipelineExecutableStatisticsKHR(which))
            made.statistics.push_back({std::string(statistic.name.data()), number(statistic)});
        if (texts == CompilerTexts::kept) made.texts = texts_of(device, which);
    }
    return compiled;
}

Result<Compilation> compile_on(const vk::raii::PhysicalDevice& physical, std::span<const PipelineRequest> requests,
                               CompilerTexts texts) {
    const auto properties = physical.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = properties.get<vk::PhysicalDeviceDriverProperties>();
    Compilation compilation{std::string(properties.get<vk::PhysicalDeviceProperties2>().properties.deviceName.data()),
                            fmt::format("{} {}", driver.driverName.data(), driver.driverInfo.data()),
                            {}};
    if (!describes_pipelines(physical))
        return fail(Fault::device_lacks, "device.lacks_feature",
                    "{device} lacks {feature}: it does not say what it compiled; name a GPU that is not there with --gpu-model",
                    compilation.device, VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
    const auto device = make_device(physical, capabilities_of(physical), PipelineDescriptions::on);
    for (const PipelineRequest& request : requests) {
        try {
            compilation.pipelines.push_back(compile(device, request, texts));
        } catch (const vk::SystemError& problem) {
            compilation.pipelines.push_back({.failure = problem.what()});
        }
    }
    return compilation;
}

}  // namespace

Result<Compilation> compile_here(std::span<const PipelineRequest> requests, std::uint32_t device, CompilerTexts texts) {
    const auto instance = Instance::create(Validation::off);
    if (!instance) return instance.error();
    try {
        const auto devices = instance->handle().enumeratePhysicalDevices();
        if (device >= devices.size()) return fail(Fault::device_lacks, "device.unknown", "there is no device {device}", device);
        return compile_on(devices[device], requests, texts);
    } catch (const vk::SystemError& problem) {
        return fail(Fault::device_lacks, "isa.cannot_compile", "the device cannot compile: {reason}", problem.what());
    }
}

}  // namespace strata
