// strata replay: every pass of the chosen frames again, headless; EXR, PNG and JSON.
#include <algorithm>
#include <cctype>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/reader.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/expected_results.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/output_picture.h"
#include "replay/cli/repeat.h"
#include "replay/cli/run_json.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/error_text.h"
#include "replay/expectations/expectation_check.h"
#include "replay/images/image_io.h"
#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/progress_line.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct ReplayArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames, until, eye;
    std::vector<std::string> outputs;  ///< none: color, depth_layers and display
    std::size_t repeat = 1, timed = 0;
    std::filesystem::path folder, shaders;  ///< without a folder no file is written
    std::filesystem::path expect_from;      ///< empty: the capture itself
    std::optional<double> tolerance;
    TableOutput printed;
    std::string date;  ///< utc_date()
    bool expect = false, no_expect = false, strict = false;
};

/// A frame replayed, and held against what the capture expects where that was asked for.
struct Replayed {
    Run run;
    Metadata provenance;
    std::optional<Expectation> got;  ///< what it gave, beside what was expected
    std::optional<ExpectationVerdict> verdict;
    ordered_json json;
};

/// What was asked for beyond the capture's own choices, as part of a file's name: ".transparency-weighted,weight=w9".
std::string choice_in_name(const ReplayArguments& options, const Request& request) {
    std::vector<std::string> words = use_texts(request.choices);
    for (const auto& more : {set_texts(request.choices), options.choices.force})
        words.insert(words.end(), more.begin(), more.end());
    if (options.choices.samples != 0) words.push_back(fmt::format("samples={}", options.choices.samples));
    for (const std::string& more : {options.eye, options.until})
        if (!more.empty()) words.push_back(more);
    if (!options.shaders.empty()) words.push_back("shaders=" + options.shaders.filename().string());
    if (words.empty()) return {};
    std::string name = fmt::format(".{}", fmt::join(words, ","));
    std::ranges::replace_if(
        name, [](unsigned char c) { return !std::isalnum(c) && !std::strchr("=_-+.,", c); }, '-');
    constexpr std::size_t longest = 150;  // of the 255 bytes that a file's name may have; the rest is told by its hash
    if (name.size() <= longest) return name;
    return fmt::format("{}-{:016x}", name.substr(0, longest), std::hash<std::string>()(name));
}

/// The picture first: it is what a person waits for.
Result<void> write_frame(const Request& request, const Replayed& replayed, const ReplayArguments& options) {
    if (options.folder.empty()) return {};
    const Run& run = replayed.run;
    const std::string name =
        fmt::format("{}.f{:04}{}", options.open.capture.stem().string(), request.variant.frame, choice_in_name(options, request));
    const std::string base = (options.folder / name).string();
    if (const auto display = run.images.find("display"); display != run.images.end()) {
        if (const auto done = write_png(base + ".png", display->second); !done) return done;
        to_stderr("wrote {}.png\n", base);
    }
    for (const auto& [image, texels] : run.images) {
        if (options.outputs.empty() || image == "display") continue;
        std::string path = fmt::format("{}.{}.png", base, image);
        std::ranges::replace_if(
            path.begin() + std::ptrdiff_t(base.size()), path.end(), [](char c) { return c == '/' || c == ':' || c == ' '; }, '-');
        const std::string of = fmt::format("{} frame {}", options.open.capture.filename().string(), request.variant.frame);
        if (const auto done = write_output_picture(path, run, image, of); !done) return done;
        to_stderr("wrote {}\n", path);
    }
    if (!run.images.empty()) {
        if (const auto done = write_exr(base + ".exr", run.images, replayed.provenance); !done) return done;
        to_stderr("wrote {}.exr\n", base);
    }
    if (const auto done = write_whole_file(base + ".json", json_text(replayed.json)); !done) return done;
    to_stderr("wrote {}.json\n", base);
    return {};
}

/// The name in a line of Run::choices.
std::string_view technique_of(std::string_view choice) { return choice.substr(0, choice.find(' ')); }

/// Milliseconds by step, with their spread.
void print_times(const Run& run) {
    for (const StepRecord& step : run.steps)
        to_stdout("  {:>9.3f} ms +- {:<7.3f} {:<36} {}\n", step.ms->median, step.ms->mad, text_of(step.scope), step.name);
    to_stdout("  {:>9.3f} ms +- {:<7.3f} frame\n", run.frame_ms->median, run.frame_ms->mad);
    if (run.whole_frame_ms)
        to_stdout("  {:>9.3f} ms +- {:<7.3f} frame without timestamps between its steps\n", run.whole_frame_ms->median,
                  run.whole_frame_ms->mad);
    if (run.empty_step_ms)
        to_stdout("  {:>9.3f} ms +- {:<7.3f} empty step: the part of every step that timestamps and barriers take\n",
                  run.empty_step_ms->median, run.empty_step_ms->mad);
    const auto print_unchanged = [](const Spread& ms, std::string_view of) {
        to_stdout("  {:>9.3f} ms +- {:<7.3f} {}, unchanged since the frame before\n", ms.median, ms.mad, of);
    };
    for (const auto& [stage, ms] : run.unchanged_stage_ms) print_unchanged(ms, stage);
    if (run.unchanged_frame_ms) print_unchanged(*run.unchanged_frame_ms, "frame");
}

/// Times a frame that follows itself, where a technique keeps work.
Result<void> time_unchanged(Session& session, Request request, std::size_t repeats, Run& run) {
    std::vector<std::string> keeping;
    for (const auto& [stage, choice] : run.choices) {
        const auto technique = find_technique(technique_of(choice));
        if (technique && (*technique)->abilities.keeps_work) keeping.push_back(stage);
    }
    if (keeping.empty()) return {};
    request.unchanged = true;
    const auto runs = session.time(std::span(&request, 1), repeats);
    if (!runs) return runs.error();
    for (const std::string& stage : keeping) run.unchanged_stage_ms.emplace(stage, runs->front().stage_ms.at(stage));
    run.unchanged_frame_ms = runs->front().frame_ms;
    return {};
}

/// One run; or with --time as many as asked for after a warm-up, everything executed every time.
Result<Run> run_once(Session& session, const Request& request, const ReplayArguments& options) {
    if (options.timed == 0) return session.run(request);
    Request timed = request;
    timed.whole = timed.counted = true;
    auto runs = session.time(std::span(&timed, 1), options.timed);
    if (!runs) return runs.error();
    Run run = std::move(runs->front());
    if (const auto done = time_unchanged(session, request, options.timed, run); !done) return done.error();
    auto looked_at = session.run(request);
    if (!looked_at) return looked_at.error();
    run.passes = std::move(looked_at->passes);
    run.light_faults = std::move(looked_at->light_faults);
    return run;
}

/// Whether a comparison with what the capture expects must take place.
bool demands_expectations(const ReplayArguments& options) {
    return options.expect || options.tolerance || !options.expect_from.empty();
}

Result<void> check_options(const ReplayArguments& options, const CLI::App& app) {
    if (!demands_expectations(options)) return {};
    return check_not_given(
        app, {"--until", "--eye", "--shaders", "--no-expect"},
        "--expect, --expect-from and --tolerance compare whole frames, as they were recorded, with what is expected");
}

bool expects(const Session& session, const ReplayArguments& options) {
    const bool as_recorded = options.eye.empty() && options.shaders.empty();
    return as_recorded && !options.no_expect && options.until.empty() &&
           (demands_expectations(options) || !session.capture()->expectations().empty());
}

/// Of what is replayed, with every frame of it.
DocumentHead head_of(const Session& session, const ReplayArguments& options) {
    return {.schema = "strata.replay.list",
            .date = options.date,
            .device = &session.device(),
            .capture_id = session.capture_id(),
            .capture_name = options.open.capture.filename().string()};
}

/// Compared with the expected results, where that is not null.
Result<Replayed> replay_frame(Session& session, const Request& request, const ReplayArguments& options,
                              const ExpectedResults* expected) {
    auto run = run_once(session, request, options);
    if (!run) return run.error();
    Replayed replayed{.run = *std::move(run)};
    for (const std::string& note : replayed.run.notes) to_stderr("strata: {}\n", note);
    for (const LightFault& fault : replayed.run.light_faults) to_stderr("strata: {}\n", sentence(fault));
    if (const auto done = check_repeats(session, request, replayed.run, options.repeat); !done) return done.error();
    if (options.repeat > 1)
        to_stderr("frame {}: {} repeats, every image of every pass is bit for bit the same\n", request.variant.frame,
                  options.repeat);
    if (expected) {
        replayed.got = expectation_of(session, request, replayed.run);
        auto verdict = check_expectations(expected->capture(session), expected->expectations, replayed.run, *replayed.got,
                                          options.tolerance.value_or(0));
        if (!verdict) return verdict.error();
        replayed.verdict = *std::move(verdict);
    }
    replayed.provenance = provenance(session, request, replayed.run);
    DocumentHead head = head_of(session, options);
    head.schema = "strata.replay";
    head.width = replayed.run.width;
    head.height = replayed.run.height;
    head.samples = replayed.run.samples;
    replayed.json = json_of(head, replayed.provenance, replayed.run, replayed.verdict ? &*replayed.verdict : nullptr);
    return replayed;
}

/// The command that would make what a frame gave its expectation.
std::string command_to_accept(const ReplayArguments& options, std::size_t frame) {
    std::string command = fmt::format("strata accept {} --frames {}", shell_word(options.open.capture.string()), frame);
    if (!options.expect_from.empty()) command += " --to " + shell_word(options.expect_from.string());
    for (const std::string& use : options.choices.uses) command += fmt::format(" --use {}", use);
    for (const std::string& set : options.choices.sets) command += fmt::format(" --set {}", set);
    for (const std::string& force : options.choices.force) command += fmt::format(" --force {}", force);
    if (options.choices.samples != 0) command += fmt::format(" --samples {}", options.choices.samples);
    if (!options.open.device.gpu.empty()) command += " --gpu " + shell_word(options.open.device.gpu);
    return command;
}

/// The verdict as what the program ends with.
Result<void> judge(const Request& request, const Replayed& replayed, const ReplayArguments& options) {
    if (!replayed.verdict) return {};
    const ExpectationVerdict& verdict = *replayed.verdict;
    const std::string where = verdict.elsewhere ? fmt::format(" on {}", text(*verdict.elsewhere)) : "";
    switch (verdict.agreement) {
        case Agreement::exact:
            to_stderr("frame {}: every image of every pass is bit for bit as expected{}\n", request.variant.frame, where);
            return {};
        case Agreement::within_tolerance:
            for (const ImageVerdict& image : verdict.images)
                if (image.agreement == Agreement::within_tolerance)
                    to_stderr("frame {}: within tolerance of what is expected{}: {}\n", request.variant.frame, where,
                              sentence(image));
            return {};
        case Agreement::diverges:
            return fail(Fault::over_tolerance, "replay.diverges",
                        "frame {frame} is not as expected on {device}; the first pass that diverges is {divergence}",
                        request.variant.frame, verdict.elsewhere ? text(*verdict.elsewhere) : "this device",
                        sentence(*verdict.first_divergence()));
        case Agreement::no_expectation:
            if (options.printed.json) to_stderr("frame {} gives\n  {}\n", request.variant.frame, short_json(*replayed.got));
            return fail(Fault::expectation_missing, "replay.no_expectation",
                        "frame {frame} has no expected results for this device and these choices; store them with: {command}",
                        request.variant.frame, command_to_accept(options, request.variant.frame));
    }
    return {};
}

/// Why a frame that was replayed has no image or table of that name. Several stages may make an image: all must be left out.
std::string why_missing(const std::string& output, const Run& run, const ReplayArguments& options) {
    const SkippedStage* first = nullptr;
    bool is_made = false;
    for (const StageInfo& stage : stages()) {
        if (!output.starts_with(fmt::format("{}/", stage.name)) && std::ranges::count(stage.outputs, output) == 0) continue;
        const auto skipped = std::ranges::find(run.skipped, stage.stage, &SkippedStage::stage);
        is_made = is_made || skipped == run.skipped.end();
        if (!first && skipped != run.skipped.end()) first = &*skipped;
    }
    if (is_made && !options.until.empty())
        return fmt::format("--until {} ends the frame before this image is written", options.until);
    if (!is_made && first) return fmt::format("the stage {} is left out ({})", name(first->stage), first->reason);
    return "no stage of the frame writes it";
}

/// Fails where an output that was asked for by its name is not there; the others are.
Result<void> check_outputs(const Request& request, const Run& run, const ReplayArguments& options) {
    std::string missing;
    for (const std::string& output : options.outputs)
        if (!run.images.contains(output) && !run.tables.contains(output))
            missing += fmt::format("{}'{}': {}", missing.empty() ? "" : "; ", output, why_missing(output, run, options));
    if (missing.empty()) return {};
    return fail(Fault::usage, "frame.no_output", "frame {frame} has no {output}", request.variant.frame, missing);
}

/// Fails where light is no number.
Result<void> check_light(const Request& request, const Run& run) {
    const auto fault = std::ranges::find(run.light_faults, LightFault::Kind::not_finite, &LightFault::kind);
    if (fault == run.light_faults.end()) return {};
    return fail(Fault::over_tolerance, "replay.not_finite", "frame {frame}: {light}", request.variant.frame, sentence(*fault));
}

Result<void> check_supported(const Request& request, const Run& run) {
    if (run.not_supported.empty()) return {};
    const UnsupportedChoice& first = run.not_supported.front();
    return fail(Fault::over_tolerance, "replay.not_supported", "frame {frame}: {technique} cannot do {feature}",
                request.variant.frame, first.technique, first.reason);
}

/// "811229 fragments, 187 deepest": what the technique of a choice line counted.
std::string counters_of(const Run& run, std::string_view choice) {
    const std::string technique(technique_of(choice));
    if (run.not_counted.contains(technique)) return "not counted: a step that counts was left out";
    std::string text;
    for (const CounterRecord& counter : run.counters)
        if (technique == counter.technique) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counter.value, counter.name);
    return text;
}

/// A line per stage, in the order of a frame, and what its technique counted below it.
void print_summary(const Request& request, const Run& run) {
    to_stdout("frame {}: {}, {:.2f} MiB of images, {:.2f} MiB of buffers\n", request.variant.frame,
              plural(run.steps.size(), "step"), double(run.image_bytes) / (1 << 20), double(run.buffer_bytes) / (1 << 20));
    for (const StageInfo& stage : stages()) {
        for (const SkippedStage& skipped : run.skipped)
            if (skipped.stage == stage.stage) to_stdout("  {:<14} left out: {}\n", stage.name, skipped.reason);
        const auto choice = run.choices.find(std::string(stage.name));
        if (choice == run.choices.end()) continue;
        to_stdout("  {:<14} {}\n", stage.name, choice->second);
        if (const std::string counters = counters_of(run, choice->second); !counters.empty())
            to_stdout("  {:<14}   {}\n", "", counters);
    }
}

Result<void> replay(const ReplayArguments& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->until = options.until;
    request->outputs = options.outputs;
    if (options.outputs.empty()) request->outputs = {"color", "depth_layers", "display"};
    const auto eye = eye_move_of(options.eye);
    if (!eye) return eye.error();
    request->variant.eye = *eye;
    auto session = open(options.open);
    if (!session) return session.error();
    if (!options.shaders.empty())
        if (const auto reloaded = (*session)->reload_shaders(options.shaders); !reloaded) return reloaded.error();
    const auto frames = frame_indices(options.frames, (*session)->frame_count());
    if (!frames) return frames.error();
    if (!options.folder.empty())
        if (const auto made = make_folder(options.folder); !made) return made;
    if (!options.outputs.empty() && options.folder.empty() && !options.printed.json)
        to_stderr("strata: --outputs alone writes nothing: pass -o FOLDER for images, -o FOLDER or --json for tables\n");
    std::optional<ExpectedResults> expected;
    if (expects(**session, options)) {
        auto known = expected_results(**session, options.open, options.expect_from, *frames);
        if (!known) return known.error();
        expected = *std::move(known);
    }

    const bool passes = options.repeat > 1 || options.printed.json || expected;
    request->once = true;
    request->light = LightCheck::on;
    request->passes = passes && options.until.empty() ? Passes::read_back : Passes::not_read;
    ordered_json all = document(head_of(**session, options));
    all["frames"] = ordered_json::array();
    std::vector<Sheet> steps;
    Result<void> judged;  // what diverges counts before what is missing, and the first frame before later ones
    const Progress progress = progress_line();
    LeftOutNotes notes;
    for (std::size_t i = 0; i < frames->size(); ++i) {
        show_frame(progress, i, frames->size());
        request->variant.frame = (*frames)[i];
        if (const auto told = notes.tell(**session, *request); !told) return told;
        auto replayed = replay_frame(**session, *request, options, expected ? &*expected : nullptr);
        if (!replayed) return replayed.error();
        if (const auto done = write_frame(*request, *replayed, options); !done) return done;
        const bool is_text = printed_format(options.printed) == OutputFormat::text;
        if (is_text) print_summary(*request, replayed->run);
        if (options.timed > 0 && is_text) print_times(replayed->run);
        if (options.printed.csv) steps.push_back(steps_of(replayed->run, request->variant.frame));
        auto now = judge(*request, *replayed, options);
        if (now && options.strict) now = check_supported(*request, replayed->run);
        if (now && options.strict) now = check_light(*request, replayed->run);
        if (now) now = check_outputs(*request, replayed->run, options);
        if (!now && (judged || now.error().fault < judged.error().fault)) judged = now;
        all["frames"].push_back(std::move(replayed->json));
    }
    if (!judged) all["error"] = json_of(judged.error());
    if (options.printed.json) write_stdout(json_text(all));
    if (options.printed.csv) write_stdout(as_csv(steps));
    return judged;
}

}  // namespace

std::function<Result<void>()> declare_replay(CLI::App& app) {
    const auto options = std::make_shared<ReplayArguments>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--frames", options->frames, "indices of frames, like 0,4-8; default all");
    app.add_option("--outputs", options->outputs,
                   "images to write as .exr and .png: frame images or views (stage/technique:view); tables go into the .json. "
                   "Names: strata list --images, --views")
        ->delimiter(',');
    auto* until = app.add_option("--until", options->until, "stop after the last step whose name contains this text");
    app.add_option("--repeats", options->repeat,
                   "replay this many times, 2 or more; exit code 7 if any image of any pass differs")
        ->check(from_to(2, 100000))
        ->excludes(until);
    CLI::Option* time =
        app.add_option("--time", options->timed,
                       "time every step over this many repeats after a warm-up, as if no frame came before; print median and "
                       "deviation, the frame without timestamps between steps, an empty step, and what stages that keep work "
                       "take where nothing changed")
            ->check(from_to(1, 10000));
    app.add_option(
           "-o,--output", options->folder,
           "write .exr, .png and .json of each frame to this folder, named for the --use and --set choices; default: write "
           "nothing")
        ->type_name(output_folder);
    add_formats(app, options->printed);
    app.get_option("--csv")->needs(time)->description("print the times of steps as comma-separated values instead of text");
    app.add_option("--tolerance", options->tolerance,
                   "largest allowed relative RMSE to the expected images; exit code 6 if the capture has none")
        ->check(not_negative());
    add_eye(app, options->eye);
    app.add_option("--shaders", options->shaders,
                   "replace built-in shaders by those in the passes/ folder of this folder; needs "
                   "glslangValidator");
    app.add_flag("--strict", options->strict,
                 "exit code 1 instead of a warning if a technique does not support a feature of the frame, or if light is not "
                 "finite");
    app.add_flag("--expect", options->expect, "exit code 6 if the capture has no expected results for a frame");
    app.add_option("--expect-from", options->expect_from,
                   "compare with the expected results of this capture, frame by frame; exit code 6 if it has none")
        ->type_name(input_file);
    app.add_flag("--no-expect", options->no_expect, "do not compare with the capture's expected results");
    return [options, &app] {
        options->date = date_of_output();
        return check_options(*options, app).and_then([&] { return replay(*options); });
    };
}

}  // namespace strata
