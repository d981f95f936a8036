// GPU times of steps. They stand outside rendering scopes with a barrier on both sides: inside a scope llvmpipe measures its
// binning, and without the barriers 22.3.6 shifts the times of dispatches by one (platform.md 2.4).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vulkan/vulkan_raii.hpp>

namespace strata {

class OpenedDevice;

class Stopwatch {
public:
    Stopwatch(const OpenedDevice&, std::uint32_t intervals);

    void begin(const vk::raii::CommandBuffer&);
    void end(const vk::raii::CommandBuffer&);
    /// Milliseconds of every interval, once the queue is idle.
    std::vector<double> milliseconds() const;

private:
    void write(const vk::raii::CommandBuffer&);

    double period_ns_;
    std::uint32_t capacity_, written_ = 0;
    vk::raii::QueryPool pool_;
};

}  // namespace strata
