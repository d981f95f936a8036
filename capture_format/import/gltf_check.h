// What a glTF says that cannot be: references that lead nowhere, numbers that glTF does not define, versions that are not ours.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "capture_format/import/gltf_document.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// glTF 2.0, 3.2: a file of any version 2.x is read, unless it says that its reader must know more than 2.0.
Result<void> check_version(const std::string& version, const std::string& least_version);

/// A reference to an element that does not exist.
Error no_such(std::string_view list, std::int64_t index, std::size_t count);
Error not_finite();
/// `alternative` is what else would do: " or normalized".
Error not_floats(std::uint64_t component_type, std::string_view alternative);

/// References of nodes, primitives, materials, textures and animations lead somewhere; primitive modes and sampler modes are
/// glTF's own. Accessors and buffer views are checked by who reads them.
Result<void> check_references(const Document&);

}  // namespace strata::gltf
