#include "replay/cli/tool.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <regex>
#include <system_error>

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/container/file.h"
#include "capture_format/container/kept_files.h"
#include "capture_format/container/whole_file.h"
#include "capture_format/out_of_memory.h"
#include "replay/cli/given_options.h"
#include "replay/error_text.h"
#include "replay/gpu/device.h"
#include "replay/json_text.h"
#include "replay/revision.h"
#include "replay/standard_streams.h"

namespace strata {
namespace {

constexpr const char* exit_codes =
    "exit codes: 0 ok, 1 over tolerance, 2 usage or an output that cannot be written, 3 bad or truncated input,\n"
    "4 the device or the memory budget lacks what is needed, 5 device failure, 6 expectation missing, 7 not repeatable,\n"
    "8 a mistake of strata, 130 interrupted (128 + the signal)";

/// Read by say().
constexpr const char *wants_ids = "-v,--verbose", *ids_help = "also print the id and the values of an error";

struct GpusArguments {
    bool list = false, json = false;
};

nlohmann::ordered_json gpu_json(const DeviceInfo& device) {
    return {{"index", device.index},
            {"name", device.name},
            {"kind", device.kind},
            {"driver", device.driver},
            {"driver_version", device.driver_version},
            {"can_replay", device.lacks.empty()},
            {"lacks", device.lacks.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(device.lacks)}};
}

Result<void> list_gpus(const GpusArguments& options) {
    const auto devices = list_devices();
    if (!devices) return devices.error();
    nlohmann::ordered_json json{{"schema", "strata.gpus"}, {"schema_version", 1}, {"gpus", nlohmann::ordered_json::array()}};
    for (const DeviceInfo& device : *devices) {
        json["gpus"].push_back(gpu_json(device));
        if (options.json) continue;
        to_stdout("{}  {}  ({}, {} {}){}\n", device.index, device.name, device.kind, device.driver, device.driver_version,
                  device.lacks.empty() ? "" : "  cannot replay: lacks " + device.lacks);
    }
    if (options.json) write_stdout(json_text(json));
    return {};
}

/// What is thrown as what is returned. A file may need more memory than there is and still be within every limit: 4 GiB for a
/// frame.
Result<void> without_exceptions(const std::function<Result<void>()>& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return fail(Fault::device_lacks, "machine.out_of_memory", "this machine has too little memory");
    } catch (const std::system_error& refused) {
        if (refused.code() == std::errc::resource_unavailable_try_again) return no_thread(refused);
        return fail(Fault::usage, "machine.refused", "{reason}", refused.what());
    } catch (const std::exception& mistake) {
        // oneTBB 2021.8 throws no system_error.
        if (std::string_view(mistake.what()).starts_with("pthread_create")) return no_thread(mistake);
        return fail(Fault::internal, "strata.mistake", "this is a mistake of strata; please report it with the command: {reason}",
                    mistake.what());
    }
}

/// A sentence quotes what is wrong, which may be a word of megabytes.
std::string shortened(std::string sentence) {
    constexpr std::size_t longest = 16384, end = 1024;  // what compilers say of shaders is some thousands
    if (sentence.size() > longest) sentence.replace(longest - end, sentence.size() - longest, " ... ");
    return sentence;
}

/// The files that options of this type name.
std::vector<std::filesystem::path> files_of(const CLI::App& verb, const std::string& type) {
    std::vector<std::filesystem::path> files;
    for (const CLI::Option* option : verb.get_options())
        if (option->get_type_name() == type) files.insert(files.end(), option->results().begin(), option->results().end());
    return files;
}

/// Whether the verb makes the folder of this file.
bool is_in_one_of(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file) {
    const auto parent = file.parent_path().lexically_normal();
    return std::ranges::any_of(folders, [&](const auto& folder) { return (folder / "").lexically_normal() == parent / ""; });
}

/// From now on no input of the verb is replaced. Inputs that are no files and outputs whose names are known are refused before
/// any work is done, and so are outputs that cannot be written: a report of hours would be lost.
Result<void> keep_inputs(const CLI::App& verb) {
    std::vector<std::filesystem::path> inputs = files_of(verb, input_file);
    std::error_code problem;
    for (const std::filesystem::path& input : files_of(verb, input_files))
        if (!std::filesystem::is_directory(input, problem)) inputs.push_back(input);
    const std::vector<std::filesystem::path> outputs = files_of(verb, output_file);
    for (const std::filesystem::path& output : outputs)
        if (output == "-")
            return fail(Fault::usage, "output.is_dash", "'{file}' is not a file; write to standard output with /dev/stdout", "-");
    for (const auto& files : {inputs, files_of(verb, extended_file)})
        for (const std::filesystem::path& input : files)
            if (const auto fine = check_is_file(input); !fine) return fine;
    keep_files(inputs);
    const std::vector<std::filesystem::path> folders = files_of(verb, output_folder);
    for (const std::filesystem::path& output : outputs) {
        if (const auto free = check_not_kept(output); !free) return free;
        if (is_in_one_of(folders, output)) continue;
        if (const auto tried = WholeFile::begin(output); !tried) return tried.error();
    }
    return {};
}

/// CLI11's errors (2.1) by their form, those that are hard to understand in other words.
Error error_of(const CLI::ParseError& error) {
    const std::string sentence = error.what();
    std::smatch part;
    const auto is = [&](std::string_view type, const char* form) {
        return error.get_name() == type && std::regex_match(sentence, part, std::regex(form));
    };
    if (is("ExcludesError", "(.*) excludes (.*)"))
        return fail(Fault::usage, "options.excluded", "{option} cannot be combined with {other}", part.str(1), part.str(2));
    if (is("RequiresError", "(.*) requires (.*)"))
        return fail(Fault::usage, "options.needs", "{option} needs {other}", part.str(1), part.str(2));
    if (is("RequiredError", "(.*) is required"))
        return fail(Fault::usage, "options.missing", "{option} is required", part.str(1));
    if (is("ArgumentMismatch", "(.*): At Most 1 required but received (.*)"))
        return fail(Fault::usage, "options.repeated", "{option} is given {times} times; give it once", part.str(1), part.str(2));
    if (is("ArgumentMismatch", "(.*): At least (.*) required but received (.*)"))
        return fail(Fault::usage, "options.value_count", "{option} takes {wanted} values, not {given}", part.str(1), part.str(2),
                    part.str(3));
    if (is("ArgumentMismatch", "(.*): 1 required .* missing"))
        return fail(Fault::usage, "options.no_value", "{option} needs a value", part.str(1));
    // Of words of the command line, which may be long: std::regex calls itself once per letter.
    const std::size_t colon = sentence.find(": ");
    if (colon != sentence.npos && error.get_name() == "ExtrasError")
        return fail(Fault::usage, "options.unexpected_argument", "unexpected argument: {argument}", sentence.substr(colon + 2));
    if (colon != sentence.npos && error.get_name() == "ValidationError")
        return fail(Fault::usage, "options.not_a_size", "{option}: {problem}", sentence.substr(0, colon),
                    sentence.substr(colon + 2));
    return fail(Fault::usage, "options.refused", "{problem}", sentence);
}

/// The same error with the command that explains the options.
Error with_help(Error error, const CLI::App& app) {
    const auto verb = app.get_subcommands();
    error.sentence += "; see strata help" + (verb.empty() ? "" : " " + verb.front()->get_name());
    return error;
}

/// Whether a verb is to run: help and versions are printed here.
Result<bool> parse(CLI::App& app, std::vector<std::string> arguments) {
    if (const auto known = check_names(app, arguments); !known) return known.error();
    const bool has_separator = std::ranges::count(arguments, "--") > 0;
    try {
        std::ranges::reverse(arguments);  // CLI11 takes a vector from its back
        app.parse(arguments);
        return true;
    } catch (const RefusedValue& refused) {
        return with_help(refused.error, app);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out, err;
        const int code = app.exit(error, out, err);
        write_stdout(out.str());
        if (code == 0) return false;
        const auto verb = app.get_subcommands();
        if (has_separator && !verb.empty())
            return fail(Fault::usage, "options.after_separator",
                        "arguments after -- are file names, and strata {verb} takes no more of them; put options before --",
                        verb.front()->get_name());
        return with_help(error_of(error), app);
    }
}

Result<void> run(std::vector<std::string> arguments, std::span<const Verb> verbs) {
    CLI::App app("Records the frames of a renderer once and replays every pass of them with any algorithm that does the job.",
                 "strata");
    app.footer(exit_codes);
    app.set_version_flag("--version", std::string("strata 0.1.0 ") + tool_revision);
    GpusArguments gpus;
    CLI::Option* list = app.add_flag("--list-gpus", gpus.list, "list the devices of this machine and whether they can replay");
    app.add_flag("--json", gpus.json, "print JSON instead of text, with --list-gpus")->needs(list);
    app.add_flag(wants_ids, ids_help);
    app.require_subcommand(0, 1);

    std::string help_about;
    CLI::App* help = app.add_subcommand("help", "show the options of a verb");
    help->add_option("verb", help_about, "verb to explain");

    std::vector<std::pair<CLI::App*, std::function<Result<void>()>>> runs;
    for (const Verb& verb : verbs) {
        CLI::App* sub = app.add_subcommand(std::string(verb.name), std::string(verb.summary));
        runs.emplace_back(sub, verb.declare(*sub));
        refuse_what_is_no_number(*sub);
        sub->add_flag(wants_ids, ids_help);
    }
    const auto goes_on = parse(app, std::move(arguments));
    if (!goes_on) return goes_on.error();
    if (!*goes_on) return {};
    if (gpus.list && !app.get_subcommands().empty())
        return fail(Fault::usage, "options.excluded", "{option} cannot be combined with {other}", "--list-gpus",
                    "strata " + app.get_subcommands().front()->get_name());
    if (gpus.list) return list_gpus(gpus);
    if (help->parsed() && help_about.empty()) return run({"--help"}, verbs);
    if (help->parsed()) return run({help_about, "--help"}, verbs);  // "strata help VERB" is "strata VERB --help"
    for (const auto& [sub, verb] : runs)
        if (sub->parsed())  // clang 14 captures no structured binding
            return check_values(*sub).and_then([parsed = sub] { return keep_inputs(*parsed); }).and_then(verb);
    write_stdout(app.help());
    return {};
}

/// SPIRV-Cross ends the program where malloc() fails or a vector of its own throws. No thread of ours is left joinable, so that
/// a call of terminate() without an exception is this.
[[noreturn]] void end_without_memory() {
    bool is_memory = !std::current_exception();
    if (!is_memory) try {
            throw;
        } catch (const std::bad_alloc&) {
            is_memory = true;
        } catch (...) {}
    if (!is_memory) std::abort();
    constexpr std::string_view words = "strata: this machine has too little memory\n";
    [[maybe_unused]] const auto said = ::write(STDERR_FILENO, words.data(), words.size());
    end_program(static_cast<int>(Fault::device_lacks));
}

/// Whether the arguments have one of these flags: an error may be of the arguments themselves, before they are parsed.
bool has_flag(std::span<const std::string> arguments, std::initializer_list<std::string_view> flags) {
    const auto end = std::ranges::find(arguments, "--");
    return std::any_of(arguments.begin(), end, [&](const std::string& word) { return std::ranges::count(flags, word) > 0; });
}

/// On standard error as a sentence, and with -v by its id.
void say(const Error& error, std::span<const std::string> arguments) {
    to_stderr("strata: {}\n", shortened(error.sentence));
    if (has_flag(arguments, {"-v", "--verbose"})) to_stderr("strata: {}\n", shortened(id_text(error)));
}

/// Whether results are to be printed as JSON; of strata export, --json names the kind of file.
bool asks_for_json(std::span<const std::string> arguments) {
    const auto verb = std::ranges::find_if(arguments, [](const std::string& word) { return !word.starts_with('-'); });
    return has_flag(arguments, {"--json"}) && (verb == arguments.end() || *verb != "export");
}

/// With --json standard output is one document also where the verb printed none.
void say_as_json(const Error& error, std::span<const std::string> arguments) {
    if (!asks_for_json(arguments) || wrote_stdout()) return;
    write_stdout(json_text({{"schema", "strata.error"}, {"schema_version", 1}, {"error", json_of(error)}}));
}

}  // namespace

int run_tool(std::vector<std::string> arguments, std::span<const Verb> verbs) {
    std::set_terminate(end_without_memory);
    const Result<void> done = without_exceptions(
        [&] { return leave_nothing_half_written_when_stopped().and_then([&] { return run(arguments, verbs); }); });
    if (!done) {
        say(done.error(), arguments);
        say_as_json(done.error(), arguments);
    }
    const Result<void> written = finish_stdout();
    if (!written) say(written.error(), arguments);
    const Result<void>& first = done ? written : done;
    return first ? 0 : static_cast<int>(first.error().fault);
}

}  // namespace strata
