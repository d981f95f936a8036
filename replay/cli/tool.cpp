#include "replay/cli/tool.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include <fmt/core.h>
#include <CLI/CLI.hpp>

#include "capture_format/container/kept_files.h"
#include "replay/gpu/device.h"
#include "replay/revision.h"

namespace strata {
namespace {

constexpr const char* exit_codes =
    "exit codes: 0 ok, 1 over tolerance, 2 usage or an output that cannot be written, 3 bad or truncated input,\n"
    "4 the device or the memory budget lacks what is needed, 5 device failure, 6 expectation missing, 7 not repeatable, 130 interrupted";

int report_error(const Error& error) {
    fmt::print(stderr, "strata: {}\n", error.sentence);
    return static_cast<int>(error.fault);
}

Result<void> list_gpus() {
    const auto devices = list_devices();
    if (!devices) return devices.error();
    for (const DeviceInfo& device : *devices)
        fmt::print("{}  {}  ({}, {} {}){}\n", device.index, device.name, device.kind, device.driver, device.driver_version,
                   device.lacks.empty() ? "" : "  cannot replay: lacks " + device.lacks);
    return {};
}

/// A file may need more memory than there is and still be within every limit: 4 GiB for a frame. What is printed may be more than
/// fits the disk it goes to.
Result<void> within_this_machine(const std::function<Result<void>()>& verb) {
    try {
        return verb();
    } catch (const std::bad_alloc&) {
        return fail(Fault::device_lacks, "this machine has not the memory that is needed");
    } catch (const std::system_error& refused) {
        return fail(Fault::usage, "{}", refused.what());
    }
}

/// The files that options of this type name.
std::vector<std::filesystem::path> files_of(const CLI::App& verb, const std::string& type) {
    std::vector<std::filesystem::path> files;
    for (const CLI::Option* option : verb.get_options())
        if (option->get_type_name() == type) files.insert(files.end(), option->results().begin(), option->results().end());
    return files;
}

/// From now on no input of the verb is replaced. Outputs whose names are known are refused before any work is done.
Result<void> keep_inputs(const CLI::App& verb) {
    keep_files(files_of(verb, input_file));
    for (const std::filesystem::path& output : files_of(verb, output_file))
        if (const auto free = check_not_kept(output); !free) return free;
    return {};
}

}  // namespace

int run_tool(std::vector<std::string> arguments, std::span<const Verb> verbs) {
    CLI::App app("Records the frames of a renderer once and replays every pass of them with any algorithm that does the job.",
                 "strata");
    app.footer(exit_codes);
    app.set_version_flag("--version", std::string("strata 0.1.0 ") + tool_revision);
    bool gpus = false;
    app.add_flag("--list-gpus", gpus, "devices of this machine and whether they can replay");
    app.require_subcommand(0, 1);

    std::string help_about;
    CLI::App* help = app.add_subcommand("help", "how a verb is used");
    help->add_option("verb", help_about, "a verb");

    std::vector<std::pair<CLI::App*, std::function<Result<void>()>>> runs;
    for (const Verb& verb : verbs) {
        CLI::App* sub = app.add_subcommand(std::string(verb.name), std::string(verb.summary));
        runs.emplace_back(sub, verb.declare(*sub));
    }
    try {
        std::ranges::reverse(arguments);  // CLI11 takes a vector from its back
        app.parse(arguments);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error, std::cout, std::cerr);
        return code == 0 ? 0 : static_cast<int>(Fault::usage);
    }
    Result<void> done;
    if (gpus) {
        done = list_gpus();
    } else if (help->parsed() && !help_about.empty()) {
        return run_tool({help_about, "--help"}, verbs);  // "strata help VERB" is "strata VERB --help"
    } else if (help->parsed()) {
        return run_tool({"--help"}, verbs);
    } else if (app.get_subcommands().empty()) {
        fmt::print("{}", app.help());
    } else {
        for (const auto& [sub, verb] : runs)
            if (sub->parsed()) {
                done = keep_inputs(*sub);
                if (done) done = within_this_machine(verb);
            }
    }
    return done ? 0 : report_error(done.error());
}

}  // namespace strata
