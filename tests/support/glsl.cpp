#include "tests/support/glsl.h"

#include <unistd.h>

#include <cstdlib>
#include <deque>
#include <filesystem>
#include <fstream>
#include <vector>

#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view preamble = R"(#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_KHR_shader_subgroup_arithmetic : require
)";

}  // namespace

Shader glsl(const std::string& name, std::string_view source, const std::string& include_folder) {
    static std::deque<std::vector<std::uint32_t>> codes;  // shaders point into them
    const std::string extension = name.substr(name.find_last_of('.'));
    const auto base = std::filesystem::temp_directory_path() / fmt::format("strata_test_{}_{}", getpid(), codes.size());
    const std::string glsl = base.string() + extension, spirv = base.string() + ".spv", log = base.string() + ".log";
    std::ofstream(glsl) << preamble << source;
    const std::string command =
        fmt::format("glslangValidator --quiet --target-env vulkan1.3 '-I{}' -I" STRATA_SOURCE_DIR " -o {} {} > {}",
                    include_folder, spirv, glsl, log);
    const bool compiled = std::system(command.c_str()) == 0;
    const std::string said = file_text(log), bytes = file_text(spirv);
    for (const std::string& file : {glsl, spirv, log}) std::filesystem::remove(file);
    if (!compiled) throw std::runtime_error(name + ": " + said);
    auto& code = codes.emplace_back(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(code.data(), bytes.data(), bytes.size());
    return must(reflect(name, code));
}

}  // namespace strata
