// What a device may have beyond the baseline (replay/gpu/feature_table.h). A technique that cannot do without says so in
// Technique::needs; one that knows another way asks FrameImages::capabilities.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace strata {

enum class Capability : std::uint32_t {
    buffer_int64_atomics,  ///< and 64-bit integers in shaders
    fragment_interlock,
    shader_output_layer,  ///< vertex shaders may write gl_Layer; else geometry shaders alone
    long_loops,           ///< a shader's loops may iterate more than most_short_iterations times
    geometry_shaders,
    dual_source_blending,  ///< a fragment shader may give the blend a second color, and so a transmittance per channel
    counted_draws,         ///< the device may read how many commands of a list it draws
    sample_varyings,       ///< `sample` varyings are divided by the w of the sample, not of the pixel's center
    helper_invocations,    ///< fragment shaders may read gl_HelperInvocation
    filtered_floats,       ///< samplers filter 32-bit floats and RGBA16_UNORM; 16-bit floats every device filters
    count_
};
std::string_view name(Capability);

/// llvmpipe ends all loops of an invocation, together, after so many turns, and says nothing (passes/shaders/finished.glsl).
inline constexpr std::uint64_t most_short_iterations = 65'535;

using Capabilities = std::vector<Capability>;
bool has(const Capabilities&, Capability);

}  // namespace strata
