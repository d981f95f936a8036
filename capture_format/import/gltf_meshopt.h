// EXT_meshopt_compression: the buffer views that meshoptimizer packed, unpacked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// As the extension's object says it.
struct MeshoptLayout {
    std::uint64_t count = 0, stride = 0;  ///< elements, and bytes of each once unpacked
    std::string mode;                     ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string filter;                   ///< NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL
};

/// count * stride bytes.
Result<std::vector<std::byte>> decode_meshopt(std::span<const std::byte> packed, const MeshoptLayout&, MemoryBudget&);

}  // namespace strata::gltf
