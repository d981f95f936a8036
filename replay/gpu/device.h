// A Vulkan device chosen by index or name, with what it can do. The baseline is Vulkan 1.3 plus the feature table in
// device.cpp; a device that lacks a row is refused with a sentence naming it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture_format/result.h"
#include "passes/capability.h"

namespace strata {

struct DeviceInfo {
    std::uint32_t index = 0;
    std::string name, driver;
    std::string driver_version;  ///< as the driver states it, or the build of its library
    std::string cpu;
    std::string kind;                    ///< "discrete", "integrated", "cpu", ...
    bool software = false;               ///< times are the CPU's and no model of a GPU
    std::uint32_t vector_width = 0;      ///< lanes of a subgroup: on a CPU driver the width of its vectors in 32-bit numbers
    std::uint64_t max_buffer_bytes = 0;  ///< of one storage buffer binding
    std::uint32_t max_image_extent = 0;
    std::uint32_t snap_steps = 256;  ///< per pixel, that it snaps corners of triangles to
    Capabilities capabilities;
    std::string lacks;  ///< empty when the device can replay, else the first missing feature of the baseline
};

struct DeviceChoice {
    /// Index, part of the name of a device or of its driver and its version, or empty: the first that can replay, real GPUs
    /// before CPUs.
    std::string gpu;
    bool validation = false;          ///< core, synchronization and queue-submit validation; messages become errors
    std::uint64_t memory_budget = 0;  ///< most bytes to take from the device; 0: as much as it gives
    /// Capabilities and features of the baseline that every device is taken to lack, to see what becomes of a frame without them.
    std::vector<std::string> without;
};

/// Every device of the machine, usable or not.
Result<std::vector<DeviceInfo>> list_devices();

/// An opened device with its queue, allocator and pipeline store. Not copyable; moved by pointer.
class Device {
public:
    static Result<std::unique_ptr<Device>> open(const DeviceChoice&);
    virtual ~Device() = default;
    virtual const DeviceInfo& info() const = 0;
    /// Validation messages since the last call, errors only.
    virtual std::vector<std::string> take_messages() = 0;
};

}  // namespace strata
