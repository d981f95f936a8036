// The JSON and the binary chunk of a glTF while it is being written. Lists are named as in the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture_format/export/json.h"

namespace strata::to_gltf_parts {

class Parts {
public:
    /// Appends to one of the root's lists ("nodes"); returns the index.
    std::size_t add(const char* list, Json element);
    /// Bytes as a buffer view, aligned to four.
    std::size_t add_view(std::span<const std::byte>);
    /// Floats as an accessor of this type ("VEC3"); numbers that are not finite, which glTF forbids, become 0 and are counted.
    std::size_t add_floats(std::span<const float> values, const char* type, std::size_t components);
    std::size_t add_indices(std::span<const std::uint32_t>);
    /// Names an extension in extensionsUsed, once.
    void use(const std::string& extension);

    Json root = {{"asset", {{"version", "2.0"}, {"generator", "strata"}}}};
    std::vector<std::byte> binary;
    std::size_t not_finite = 0;
};

}  // namespace strata::to_gltf_parts
