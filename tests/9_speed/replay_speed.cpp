// From a frame to a picture: records, declaration, plan, and whole replays on the first device (lavapipe where there is no GPU).
#include <benchmark/benchmark.h>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/declaration.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view whole_frame = "glass_and_smoke";  // needs more stages than any other scenario
constexpr std::string_view small_frame = "three_panes";      // one that every transparency technique can do

void make_scene_records(benchmark::State& state) {
    const Frame frame = scenario_frames("smoke_grenade").front();
    for (auto _ : state) {
        const SceneFacts facts(frame);  // with what they are made of
        benchmark::DoNotOptimize(scene_records(facts));
    }
}
BENCHMARK(make_scene_records)->Unit(benchmark::kMillisecond);

/// A loaded frame with its scene on a device.
struct Loaded {
    std::unique_ptr<Device> device = must(Device::open({}));
    std::unique_ptr<Executor> executor = Executor::create(*device);
    DeviceScene scene{*executor};
    std::unique_ptr<LoadedFrame> frame = must(load_frame(scenario_frames(whole_frame).front(), {}));

    Loaded() { scene.upload(scene_records(frame->facts)); }
    Sources sources() const { return {*frame, scene, device->info(), ShaderLibrary::built_in()}; }
};

void declare_a_frame(benchmark::State& state) {
    const Loaded loaded;
    const Choices choices = must(choose(loaded.frame->frame));
    for (auto _ : state) {
        Graph graph;
        FrameImages images{.recorded = &loaded.frame->frame,
                           .features = &loaded.frame->features,
                           .facts = &loaded.frame->facts,
                           .extent = {loaded.frame->frame.view.width, loaded.frame->frame.view.height, 1},
                           .samples = loaded.frame->frame.view.samples};
        loaded.scene.import_into(graph, images);
        benchmark::DoNotOptimize(must(declare_frame(graph, images, choices, loaded.device->info().capabilities)));
    }
}
BENCHMARK(declare_a_frame)->Unit(benchmark::kMicrosecond);

void compile_a_frame(benchmark::State& state) {
    const Loaded loaded;
    const Declaration declared = must(declare({}, loaded.sources(), Keep::outputs));
    for (auto _ : state) benchmark::DoNotOptimize(must(compile(declared.graph, ShaderLibrary::built_in())));
    state.counters["steps"] = static_cast<double>(declared.plan.steps.size());
}
BENCHMARK(compile_a_frame)->Unit(benchmark::kMicrosecond);

/// Every step again and the picture read back; pipelines stand.
void replay(benchmark::State& state, const Technique& technique) {
    const auto session = must(Session::open(scenario_frames(small_frame), {}));
    const Request request{.choices = chosen({std::string(technique.name)})};
    must(session->run(request));
    for (auto _ : state) {
        session->forget_memo();
        benchmark::DoNotOptimize(must(session->run(request)));
    }
    state.SetLabel(session->device().name);
}

const bool replays_are_listed = [] {
    for (const Technique* technique : techniques_of(Stage::transparency))
        benchmark::RegisterBenchmark(fmt::format("replay/{}", technique->name).c_str(),
                                     [technique](benchmark::State& state) { replay(state, *technique); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
    return true;
}();

}  // namespace
}  // namespace strata
