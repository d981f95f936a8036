// strata bench: the ratios of times that a technique states, measured on this device; or the device itself.
#include "replay/bench/bench.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/nearest_name.h"
#include "captures/scenarios.h"
#include "passes/registry.h"
#include "replay/bench/device_bench.h"
#include "replay/cli/given_options.h"
#include "replay/cli/left_out.h"
#include "replay/cli/verb_options.h"
#include "replay/progress_line.h"
#include "replay/report/variants.h"
#include "replay/session/choice_text.h"

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
    bool json = false;
    std::filesystem::path output;
};

/// Ratios of the technique of that name, with or without its stage. `only` is in their names.
Result<std::vector<Claim>> claims_of(const std::string& word, const std::string& only) {
    std::vector<Claim> claims;
    std::vector<std::string_view> known{the_device}, stating, names;
    bool found = false;
    for (const Technique& technique : techniques()) {
        known.insert(known.end(), {technique.name, short_name(technique)});
        if (!technique.claims.ratios.empty()) stating.push_back(technique.name);
        if (technique.name != word && short_name(technique) != word) continue;
        found = true;
        for (const TimeRatio& ratio : technique.claims.ratios) {
            names.push_back(ratio.name);
            if (ratio.name.find(only) != ratio.name.npos) claims.push_back({.technique = &technique, .ratio = &ratio});
        }
    }
    if (!found) return fail_unnamed(Fault::usage, "no technique {}{}", word, did_you_mean(word, known));
    if (names.empty())
        return fail_unnamed(Fault::usage, "{} lists no ratios to measure; these techniques do: {}", word,
                            fmt::join(stating, ", "));
    if (claims.empty())
        return fail_unnamed(Fault::usage, "no ratio of {} has '{}' in its name; its ratios: {}", word, only,
                            fmt::join(names, "; "));
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

Result<std::unique_ptr<Session>> open_capture(const BenchArguments& options, std::span<Claim> claims) {
    for (Claim& claim : claims) {
        claim.scene = options.open.capture.filename().string();
        claim.base.variant.frame = options.frame;
    }
    return open(options.open);
}

template <typename Bench>
Result<void> print(const BenchArguments& options, const Bench& made) {
    to_stdout("{}", options.json ? as_json(made) : as_text(made));
    if (!options.output.empty())
        if (const auto done = write_whole_file(options.output, as_json(made)); !done) return done;
    return made.stopped.empty() ? Result<void>() : fail_unnamed(Fault::stopped, "{}", made.stopped);
}

Result<void> bench_the_device(const BenchArguments& options) {
    if (!options.only.empty()) return fail_unnamed(Fault::usage, "--only selects ratios of a technique; 'device' has none");
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
    return print(options, *made);
}

Result<void> bench(const BenchArguments& options) {
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
        const auto way = variant_of(*claim.technique, claim.ratio->of, claim.base);
        if (way) static_cast<void>(notes.tell(**session, way->request, base->choices));  // its row will say why it has no plan
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
                   "technique, with or without its stage; or 'device': bytes and operations of the slowest steps, relative to "
                   "what the device can do")
        ->required();
    CLI::Option* capture =
        app.add_option("capture", options->open.capture,
                       "capture to measure on; default: a scenario chosen for each ratio, smoke_grenade for the device")
            ->type_name(input_file);
    add_options(app, options->open.device);
    app.add_flag("--allow-partial", options->open.allow_partial, "read the complete frames of a truncated file")->needs(capture);
    add_options(app, options->choices);
    app.add_option("--only", options->only, "measure only ratios whose name contains this text");
    app.add_option("--frame", options->frame, "index of the frame, default 0")->needs(capture);
    app.add_option("--size", options->size,
                   "extent of the scenarios as WIDTHxHEIGHT; default 320x180 on a CPU device, else 1920x1080")
        ->excludes(capture);
    app.add_option("--repeats", options->repeats, "timed repeats of each side of a ratio after a warm-up, default 7")
        ->check(from_to(1, 1000));
    app.add_flag("--json", options->json, "print JSON instead of text");
    app.add_option("-o,--output", options->output, "write the JSON to this file, too")->type_name(output_file);
    return [options] { return bench(*options); };
}

}  // namespace strata
