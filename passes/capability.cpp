#include "passes/capability.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace strata {

std::string_view name(Capability capability) {
    constexpr std::string_view names[] = {
        "buffer_int64_atomics", "fragment_interlock", "shader_output_layer", "long_loops",         "geometry_shaders",
        "dual_source_blending", "counted_draws",      "sample_varyings",     "helper_invocations", "filtered_floats"};
    static_assert(std::size(names) == static_cast<std::size_t>(Capability::count_));
    return names[static_cast<std::size_t>(capability)];
}

bool has(const Capabilities& capabilities, Capability wanted) {
    return std::ranges::find(capabilities, wanted) != capabilities.end();
}

}  // namespace strata
