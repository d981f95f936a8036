// strata replay: every pass of the chosen frames again, headless; EXR, PNG and JSON.
#include <iostream>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/whole_file.h"
#include "replay/cli/revision.h"
#include "replay/cli/verb_options.h"
#include "replay/counted.h"
#include "replay/image_io.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct Options {
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames, until;
    std::vector<std::string> outputs = {"color", "depth_layers", "display"};
    std::size_t repeat = 1, timed = 0;
    std::filesystem::path folder = ".";
    bool json = false;
};

/// What a picture needs to be traced back; the same block is in the EXR header and in the JSON.
Metadata provenance(const Session& session, const Request& request, const Run& run) {
    ordered_json choices(run.choices);
    const DeviceInfo& device = session.device();
    Metadata metadata{{"software", fmt::format("strata {}", tool_revision)},
                      {"strata.capture", session.capture_id()},
                      {"strata.frame", std::to_string(request.frame)},
                      {"strata.settings", choices.dump()},
                      {"strata.device", device.name},
                      {"strata.driver", device.driver + " " + device.driver_version},
                      {"strata.cpu", device.cpu}};
    for (const auto& [name, image] : run.images) metadata["strata.hash." + name] = hash_of(image);
    return metadata;
}

ordered_json json_of(const Session& session, const Request& request, const Run& run) {
    ordered_json json{{"schema", "strata.replay"}, {"schema_version", 1}};
    for (const auto& [key, value] : provenance(session, request, run)) json["provenance"][key] = value;
    json["provenance"]["strata.settings"] = run.choices;
    for (const StepRecord& step : run.steps) {
        ordered_json row{{"scope", step.scope}, {"name", step.name}};
        if (step.ms) row["gpu_ms"] = {{"median", step.ms->median}, {"mad", step.ms->mad}, {"repeats", step.ms->repeats}};
        json["steps"].push_back(row);
    }
    for (const auto& [stage, ms] : run.stage_ms)
        json["stage_ms"][stage] = {{"median", ms.median}, {"mad", ms.mad}, {"repeats", ms.repeats}};
    for (const SkippedStage& skipped : run.skipped)
        json["left_out"].push_back({{"stage", name(skipped.stage)}, {"reason", skipped.reason}});
    for (const CounterRecord& counter : run.counters) json["counters"][counter.technique][counter.name] = counter.value;
    json["image_bytes"] = run.image_bytes;
    json["buffer_bytes"] = run.buffer_bytes;
    return json;
}

Result<void> write_frame(const Session& session, const Request& request, const Run& run, const Options& options) {
    const std::string base =
        (options.folder / fmt::format("{}.f{:04}", options.open.capture.stem().string(), request.frame)).string();
    std::vector<ExrPart> parts;
    for (const auto& [name, image] : run.images) parts.push_back({name, &image});
    if (!parts.empty()) {
        if (const auto done = write_exr(base + ".exr", parts, provenance(session, request, run)); !done) return done;
        fmt::print(stderr, "wrote {}.exr\n", base);
    }
    if (const auto display = run.images.find("display"); display != run.images.end()) {
        if (const auto done = write_png(base + ".png", display->second); !done) return done;
        fmt::print(stderr, "wrote {}.png\n", base);
    }
    const std::string json = json_of(session, request, run).dump(2) + "\n";
    if (const auto done = write_whole_file(base + ".json", json); !done) return done;
    fmt::print(stderr, "wrote {}.json\n", base);
    return {};
}

/// Replays again without the memo and names the first output that differs.
Result<void> check_repeats(Session& session, const Request& request, const Run& first, std::size_t repeats) {
    for (std::size_t repeat = 1; repeat < repeats; ++repeat) {
        session.forget_memo();
        const auto again = session.run(request);
        if (!again) return again.error();
        for (const auto& [name, image] : first.images)
            if (again->images.at(name).texels != image.texels)
                return fail(Fault::not_repeatable, "frame {}: '{}' differed in repeat {} of {}", request.frame, name, repeat + 1,
                            repeats);
    }
    if (repeats > 1) fmt::print(stderr, "frame {}: {} repeats, every output bit for bit the same\n", request.frame, repeats);
    return {};
}

/// Milliseconds by step, with their spread.
void print_times(const Run& run) {
    for (const StepRecord& step : run.steps)
        fmt::print("  {:>9.3f} ms +- {:<7.3f} {:<36} {}\n", step.ms->median, step.ms->mad, step.scope, step.name);
    fmt::print("  {:>9.3f} ms +- {:<7.3f} frame\n", run.frame_ms->median, run.frame_ms->mad);
}

/// One run; or with --time as many as asked for after a warm-up, everything executed every time.
Result<Run> run_once(Session& session, const Request& request, const Options& options) {
    if (options.timed == 0) return session.run(request);
    auto runs = session.time(std::span(&request, 1), options.timed);
    if (!runs) return runs.error();
    return std::move(runs->front());
}

/// "811229 fragments, 187 deepest": what the technique of a choice line counted.
std::string counters_of(const Run& run, std::string_view choice) {
    std::string text;
    for (const CounterRecord& counter : run.counters)
        if (choice.substr(0, choice.find(' ')) == counter.technique)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counter.value, counter.name);
    return text;
}

/// A line per stage, in the order of a frame, and what its technique counted below it.
void print_summary(const Request& request, const Run& run) {
    fmt::print("frame {}: {}, {:.2f} MiB of images, {:.2f} MiB of buffers\n", request.frame, counted(run.steps.size(), "step"),
               double(run.image_bytes) / (1 << 20), double(run.buffer_bytes) / (1 << 20));
    for (const StageInfo& stage : stages()) {
        for (const SkippedStage& skipped : run.skipped)
            if (skipped.stage == stage.stage) fmt::print("  {:<14} left out: {}\n", stage.name, skipped.reason);
        const auto choice = run.choices.find(std::string(stage.name));
        if (choice == run.choices.end()) continue;
        fmt::print("  {:<14} {}\n", stage.name, choice->second);
        if (const std::string counters = counters_of(run, choice->second); !counters.empty())
            fmt::print("  {:<14}   {}\n", "", counters);
    }
}

Result<void> replay(const Options& options) {
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->until = options.until;
    request->outputs = options.outputs;
    auto session = open(options.open);
    if (!session) return session.error();
    const auto frames = frame_indices(options.frames, (*session)->frame_count());
    if (!frames) return frames.error();
    std::error_code problem;
    std::filesystem::create_directories(options.folder, problem);
    if (problem) return fail(Fault::usage, "cannot make the folder {}: {}", options.folder.string(), problem.message());

    ordered_json all{{"schema", "strata.replay.list"}, {"schema_version", 1}, {"frames", ordered_json::array()}};
    for (const std::size_t frame : *frames) {
        request->frame = frame;
        const auto run = run_once(**session, *request, options);
        if (!run) return run.error();
        for (const std::string& note : run->notes) fmt::print(stderr, "strata: {}\n", note);
        if (const auto done = check_repeats(**session, *request, *run, options.repeat); !done) return done;
        if (const auto done = write_frame(**session, *request, *run, options); !done) return done;
        if (options.json) all["frames"].push_back(json_of(**session, *request, *run));
        else print_summary(*request, *run);
        if (options.timed > 0 && !options.json) print_times(*run);
    }
    if (options.json) std::cout << all.dump(2) << "\n";
    return {};
}

}  // namespace

std::function<Result<void>()> declare_replay(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--frames", options->frames, "which frames, like 0,4-8; default all");
    app.add_option("--outputs", options->outputs, "images to write: frame images or stage/technique:view")->delimiter(',');
    app.add_option("--until", options->until, "stop after the last step whose name contains this");
    app.add_option("--repeat", options->repeat, "replay this many times and fail (7) when any output differs")
        ->check(CLI::Range(1, 100000));
    app.add_option("--time", options->timed, "time every step this many times after a warm-up: median and deviation")
        ->check(CLI::Range(1, 10000));
    app.add_option("-o,--output", options->folder, "folder for the files, made when missing");
    app.add_flag("--json", options->json, "one JSON object on stdout");
    return [options] { return replay(*options); };
}

}  // namespace strata
