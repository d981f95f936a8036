// The GLSL that the embedded shaders were compiled from, as the build embedded it beside them: what a changed shader differs
// from, and what it still includes.
#pragma once

#include <span>
#include <string_view>

namespace strata {

/// A shader, or a file that shaders include.
struct ShaderSource {
    std::string_view name;  ///< as #include names it: "passes/shaders/scene.glsl"; a shader's name stands behind "passes/"
    std::string_view text;
};

/// Written by the build.
std::span<const ShaderSource> shader_sources();
/// The options of glslangValidator that the build compiles with, but for folders and files.
std::span<const char* const> glsl_options();

}  // namespace strata
