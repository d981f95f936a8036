// What the process itself holds.
#pragma once

#include <cstdint>

namespace strata {

/// The most memory the process ever had resident, in bytes (VmHWM); 0 where the system does not say. On a CPU driver the
/// device's memory is part of it.
std::uint64_t host_peak_bytes();

}  // namespace strata
