// What the program costs around the rendering: from its start to the first picture, a report beside single replays, and a replay
// beside that of its own calls by gfxrecon-replay, where GFXReconstruct is installed. Every figure is a median over processes
// with its deviation; both sides of a ratio are measured in turn.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include "capture_format/recorder.h"
#include "consumer/engine.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/gpu/host_timer.h"
#include "replay/measure/timing.h"
#include "tests/support/session.h"

namespace strata {
namespace {

/// The recording of the consumer in tests/1_capture/consumer: 60 frames of 2000 draws.
constexpr std::string_view crowd = "crowd";

/// A folder with the crowd's capture, or with that of a scenario's first frame; gone afterwards.
class Scratch {
public:
    explicit Scratch(std::string_view scene) {
        std::filesystem::create_directories(folder_);
        Recorder recorder = must(Recorder::create(capture()));
        if (scene == crowd) {
            record_crowd(std::move(recorder));
        } else {
            must(recorder.record(scenario_frames(scene).front()));
            must(recorder.finish());
        }
    }
    ~Scratch() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    std::filesystem::path capture() const { return folder_ / "frame.strata"; }
    /// Milliseconds from the start of the program to its end; throws when it fails.
    double run(const std::string& arguments) const { return run_command(strata(arguments)); }
    static std::string strata(const std::string& arguments) {
        return fmt::format("'{}/strata' {}", STRATA_BINARY_DIR, arguments);
    }
    /// The same of any command, in the folder.
    double run_command(const std::string& command) const {
        const std::string there = fmt::format("cd '{}' && {} > out.txt 2> err.txt", folder_.string(), command);
        HostTimer timer;
        if (std::system(there.c_str()) != 0) throw std::runtime_error("failed: " + command);
        return timer();
    }

private:
    static void record_crowd(Recorder recorder) {
        consumer::Engine engine(consumer::Motion::straight, consumer::Pace::even, consumer::Drawing::none);
        consumer::Recording recording(std::move(recorder), engine.crowd());
        for (int frame = 0; frame < 60; ++frame) must(engine.frame(&recording));
        must(recording.recorder().finish());
    }

    std::filesystem::path folder_ = std::filesystem::temp_directory_path() / fmt::format("strata_speed.{}", getpid());
};

/// What the process itself took to render its frame, from the JSON that it leaves beside the picture.
double rendering_ms(const std::filesystem::path& json) {
    std::ifstream file(json);
    return nlohmann::json::parse(file).at("host_ms").at("render").get<double>();
}

/// Until the picture lies in the folder; what is written after it is not waited for.
void start_to_first_picture(benchmark::State& state, std::string_view scene) {
    const Scratch scratch(scene);
    const std::string replay = "replay frame.strata --frames 0 --outputs display -o out";
    scratch.run(replay);  // fills the driver's shader cache
    std::vector<double> whole, rendering, rest;
    for (auto _ : state) {
        const auto start = std::filesystem::file_time_type::clock::now();
        scratch.run(replay);
        const std::filesystem::path out = scratch.capture().parent_path() / "out";
        const std::chrono::duration<double, std::milli> time = last_write_time(out / "frame.f0000.png") - start;
        whole.push_back(time.count());
        rendering.push_back(rendering_ms(out / "frame.f0000.json"));
        rest.push_back(whole.back() - rendering.back());
        state.SetIterationTime(whole.back() / 1000);
    }
    for (const auto& [name, values] : {std::pair("picture", &whole), {"rendering", &rendering}, {"rest", &rest}}) {
        const Spread spread = spread_of(*values);
        state.counters[fmt::format("{}_ms", name)] = spread.median;
        state.counters[fmt::format("{}_mad", name)] = spread.mad;
    }
}
BENCHMARK_CAPTURE(start_to_first_picture, crowd, crowd)->UseManualTime()->Iterations(31)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start_to_first_picture, city_of_boxes, "city_of_boxes")
    ->UseManualTime()
    ->Iterations(31)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(start_to_first_picture, glass_and_smoke, "glass_and_smoke")
    ->UseManualTime()
    ->Iterations(31)
    ->Unit(benchmark::kMillisecond);

/// The calls of a replay of ours, recorded by the layer of GFXReconstruct, are replayed by its program.
void replay_beside_gfxrecon(benchmark::State& state, std::string_view scene) {
    if (std::system("gfxrecon-replay --version > /dev/null 2>&1") != 0)
        return state.SkipWithError("gfxrecon-replay is not installed");
    const Scratch scratch(scene);
    const std::string ours = Scratch::strata("replay frame.strata"), theirs = "gfxrecon-replay frame.gfxr";
    scratch.run_command(
        "env VK_INSTANCE_LAYERS=VK_LAYER_LUNARG_gfxreconstruct GFXRECON_CAPTURE_FILE=frame.gfxr "
        "GFXRECON_CAPTURE_FILE_TIMESTAMP=false " +
        ours);
    if (!exists(scratch.capture().parent_path() / "frame.gfxr"))
        return state.SkipWithError("the layer of GFXReconstruct is not found");
    scratch.run_command(theirs);  // fills the driver's shader cache with what the layer changed
    std::vector<double> ratio;
    for (auto _ : state) {
        const double by_us = scratch.run_command(ours), by_them = scratch.run_command(theirs);
        ratio.push_back(by_us / by_them);
        state.SetIterationTime(by_us / 1000);
    }
    const Spread spread = spread_of(ratio);
    state.counters["to_gfxrecon"] = spread.median;
    state.counters["mad"] = spread.mad;
}
BENCHMARK_CAPTURE(replay_beside_gfxrecon, smoke_grenade, "smoke_grenade")
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(replay_beside_gfxrecon, city_of_boxes, "city_of_boxes")
    ->UseManualTime()
    ->Iterations(15)
    ->Unit(benchmark::kMillisecond);

/// Twelve settings of transparency: every technique, and one parameter swept to fill up.
struct Settings12 {
    std::string sweep;
    std::vector<std::string> replays;

    Settings12() {
        const Technique* swept = nullptr;
        const Param* param = nullptr;
        for (const Technique* technique : techniques_of(Stage::transparency)) {
            const auto is_number = [](const Param& p) { return p.choices.empty() && p.high / 2 > p.low; };
            const auto found = std::ranges::find_if(technique->params, is_number);
            if (found != technique->params.end()) swept = technique, param = &*found;
        }
        if (!swept) throw std::runtime_error("no technique of transparency has a number to sweep");
        sweep = fmt::format("{}=", param->name);
        for (const Technique* technique : techniques_of(Stage::transparency))
            if (technique != swept) replays.push_back(fmt::format("--use {}", technique->name));
        for (double value = param->fallback; replays.size() < 12; value *= 1.01) {
            sweep += fmt::format("{}{}", sweep.ends_with('=') ? "" : ",", value);
            replays.push_back(fmt::format("--use {} --set {}={}", swept->name, param->name, value));
        }
    }
};

/// A report whose rows are run `repeats` times, beside replays that are given `timed` to measure as much.
void report_against_replays(benchmark::State& state, int repeats, const char* timed) {
    const Scratch scratch("glass_and_smoke");
    const Settings12 settings;
    const std::string report = fmt::format("report frame.strata --repeats {} --sweep {} --json", repeats, settings.sweep);
    scratch.run(report);
    std::vector<double> ratio;
    for (auto _ : state) {
        const double reported = scratch.run(report);
        double replayed = 0;
        for (const std::string& use : settings.replays)
            replayed += scratch.run(fmt::format("replay frame.strata {} {}", use, timed));
        ratio.push_back(reported / replayed);
        state.SetIterationTime(reported / 1000);
    }
    const Spread spread = spread_of(ratio);
    state.counters["report_to_12_replays"] = spread.median;
    state.counters["mad"] = spread.mad;
}
BENCHMARK_CAPTURE(report_against_replays, timed, 7, "--time 7")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(report_against_replays, untimed, 1, "")->UseManualTime()->Iterations(5)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strata
