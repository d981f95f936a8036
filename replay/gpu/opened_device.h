// What stands behind Device: the handles everything in this folder works with. The one queue, its command pool and the pipelines
// live as long as the device.
#pragma once

#include <functional>

#include "replay/gpu/device.h"
#include "replay/gpu/instance.h"
#include "replay/gpu/memory.h"
#include "replay/gpu/pipelines.h"

namespace strata {

class OpenedDevice final : public Device {
public:
    OpenedDevice(Instance, vk::raii::PhysicalDevice, DeviceInfo, std::uint64_t memory_budget);
    ~OpenedDevice() override;

    const DeviceInfo& info() const override { return info_; }
    std::vector<std::string> take_messages() override { return instance_.take_messages(); }

    const Instance& instance() const { return instance_; }
    const vk::raii::Device& handle() const { return device_; }
    MemoryPool& memory() { return memory_; }
    PipelineStore& pipelines() { return pipelines_; }
    double timestamp_period_ns() const { return timestamp_period_ns_; }
    /// Bits of a timestamp that count, from the lowest on; the others are anything.
    std::uint64_t timestamp_mask() const { return timestamp_mask_; }
    bool counts_invocations() const { return counts_invocations_; }

    /// Gives the object a name in validation messages and debuggers.
    template <typename Handle>
    void label(Handle handle, std::string_view name) const {
        set_label(Handle::objectType, reinterpret_cast<std::uint64_t>(static_cast<typename Handle::CType>(handle)), name);
    }

    vk::raii::CommandBuffer begin_commands() const;
    /// Submits and waits. Throws vk::SystemError.
    void submit(vk::raii::CommandBuffer&) const;
    /// Records, submits and waits.
    void run_once(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

private:
    void set_label(vk::ObjectType, std::uint64_t handle, std::string_view name) const;

    Instance instance_;
    DeviceInfo info_;
    vk::raii::PhysicalDevice physical_;
    double timestamp_period_ns_;
    std::uint64_t timestamp_mask_;
    bool counts_invocations_;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool commands_;
    MemoryPool memory_;
    PipelineStore pipelines_;
};

}  // namespace strata
