// How much memory what a file asks for may take. A few bytes can claim gigabytes (pictures of one color, a blob of zeros,
// accessors without buffers), so every reader asks here before it allocates by a number from a file.
#pragma once

#include <cstdint>
#include <string_view>

#include "capture_format/result.h"

namespace strata {

/// Half of the memory of this machine, or of the control group (v2) that the process runs in where that is less.
std::uint64_t default_memory_budget();

class MemoryBudget {
public:
    /// 0: the default.
    explicit MemoryBudget(std::uint64_t bytes = 0) : total_(bytes == 0 ? default_memory_budget() : bytes), left_(total_) {}

    /// Takes count * size bytes. Fails (device lacks), with the bytes that `what` needs and what is left, when they are more than
    /// that.
    Result<void> take(std::uint64_t count, std::uint64_t size, std::string_view what);
    /// Fails like take(), and takes nothing: for what is freed before anything else is allocated.
    Result<void> has_room(std::uint64_t count, std::uint64_t size, std::string_view what) const;
    /// Returns bytes that were taken.
    void give_back(std::uint64_t bytes);
    std::uint64_t left() const { return left_; }

private:
    std::uint64_t total_, left_;
};

}  // namespace strata
