#include "replay/gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <new>
#include <string_view>

namespace strata {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

constexpr std::array validation_checks = {vk::ValidationFeatureEnableEXT::eSynchronizationValidation};

// Hazards across submits have no value of the enumeration in 1.3.239: the layer reads this variable.
constexpr const char* layer_enables = "VK_LAYER_ENABLES";
constexpr const char* across_submits = "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT";

bool has_layer(const vk::raii::Context& context) {
    const auto layers = context.enumerateInstanceLayerProperties();
    return std::ranges::any_of(layers, [](const auto& layer) { return std::string_view(layer.layerName) == validation_layer; });
}

bool has_debug_utils(const vk::raii::Context& context) {
    const auto extensions = context.enumerateInstanceExtensionProperties();
    return std::ranges::any_of(extensions, [](const auto& extension) {
        return std::string_view(extension.extensionName) == VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    });
}

VKAPI_ATTR VkBool32 VKAPI_CALL collect(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* message, void* log) {
    auto& collected = *static_cast<ValidationLog*>(log);
    const std::scoped_lock lock(collected.mutex);
    collected.messages.emplace_back(message->pMessage);
    return VK_FALSE;
}

// The loader sends messages of its own with type GENERAL: only the layer's are wanted.
vk::DebugUtilsMessengerCreateInfoEXT messenger_info(ValidationLog& log) {
    return {
        {}, vk::DebugUtilsMessageSeverityFlagBitsEXT::eError, vk::DebugUtilsMessageTypeFlagBitsEXT::eValidation, &collect, &log};
}

vk::raii::Instance make_instance(const vk::raii::Context& context, std::vector<const char*> extensions, ValidationLog* log) {
    const vk::ApplicationInfo application("strata", 1, "strata", 1, VK_API_VERSION_1_3);
    std::vector<const char*> layers;
    if (!log) return {context, vk::InstanceCreateInfo({}, &application, layers, extensions)};

    setenv(layer_enables, across_submits, /*overwrite=*/0);
    layers.push_back(validation_layer);
    extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
    const vk::ValidationFeaturesEXT features(validation_checks);
    auto messenger = messenger_info(*log);
    messenger.pNext = &features;
    return {context, vk::InstanceCreateInfo({}, &application, layers, extensions, &messenger)};
}

std::vector<const char*> with_labels(std::span<const char* const> extensions, bool has_labels) {
    std::vector<const char*> all(extensions.begin(), extensions.end());
    if (has_labels) all.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    return all;
}

}  // namespace

Instance::Instance(vk::raii::Context context, Validation validation, std::span<const char* const> extensions)
    : log_(std::make_unique<ValidationLog>()),
      context_(std::move(context)),
      has_labels_(has_debug_utils(context_) || validation == Validation::on),
      instance_(
          make_instance(context_, with_labels(extensions, has_labels_), validation == Validation::on ? log_.get() : nullptr)) {
    if (validation == Validation::on) messenger_.emplace(instance_, messenger_info(*log_));
}

Result<Instance> Instance::create(Validation validation, std::span<const char* const> extensions) {
    try {
        vk::raii::Context context;
        if (validation == Validation::on && !has_layer(context)) {
            return fail(Fault::device_lacks, "device.no_validation_layer",
                        "validation needs the layer {layer}: install vulkan-validationlayers", validation_layer);
        }
        return Instance(std::move(context), validation, extensions);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& problem) {  // no loader is a runtime_error, no driver a vk::SystemError
        return fail(Fault::device_lacks, "device.no_vulkan",
                    "no Vulkan on this machine ({reason}): install a driver, mesa-vulkan-drivers at least", problem.what());
    }
}

std::vector<std::string> Instance::take_messages() {
    const std::scoped_lock lock(log_->mutex);
    return std::exchange(log_->messages, {});
}

bool Instance::has_messages() const {
    const std::scoped_lock lock(log_->mutex);
    return !log_->messages.empty();
}

}  // namespace strata
