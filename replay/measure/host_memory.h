// What the process itself holds.
#pragma once

#include <cstdint>

namespace strata {

/// The most memory the process ever had resident, in bytes (VmHWM); 0 where the system does not say. On a CPU driver the
/// device's memory is part of it.
std::uint64_t host_peak_bytes();

/// Gives the system back what the process has freed: the C library keeps it, by thread, and a driver frees a hundred megabytes
/// with its pipelines.
void release_freed_memory();

}  // namespace strata
