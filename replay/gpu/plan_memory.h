// The images and buffers of a plan on the device: its own memory slot by slot, and what was imported from outside.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "passes/graph/plan.h"
#include "replay/gpu/imports.h"

namespace strata {

class PlanMemory {
public:
    PlanMemory(OpenedDevice&, const Plan&);

    std::uint64_t bytes_held() const;
    /// Whether the plan needs exactly this memory.
    bool serves(const Plan& plan) const { return key_of(plan) == key_; }

private:
    friend class PlanResources;
    static std::vector<std::uint64_t> key_of(const Plan&);

    std::vector<std::uint64_t> key_;
    std::map<std::uint32_t, DeviceImage> slots_;     // by slot
    std::map<std::uint32_t, DeviceBuffer> buffers_;  // by id
};

/// Handles of a plan to what they mean on the device during one run. Throws std::out_of_range for an import nobody made.
class PlanResources {
public:
    PlanResources(const Plan& plan, PlanMemory& memory, Imports& imports) : plan_(&plan), memory_(&memory), imports_(&imports) {}

    DeviceImage& image(Image) const;
    DeviceBuffer& buffer(Buffer) const;
    /// Whether the image is in its memory: a step made it, and no later image of the slot took it over.
    bool holds(Image) const;
    /// The image is used from here on.
    void take_over(Image);

private:
    const Plan* plan_;
    PlanMemory* memory_;
    Imports* imports_;
    std::map<std::uint32_t, std::uint32_t> owners_;  // slot to image id
};

}  // namespace strata
