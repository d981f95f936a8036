#include "replay/measure/host_memory.h"

#include <malloc.h>

#include <fstream>
#include <string>

namespace strata {

std::uint64_t host_peak_bytes() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (std::uint64_t kib = 0; word == "VmHWM:" && status >> kib) return kib << 10;
    return 0;
}

void release_freed_memory() { malloc_trim(0); }

}  // namespace strata
