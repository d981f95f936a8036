#include "replay/glsl/glsl_sources.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <vector>

#include "passes/graph/shader_sources.h"

namespace strata {
namespace {

constexpr std::string_view kinds[] = {".comp", ".vert", ".geom", ".frag", ".glsl", ".shared.h", "shader_interop.h"};
// No source of ours is a hundredth of that; what is larger is no source.
constexpr std::uintmax_t largest_source = 4 << 20;

bool is_source(std::string_view name) {
    return std::ranges::any_of(kinds, [&](std::string_view kind) { return name.ends_with(kind); });
}

/// C++ reads it as well.
bool is_shared(std::string_view name) { return name.ends_with(".h"); }

/// What the text includes, comments or not: naming too much makes a shader be compiled once too often.
std::vector<std::string_view> included(std::string_view text) {
    constexpr std::string_view directive = "#include \"";
    std::vector<std::string_view> names;
    for (std::size_t at = text.find(directive); at != text.npos; at = text.find(directive, at)) {
        at += directive.size();
        names.push_back(text.substr(at, text.find('"', at) - at));
    }
    return names;
}

}  // namespace

std::string source_name(std::string_view shader) { return fmt::format("passes/{}", shader); }

GlslSources GlslSources::built_in() {
    GlslSources sources;
    for (const ShaderSource& source : shader_sources()) sources.files_[std::string(source.name)] = {std::string(source.text)};
    return sources;
}

Result<GlslSources> GlslSources::of(const std::filesystem::path& folder) {
    GlslSources sources = built_in();
    sources.folder_ = folder;
    if (const auto read = sources.read_folder(); !read) return read.error();
    return sources;
}

Result<void> GlslSources::read_folder() {
    const std::filesystem::path root = folder_ / "passes";
    std::error_code problem;
    bool any = false;
    std::filesystem::recursive_directory_iterator entry(root, problem);
    for (; !problem && entry != end(entry); entry.increment(problem)) {
        const std::string name = source_name(entry->path().lexically_relative(root).generic_string());
        if (!is_source(name)) continue;
        if (const auto read = read_file(entry->path(), name); !read) return read;
        any = true;
    }
    if (problem)
        return fail(Fault::usage, "glsl.cannot_read_folder", "cannot read the shaders of {folder}: {reason}", root.string(),
                    problem.message());
    if (!any)
        return fail(Fault::usage, "glsl.no_shaders", "{folder} holds no shaders; they are looked for below its passes/",
                    folder_.string());
    return {};
}

Result<void> GlslSources::read_file(const std::filesystem::path& path, const std::string& name) {
    std::error_code problem;
    if (std::filesystem::file_size(path, problem) > largest_source || problem)
        return fail(Fault::bad_input, "glsl.not_a_shader", "{file} is not a shader, or too large for one", path.string());
    std::ifstream file(path, std::ios::binary);
    File read{{std::istreambuf_iterator<char>(file), {}}, true};
    if (!file) return fail(Fault::bad_input, "file.cannot_read", "cannot read {file}", path.string());
    const auto known = files_.find(name);
    if (is_shared(name) && known != files_.end() && known->second.text != read.text)
        return fail(Fault::usage, "glsl.shared_header_differs",
                    "{file} differs from what the program was built with and is also compiled as C++: build the program again",
                    path.string());
    files_[name] = std::move(read);
    return {};
}

std::uint64_t GlslSources::hash_of(std::string_view shader) const {
    std::string all;
    std::set<std::string, std::less<>> seen;
    std::vector<std::string> next{source_name(shader)};
    while (!next.empty()) {
        const std::string name = std::move(next.back());
        next.pop_back();
        const auto file = files_.find(name);
        if (!seen.insert(name).second || file == files_.end()) continue;
        all += fmt::format("{} {}\n{}", name, file->second.text.size(), file->second.text);
        for (const std::string_view other : included(file->second.text)) next.emplace_back(other);
    }
    return std::hash<std::string>()(all);
}

bool GlslSources::in_folder(std::string_view name) const {
    const auto file = files_.find(name);
    return file != files_.end() && file->second.in_folder;
}

Result<void> GlslSources::write_others(const std::filesystem::path& to) const {
    for (const auto& [name, file] : files_) {
        if (file.in_folder) continue;
        const std::filesystem::path path = to / name;
        std::error_code problem;
        std::filesystem::create_directories(path.parent_path(), problem);
        std::ofstream out(path, std::ios::binary);
        out.write(file.text.data(), static_cast<std::streamsize>(file.text.size()));
        out.close();
        if (!out) return fail(Fault::usage, "file.cannot_write", "cannot write {file}", path.string());
    }
    return {};
}

}  // namespace strata
