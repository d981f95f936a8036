#include "capture_format/memory_budget.h"

#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <fstream>
#include <limits>
#include <string>

namespace strata {
namespace {

std::string readable(double bytes) {
    constexpr double mebibyte = 1 << 20;
    return bytes < mebibyte / 20 ? fmt::format("{:.0f} bytes", bytes) : fmt::format("{:.1f} MiB", bytes / mebibyte);
}

/// The limit of the control group; the largest number where there is none ("max") or no such file.
std::uint64_t group_limit() {
    std::ifstream file("/sys/fs/cgroup/memory.max");
    std::uint64_t bytes = 0;
    return file >> bytes ? bytes : std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::uint64_t default_memory_budget() {
    static const std::uint64_t half = [] {
        const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
        const bool known = pages > 0 && page > 0;
        const auto physical =
            known ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page) : std::uint64_t{4} << 30;
        return std::min(physical, group_limit()) / 2;
    }();
    return half;
}

Result<void> MemoryBudget::has_room(std::uint64_t count, std::uint64_t size, std::string_view what) const {
    if (size == 0 || count <= left_ / size) return {};
    const double bytes = static_cast<double>(count) * static_cast<double>(size);
    return fail(Fault::device_lacks, "memory.budget",
                "{what} would take {size} ({count} x {each_bytes} bytes); the memory budget is {budget}, of which {left} are "
                "left: allow more with --memory-budget",
                what, readable(bytes), count, size, readable(static_cast<double>(total_)), readable(static_cast<double>(left_)));
}

Result<void> MemoryBudget::take(std::uint64_t count, std::uint64_t size, std::string_view what) {
    if (const auto room = has_room(count, size, what); !room) return room;
    left_ -= count * size;
    return {};
}

void MemoryBudget::give_back(std::uint64_t bytes) {
    assert(bytes <= total_ - left_);
    left_ += bytes;
}

}  // namespace strata
