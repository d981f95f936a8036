// Shaders written in the test that uses them.
#pragma once

#include <string>
#include <string_view>

#include "passes/graph/shader.h"

namespace strata {

/// Compiles the source with glslangValidator and reflects it; the name ends in .comp, .vert, .geom or .frag. The version line,
/// scalar layout, subgroups and includes from include_folder are provided. Throws with the compiler's words.
Shader glsl(const std::string& name, std::string_view source, const std::string& include_folder = ".");

}  // namespace strata
