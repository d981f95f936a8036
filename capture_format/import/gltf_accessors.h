// glTF accessors as plain vectors. tinygltf does not check that an accessor stays inside its buffer view; this does, with
// arithmetic that cannot overflow.
#pragma once

#include <cstdint>
#include <vector>

#include <tiny_gltf.h>

#include "capture_format/result.h"

namespace strata::gltf {

/// Element after element, `components` floats each; integer types are normalized when the accessor says so; sparse
/// replacements are applied. Fails when the accessor is missing, has another number of components or leaves its buffer.
Result<std::vector<float>> read_floats(const tinygltf::Model&, int accessor, std::uint32_t components);

/// Vertex indices of any unsigned type.
Result<std::vector<std::uint32_t>> read_indices(const tinygltf::Model&, int accessor);

/// The number of components of an accessor's elements; 0 when there is no such accessor.
std::uint32_t component_count(const tinygltf::Model&, int accessor);

/// The bytes of a buffer view (an image, say).
Result<std::vector<unsigned char>> read_view(const tinygltf::Model&, int buffer_view);

}  // namespace strata::gltf
