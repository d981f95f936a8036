#include "replay/glsl/compile_glsl.h"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <thread>

#include <fmt/ranges.h>

#include "passes/graph/shader_sources.h"
#include "replay/process.h"

namespace strata {
namespace {

constexpr const char* compiler = "glslangValidator";

/// A folder of the system's for temporary files; gone with this.
class TemporaryFolder {
public:
    TemporaryFolder() {
        std::error_code none;
        std::string name = (std::filesystem::temp_directory_path(none) / "strata_shaders_XXXXXX").string();
        if (mkdtemp(name.data())) path_ = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    /// Empty when it could not be made.
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::vector<std::string> own_environment() {
    std::vector<std::string> all;
    for (char** entry = environ; entry && *entry; ++entry) all.emplace_back(*entry);
    return all;
}

/// The compiler's lines that name a place, "FILE:LINE: what"; all it said where none does. Files that are built in go by their
/// names: where they are is nobody's business.
std::vector<std::string> complaints(const std::string& said, const std::filesystem::path& built_in) {
    const std::string hidden = fmt::format("{}/", built_in.string());
    constexpr std::string_view prefix = "ERROR: ";
    std::vector<std::string> placed;
    for (std::size_t begin = 0; begin < said.size();) {
        const std::size_t end = std::min(said.find('\n', begin), said.size());
        std::string_view line = std::string_view(said).substr(begin, end - begin);
        begin = end + 1;
        if (!line.starts_with(prefix)) continue;
        line.remove_prefix(prefix.size());
        if (line.starts_with(hidden)) line.remove_prefix(hidden.size());
        while (line.ends_with(' ')) line.remove_suffix(1);
        const std::size_t colon = line.find(':');
        const bool has_line = colon != line.npos && colon + 1 < line.size() && line[colon + 1] >= '0' && line[colon + 1] <= '9';
        if (has_line) placed.emplace_back(line);
    }
    return placed.empty() ? std::vector{said} : placed;
}

/// One compilation: words, or what the compiler said.
struct Compiled {
    std::vector<std::uint32_t> code;
    std::vector<std::string> said;
};

std::vector<std::uint32_t> words_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(file), {});
    std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
    return words;
}

Result<Compiled> compile_one(const GlslSources& sources, const std::string& shader, const std::filesystem::path& others) {
    const std::string name = source_name(shader);
    const std::filesystem::path& home = sources.in_folder(name) ? sources.folder() : others;
    const std::filesystem::path spirv = others / fmt::format("{}.spv", name);
    std::error_code problem;
    std::filesystem::create_directories(spirv.parent_path(), problem);
    std::vector<std::string> arguments{compiler};
    arguments.insert(arguments.end(), glsl_options().begin(), glsl_options().end());
    if (!sources.folder().empty()) arguments.push_back(fmt::format("-I{}", sources.folder().string()));
    arguments.push_back(fmt::format("-I{}", others.string()));
    for (const std::string& word : {std::string("-o"), spirv.string(), (home / name).string()}) arguments.push_back(word);
    const auto ended = run_process({std::move(arguments), own_environment()});
    if (!ended)
        return fail(Fault::usage, "glsl.no_compiler", "{reason}; shaders are compiled with it: install glslang-tools",
                    ended.error().sentence);
    if (WIFSIGNALED(ended->status))
        return fail(Fault::bad_input, "glsl.compiler_crashed", "{compiler} crashed on {shader} ({signal})", compiler, name,
                    strsignal(WTERMSIG(ended->status)));
    if (WEXITSTATUS(ended->status) != 0) return Compiled{{}, complaints(fmt::format("{}{}", ended->out, ended->err), others)};
    return Compiled{words_of(spirv), {}};
}

/// An include that is wrong is wrong in every shader: each line once.
Error error_of(std::span<const std::string> shaders, std::span<const Compiled> all) {
    std::vector<std::string> lines, failed;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].said.empty()) continue;
        failed.push_back(shaders[i]);
        for (const std::string& line : all[i].said)
            if (std::ranges::find(lines, line) == lines.end()) lines.push_back(line);
    }
    return fail(Fault::bad_input, "glsl.not_compiled", "{messages}\nnot compiled: {shaders}",
                fmt::format("{}", fmt::join(lines, "\n")), fmt::format("{}", fmt::join(failed, ", ")));
}

}  // namespace

Result<std::vector<std::vector<std::uint32_t>>> compile_glsl(const GlslSources& sources, std::span<const std::string> shaders,
                                                             const std::stop_token& stop) {
    if (shaders.empty()) return std::vector<std::vector<std::uint32_t>>();
    const TemporaryFolder others;
    if (others.path().empty())
        return fail(Fault::usage, "glsl.no_temporary_folder", "cannot make a temporary folder to compile shaders in");
    if (const auto written = sources.write_others(others.path()); !written) return written.error();
    std::vector<std::optional<Result<Compiled>>> results(shaders.size());
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < shaders.size() && !stop.stop_requested(); i = next++)
            results[i] = compile_one(sources, shaders[i], others.path());
    };
    {
        const std::size_t workers = std::min<std::size_t>(shaders.size(), std::max(1u, std::thread::hardware_concurrency()));
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < workers; ++i) threads.emplace_back(work);
    }
    std::vector<Compiled> all;
    for (auto& result : results) {
        if (!result) return fail(Fault::stopped, "session.stopped", "stopped while shaders were compiled");
        if (!*result) return result->error();
        all.push_back(**std::move(result));
    }
    if (std::ranges::any_of(all, [](const Compiled& one) { return !one.said.empty(); })) return error_of(shaders, all);
    std::vector<std::vector<std::uint32_t>> codes;
    for (Compiled& one : all) codes.push_back(std::move(one.code));
    return codes;
}

}  // namespace strata
