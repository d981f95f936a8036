#include "replay/isa/compile_elsewhere.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstring>
#include <system_error>

#include "replay/process.h"

namespace strata {
namespace {

constexpr const char* forced_family = "RADV_FORCE_FAMILY";
// The loader reads the second of these from 1.3.207 on, older ones the first; a later loader ignores the first when both stand.
constexpr const char* driver_lists[] = {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"};

/// Null where it is not set.
const char* variable(const char* const* environment, std::string_view name) {
    for (; environment && *environment; ++environment) {
        const std::string_view entry(*environment);
        if (entry.starts_with(name) && entry.substr(name.size()).starts_with('=')) return *environment + name.size() + 1;
    }
    return nullptr;
}

std::vector<std::string> parts(std::string_view list) {
    std::vector<std::string> found;
    while (!list.empty()) {
        const std::size_t colon = std::min(list.find(':'), list.size());
        if (colon > 0) found.emplace_back(list.substr(0, colon));
        list.remove_prefix(std::min(colon + 1, list.size()));
    }
    return found;
}

bool is_radv(const std::filesystem::path& path) {
    return path.filename().string().starts_with("radeon_icd") && path.extension() == ".json";
}

std::string last_line(std::string text) {
    while (text.ends_with('\n')) text.pop_back();
    return text.substr(text.find_last_of('\n') + 1);
}

/// The same environment with the driver and the GPU it is to compile for.
std::vector<std::string> environment_for(const CompileJob& job, const std::string& drivers, std::string_view family) {
    std::vector<std::string> made;
    const auto is_ours = [](std::string_view entry) {
        const std::string_view name = entry.substr(0, entry.find('='));
        return name == forced_family || std::ranges::find(driver_lists, name) != std::end(driver_lists);
    };
    for (const char* const* entry = job.environment; entry && *entry; ++entry)
        if (!job.model || !is_ours(*entry)) made.emplace_back(*entry);
    if (!job.model) return made;
    made.push_back(fmt::format("{}={}", forced_family, family));
    for (const char* list : driver_lists) made.push_back(fmt::format("{}={}", list, drivers));
    return made;
}

Result<EndedProcess> run(const CompileJob& job, std::vector<std::string> environment, const std::string& input) {
    std::vector<std::string> arguments{job.program.string(), compile_verb, "--device", std::to_string(job.device)};
    if (job.texts == CompilerTexts::kept) arguments.emplace_back("--texts");
    return run_process({std::move(arguments), std::move(environment), input});
}

Result<Compilation> compilation_of(const EndedProcess& ended, std::string_view target) {
    if (WIFSIGNALED(ended.status))
        return fail(Fault::device_failed, "isa.compiler_crashed", "the compiler for {target} crashed ({signal}): {reason}",
                    target, strsignal(WTERMSIG(ended.status)), ended.err.empty() ? "it said nothing" : last_line(ended.err));
    const int code = WEXITSTATUS(ended.status);
    if (code == 0) return compilation_from_json(ended.out);
    constexpr std::string_view prefix = "strata: ";
    std::string sentence = last_line(ended.err);
    if (sentence.starts_with(prefix)) sentence.erase(0, prefix.size());
    const bool is_fault = code <= static_cast<int>(Fault::not_repeatable);
    return fail(is_fault ? static_cast<Fault>(code) : Fault::device_failed, "isa.compiler_failed",
                "compiling for {target}: {reason}", target, sentence);
}

}  // namespace

Result<std::string> find_radv(const char* const* environment) {
    std::string found;
    const auto add = [&](const std::filesystem::path& path) { found.append(found.empty() ? "" : ":").append(path.string()); };
    for (const char* list : driver_lists)
        if (const char* files = variable(environment, list))
            for (const std::string& file : parts(files))
                if (is_radv(file) && found.find(file) == std::string::npos) add(file);
    if (!found.empty()) return found;

    const auto or_default = [&](const char* name, const char* fallback) {
        const char* value = variable(environment, name);
        return parts(value && *value ? value : fallback);
    };
    std::vector<std::string> folders = or_default("XDG_CONFIG_DIRS", "/etc/xdg");
    folders.insert(folders.end(), {"/usr/local/etc", "/etc"});
    const std::vector<std::string> data = or_default("XDG_DATA_DIRS", "/usr/local/share:/usr/share");
    folders.insert(folders.end(), data.begin(), data.end());
    for (const std::string& folder : folders) {
        std::error_code problem;
        for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(folder) / "vulkan/icd.d", problem))
            if (is_radv(entry.path())) add(entry.path());
    }
    if (found.empty())
        return fail(Fault::device_lacks, "isa.no_radv",
                    "compiling for a GPU that is not there needs Mesa's RADV (radeon_icd.*.json): install mesa-vulkan-drivers");
    return found;
}

Result<Compilation> compile_elsewhere(const std::vector<PipelineRequest>& requests, const CompileJob& job) {
    std::string drivers;
    if (job.model) {
        if (const auto known = find_compiled_gpu_model(job.model->name); !known) return known.error();
        auto radv = find_radv(job.environment);
        if (!radv) return radv.error();
        drivers = *std::move(radv);
    }
    const std::string input = as_json(requests);
    const auto attempt = [&](std::string_view family) {
        const auto ended = run(job, environment_for(job, drivers, family), input);
        return ended ? compilation_of(*ended, job.model ? family : "the device") : Result<Compilation>(ended.error());
    };
    auto made = attempt(job.model ? job.model->family : "");
    // "radv: Unknown family": later versions of Mesa abort for the names that they have changed.
    const bool is_renamed = !made && job.model && !job.model->later_family.empty() &&
                            made.error().sentence.find("nknown family") != std::string::npos;
    return is_renamed ? attempt(job.model->later_family) : made;
}

}  // namespace strata
