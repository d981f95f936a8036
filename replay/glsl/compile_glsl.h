// Shaders compiled at run time by glslangValidator, called as the build calls it. A process of its own for each: the compiler's
// start, parsing GLSL's own declarations, is most of the 150 ms that a shader takes, so only what changed should be asked for.
#pragma once

#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "replay/glsl/glsl_sources.h"

namespace strata {

/// SPIR-V of shaders, by their names in a ShaderLibrary, in that order; on all cores. Fails without the program, and with the
/// compiler's words, "FILE:LINE: what", one to a line, when a shader is not right.
Result<std::vector<std::vector<std::uint32_t>>> compile_glsl(const GlslSources&, std::span<const std::string> shaders,
                                                             const std::stop_token&);

}  // namespace strata
