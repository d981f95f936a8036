#include "tests/support/shader_folder.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <fmt/core.h>

#include "passes/graph/shader_sources.h"

namespace strata {
namespace {

std::string built_in_text(std::string_view name) {
    const auto found = std::ranges::find(shader_sources(), name, &ShaderSource::name);
    if (found == shader_sources().end()) throw std::runtime_error(fmt::format("no source {}", name));
    return std::string(found->text);
}

}  // namespace

ShaderFolder::ShaderFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("strata_shader_folder_{}", getpid())) {
    std::filesystem::remove_all(path_);
}

ShaderFolder::~ShaderFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string ShaderFolder::text(std::string_view name) const {
    std::ifstream file(path_ / name, std::ios::binary);
    if (!file) return built_in_text(name);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::filesystem::path ShaderFolder::write(std::string_view name, std::string_view text) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

std::filesystem::path ShaderFolder::change(std::string_view name, std::string_view from, std::string_view to) const {
    std::string changed = text(name);
    std::size_t times = 0;
    for (std::size_t at = changed.find(from); at != changed.npos; at = changed.find(from, at + to.size()), ++times)
        changed.replace(at, from.size(), to);
    if (times == 0) throw std::runtime_error(fmt::format("{} has no '{}'", name, from));
    return write(name, changed);
}

void ShaderFolder::restore(std::string_view name) const { write(name, built_in_text(name)); }

std::size_t line_of(std::string_view text, std::string_view part) {
    const std::string_view before = text.substr(0, text.find(part));
    return 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
}

}  // namespace strata
