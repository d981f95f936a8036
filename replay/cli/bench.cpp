// strata bench: the ratios of times and the published tables of a technique, measured on this device; or the device itself.
#include "replay/bench/bench.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/frame/frame.h"
#include "capture_format/nearest_name.h"
#include "capture_format/reader.h"
#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/bench/device_bench.h"
#include "replay/bench/published_tables.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"
#include "replay/progress_line.h"
#include "replay/report/variants.h"

namespace strata {
namespace {

// Of scenarios, where no extent is asked for: a CPU takes seconds per ratio, a GPU's clock has something to measure.
using PixelExtent = std::pair<std::uint32_t, std::uint32_t>;
constexpr PixelExtent extent_on_a_cpu{320, 180}, extent_on_a_gpu{1920, 1080};

// In place of a technique.
constexpr std::string_view the_device = "device";
// What the device is held against where no capture is given.
constexpr std::string_view device_scenario = "smoke_grenade";

struct BenchArguments {
    std::string word, only, size;
    OpenOptions open;
    ChoiceOptions choices;
    std::size_t frame = 0, repeats = 7;
    bool tables = false;  ///< published ones, instead of ratios
    TableOutput output;
};

/// Ratios of the technique of that name, with or without its stage. `only` is in their names.
Result<std::vector<Claim>> claims_of(const std::string& word, const std::string& only) {
    std::vector<Claim> claims;
    std::vector<std::string_view> known{the_device}, stating, names;
    const auto words = words_for_techniques();
    known.insert(known.end(), words.begin(), words.end());
    const auto called = techniques_called(word);
    for (const Technique& technique : techniques()) {
        if (!technique.claims.ratios.empty()) stating.push_back(technique.name);
        if (std::ranges::count(called, &technique) == 0) continue;
        for (const TimeRatio& ratio : technique.claims.ratios) {
            names.push_back(ratio.name);
            if (ratio.name.find(only) != std::string_view::npos) claims.push_back({.technique = &technique, .ratio = &ratio});
        }
    }
    if (called.empty())
        return fail(Fault::usage, "technique.unknown", "no technique {technique}{suggestion}", word, did_you_mean(word, known));
    if (names.empty())
        return fail(Fault::usage, "bench.no_ratios", "{technique} lists no ratios to measure; these techniques do: {known}", word,
                    fmt::format("{}", fmt::join(stating, ", ")));
    if (claims.empty())
        return fail(Fault::usage, "bench.unknown_ratio", "no ratio of {technique} has '{only}' in its name; its ratios: {known}",
                    word, only, fmt::format("{}", fmt::join(names, "; ")));
    return claims;
}

/// Published tables of the techniques of that name, or of that stage. `only` is in their titles.
Result<std::vector<TableClaim>> tables_of(const std::string& word, const std::string& only) {
    std::vector<TableClaim> claims;
    std::vector<std::string_view> known{the_device}, publishing, titles;
    const auto words = words_for_techniques();
    known.insert(known.end(), words.begin(), words.end());
    const auto stage = find_stage(word);
    const auto called = stage ? techniques_of(*stage) : techniques_called(word);
    for (const Technique& technique : techniques()) {
        if (!technique.claims.tables.empty()) publishing.push_back(technique.name);
        if (std::ranges::count(called, &technique) == 0) continue;
        for (const PublishedTable& table : technique.claims.tables) {
            titles.push_back(table.title);
            if (table.title.find(only) != std::string_view::npos) claims.push_back({.technique = &technique, .table = &table});
        }
    }
    if (called.empty())
        return fail(Fault::usage, "technique.unknown", "no technique {technique}{suggestion}", word, did_you_mean(word, known));
    if (titles.empty())
        return fail(Fault::usage, "bench.no_tables", "{technique} has no published tables; these techniques do: {known}", word,
                    fmt::format("{}", fmt::join(publishing, ", ")));
    if (claims.empty())
        return fail(Fault::usage, "bench.unknown_table", "no table of {technique} has '{only}' in its title; its tables: {known}",
                    word, only, fmt::format("{}", fmt::join(titles, "; ")));
    return claims;
}

/// Frames of scenarios, each built once.
class ScenarioFrames {
public:
    explicit ScenarioFrames(PixelExtent extent) : extent_(extent) {}

    Result<std::size_t> place_of(std::string_view name, const FrameChange& change) {
        const std::pair key(name, change.name);
        const auto place = std::ranges::find(built_, key);
        if (place != built_.end()) return static_cast<std::size_t>(place - built_.begin());
        const auto scenario = find_scenario(name);
        if (!scenario) return scenario.error();
        built_.push_back(key);
        frames_.push_back((*scenario)->build(0, {.width = extent_.first, .height = extent_.second}));
        if (change.change) change.change(frames_.back());
        return frames_.size() - 1;
    }
    std::vector<Frame> taken() { return std::move(frames_); }

private:
    PixelExtent extent_;
    std::vector<std::pair<std::string_view, std::string_view>> built_;  ///< scenario, and what is changed in it
    std::vector<Frame> frames_;
};

/// The frames that the ratios are measured on; the claims get their places.
Result<std::vector<Frame>> frames_of(std::span<Claim> claims, PixelExtent extent) {
    ScenarioFrames frames(extent);
    for (Claim& claim : claims) {
        claim.scene = claim.ratio->scenario;
        const auto of = frames.place_of(claim.ratio->scenario, claim.ratio->of_frame);
        if (!of) return of.error();
        const auto against = frames.place_of(claim.ratio->scenario, claim.ratio->against_frame);
        if (!against) return against.error();
        claim.base.variant.frame = *of;
        claim.against_frame = *against;
    }
    return frames.taken();
}

/// The same for tables.
Result<std::vector<Frame>> frames_of(std::span<TableClaim> claims, PixelExtent extent) {
    ScenarioFrames frames(extent);
    for (TableClaim& claim : claims) {
        claim.scene = claim.table->scenario;
        const auto place = frames.place_of(claim.table->scenario, {});
        if (!place) return place.error();
        claim.base.variant.frame = *place;
    }
    return frames.taken();
}

/// Frames of scenarios at the extent that was asked for, or at the one that suits the device.
template <typename FramesOf>
Result<std::unique_ptr<Session>> open_scenarios(const BenchArguments& options, const FramesOf& frames_of) {
    const auto asked = options.size.empty() ? Result(extent_on_a_cpu) : extent_of(options.size);
    if (!asked) return asked.error();
    Result<std::vector<Frame>> frames = frames_of(*asked);
    if (!frames) return frames.error();
    auto session = Session::open(*std::move(frames), options.open.device);
    if (!session || !options.size.empty() || (*session)->device().software) return session;
    frames = frames_of(extent_on_a_gpu);
    return frames ? Session::open(*std::move(frames), options.open.device) : frames.error();
}

/// Of ratios or tables.
template <typename Measured>
Result<std::unique_ptr<Session>> open_capture(const BenchArguments& options, Measured& claims) {
    for (auto& claim : claims) {
        claim.scene = options.open.capture.filename().string();
        claim.base.variant.frame = options.frame;
    }
    return open(options.open);
}

template <typename Bench>
Result<void> print(const BenchArguments& options, Bench made) {
    made.date = date_of_output();
    write_stdout(in_format(printed_format(options.output), made));
    const std::string text = in_format(file_format(options.output, OutputFormat::json), made);
    if (!options.output.file.empty())
        if (const auto done = write_whole_file(options.output.file, text); !done) return done;
    return made.stopped.empty() ? Result<void>() : fail(Fault::stopped, "session.stopped", "{progress}", made.stopped);
}

Result<void> bench_the_device(const BenchArguments& options) {
    if (!options.only.empty())
        return fail(Fault::usage, "options.not_applicable", "{option} does not apply: {reason}", "--only",
                    "it selects ratios of a technique, and 'device' has none");
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    const auto frames_of = [](PixelExtent extent) {
        return find_scenario(device_scenario).and_then([&](const Scenario* scenario) {
            return Result(std::vector{scenario->build(0, {.width = extent.first, .height = extent.second})});
        });
    };
    const bool is_scenario = options.open.capture.empty();
    const auto session = is_scenario ? open_scenarios(options, frames_of) : open(options.open);
    if (!session) return session.error();
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    const auto for_limits = Device::open(options.open.device);
    if (!for_limits) return for_limits.error();
    const StopAtSignal signal;
    auto made =
        bench_device(**session, **for_limits,
                     {.request = *request, .repeats = options.repeats, .progress = progress_line(), .stop = signal.token()});
    if (!made) return made.error();
    made->scene = is_scenario ? std::string(device_scenario) : options.open.capture.filename().string();
    if (!is_scenario) made->capture_id = (*session)->capture_id();
    return print(options, *std::move(made));
}

Result<void> bench_tables(const BenchArguments& options) {
    auto claims = tables_of(options.word, options.only);
    if (!claims) return claims.error();
    const auto base = request_of(options.choices);
    if (!base) return base.error();
    for (TableClaim& claim : *claims) claim.base = *base;
    const auto frames = [&](PixelExtent extent) { return frames_of(*claims, extent); };
    const auto session = options.open.capture.empty() ? open_scenarios(options, frames) : open_capture(options, *claims);
    if (!session) return session.error();
    LeftOutNotes notes;
    for (const TableClaim& claim : *claims) static_cast<void>(notes.tell(**session, claim.base));  // its rows say why they fail
    const StopAtSignal signal;
    (*session)->stop_when(signal.token());
    const auto measured = measure_tables(**session, *claims, options.repeats, progress_line());
    if (!measured) return measured.error();
    return print(options, *measured);
}

Result<void> bench(const BenchArguments& options) {
    if (const auto fits = check_ending(options.output); !fits) return fits;
    if (options.tables && options.word == the_device)
        return fail(Fault::usage, "options.not_applicable", "{option} does not apply: {reason}", "--tables",
                    "no source prints tables of a device");
    if (options.tables) return bench_tables(options);
    if (options.word == the_device) return bench_the_device(options);
    auto claims = claims_of(options.word, options.only);
    if (!claims) return claims.error();
    const auto base = request_of(options.choices);
    if (!base) return base.error();
    for (Claim& claim : *claims) claim.base = *base;
    const auto frames = [&](PixelExtent extent) { return frames_of(*claims, extent); };
    const auto session = options.open.capture.empty() ? open_scenarios(options, frames) : open_capture(options, *claims);
    if (!session) return session.error();
    LeftOutNotes notes;
    for (const Claim& claim : *claims) {
        const auto variant = variant_of(*claim.technique, claim.ratio->of, claim.base);
        if (variant)
            static_cast<void>(notes.tell(**session, variant->request, base->choices));  // its row will say why it has no plan
    }
    const StopAtSignal signal;
    (*session)->stop_when(signal.token());
    const auto measured = measure_ratios(**session, *claims, options.repeats, progress_line());
    if (!measured) return measured.error();
    return print(options, *measured);
}

}  // namespace

std::function<Result<void>()> declare_bench(CLI::App& app) {
    const auto options = std::make_shared<BenchArguments>();
    app.add_option("technique", options->word,
                   "technique, with or without its stage; with --tables also a stage; or 'device': bytes and operations of the "
                   "slowest steps, relative to what the device can do")
        ->required();
    CLI::Option* capture =
        app.add_option("capture", options->open.capture,
                       "capture to measure on; default: a scenario chosen for each ratio, smoke_grenade for the device")
            ->type_name(input_file);
    add_options(app, options->open.device);
    app.add_flag("--allow-partial", options->open.allow_partial, "read the complete frames of a truncated file")->needs(capture);
    add_options(app, options->choices);
    app.add_flag("--tables", options->tables,
                 "measure the tables that papers and talks print of the technique, beside their numbers, instead of ratios");
    app.add_option("--only", options->only, "measure only ratios whose name, or tables whose title, contains this text");
    app.add_option("--frame", options->frame, "index of the frame, default 0")->needs(capture);
    app.add_option("--size", options->size,
                   "extent of the scenarios as WIDTHxHEIGHT; default 320x180 on a CPU device, else 1920x1080")
        ->excludes(capture);
    app.add_option("--repeats", options->repeats, "timed repeats of each side of a ratio after a warm-up, default 7")
        ->check(from_to(1, 1000));
    add_formats(app, options->output);
    add_output_file(app, options->output, "also write to this file, in the format of its ending: .json, .csv, .md or .txt");
    return [options] { return bench(*options); };
}

}  // namespace strata
