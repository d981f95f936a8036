// The Vulkan instance, with the validation layer where asked. Messages of the layer are collected, not printed: whoever runs
// something takes them afterwards and knows whose they are.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "capture_format/result.h"

namespace strata {

enum class Validation { off, on };

/// Errors the validation layer reported. The layer calls back from whichever thread it likes.
struct ValidationLog {
    std::mutex mutex;
    std::vector<std::string> messages;
};

class Instance {
public:
    /// Fails when there is no Vulkan loader, or when validation is asked for and not installed. What shows its pictures in a
    /// window names the extensions its surface needs.
    static Result<Instance> create(Validation, std::span<const char* const> extensions = {});

    const vk::raii::Instance& handle() const { return instance_; }
    /// Whether command buffers and objects can be given names.
    bool has_labels() const { return has_labels_; }
    /// Validation errors since the last call.
    std::vector<std::string> take_messages();
    bool has_messages() const;

private:
    Instance(vk::raii::Context, Validation, std::span<const char* const> extensions);

    std::unique_ptr<ValidationLog> log_;  // its address is with the layer
    vk::raii::Context context_;
    bool has_labels_;
    vk::raii::Instance instance_;
    std::optional<vk::raii::DebugUtilsMessengerEXT> messenger_;
};

}  // namespace strata
