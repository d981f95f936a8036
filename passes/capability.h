// What a device may have beyond the baseline (replay/gpu/feature_table.h). A technique that cannot do without says so in
// Technique::needs; one that knows another way asks FrameImages::capabilities.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace strata {

enum class Capability : std::uint32_t {
    buffer_int64_atomics,
    fragment_interlock,
    shader_output_layer,  ///< vertex shaders may write gl_Layer; else geometry shaders alone
    count_
};
std::string_view name(Capability);

using Capabilities = std::vector<Capability>;
bool has(const Capabilities&, Capability);

}  // namespace strata
