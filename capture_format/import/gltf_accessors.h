// glTF accessors as plain vectors: every component type, normalized or not, strided, sparse, or with no buffer at all. Nothing
// an accessor claims is believed: it is held against its buffer view with arithmetic that cannot overflow.
#pragma once

#include <cstdint>
#include <vector>

#include "capture_format/import/gltf_document.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// Element after element, `components` floats each (16 for a matrix); integer types are normalized when the accessor says so.
/// Fails when the accessor is missing, has another number of components, leaves its buffer view, or exceeds the budget.
Result<std::vector<float>> read_floats(const Document&, int accessor, std::uint32_t components, MemoryBudget&);

/// Scalars of any unsigned type, none of them the largest of its type: glTF 2.0, 3.7.2.1, has no primitive restart.
Result<std::vector<std::uint32_t>> read_indices(const Document&, int accessor, MemoryBudget&);

/// The number of components of an accessor's elements; 0 when there is no such accessor.
std::uint32_t component_count(const Document&, int accessor);

}  // namespace strata::gltf
