// GPU times of steps, and how often their shaders ran. Queries stand outside rendering scopes with a barrier on both sides:
// inside a scope llvmpipe measures its binning, and without the barriers 22.3.6 shifts the times of dispatches by one.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

#include "replay/gpu/executor.h"

namespace strata {

class OpenedDevice;

class Stopwatch {
public:
    Stopwatch(const OpenedDevice&, std::uint32_t intervals, Invocations);

    void begin(const vk::raii::CommandBuffer&);
    void end(const vk::raii::CommandBuffer&);
    /// Times a few intervals in which nothing is done; before all others.
    void time_nothing(const vk::raii::CommandBuffer&);
    /// Of every interval, once the queue is idle.
    std::vector<StepCost> costs() const;
    /// The median of the intervals in which nothing was done.
    std::optional<double> empty_ms() const;

private:
    void write_time(const vk::raii::CommandBuffer&);
    /// Of intervals with nothing in them, too.
    std::vector<double> milliseconds() const;

    double period_ns_;
    std::uint64_t mask_;
    std::uint32_t empty_ = 0, begun_ = 0, written_ = 0;
    vk::raii::QueryPool times_;
    std::optional<vk::raii::QueryPool> invocations_;  ///< where the device counts them
};

}  // namespace strata
