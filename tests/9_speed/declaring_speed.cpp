// Declaring a frame of a million vertices. Nothing of a declaration may walk them: what a frame says is derived once, when it is
// loaded or first asked for, and declaring it again costs as much as it has draws.
#include <benchmark/benchmark.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/session/declaration.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t side = 707;  // 707 x 707 vertices are half a million

/// A square of 20 m that faces the eye of the scenario from beyond what it shows.
Mesh fine_square() {
    Mesh mesh{.name = "fine square"};
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            mesh.positions.emplace_back(20.f * float(x) / side - 10, 20.f * float(y) / side - 10, 0.f);
            mesh.normals.emplace_back(0.f, 0.f, 1.f);
        }
    for (std::uint32_t y = 0; y + 1 < side; ++y)
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
            for (const std::uint32_t corner : {a, b, c, b, d, c}) mesh.indices.push_back(corner);
        }
    return mesh;
}

/// A whole frame with two such squares: one casts shadows, one is transparent.
Frame million_vertices() {
    Frame frame = scenario_frames("glass_and_smoke").front();
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::blend}) {
        const auto index = static_cast<std::uint32_t>(frame.meshes.size());
        frame.meshes.push_back(fine_square());
        Material material{.name = "fine"};
        material.alpha_mode = mode;
        frame.materials.push_back(material);
        Draw draw{.name = "fine", .mesh = index, .material = static_cast<std::uint32_t>(frame.materials.size() - 1)};
        draw.to_world[3] = glm::dvec4(frame.view.origin + glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 30), 1);
        draw.previous_to_world = draw.to_world;
        frame.draws.push_back(draw);
    }
    return frame;
}

/// As a session declares a frame it has loaded and declared before: without the memo, which declares twice.
void declare_a_million_vertices(benchmark::State& state, std::string_view technique) {
    const auto device = must(Device::open({}));
    const auto executor = Executor::create(*device);
    DeviceScene scene(*executor);
    const std::unique_ptr<LoadedFrame> loaded = must(load_frame(million_vertices(), {}));
    scene.describe(scene_records(loaded->facts));
    const Request request{.choices = chosen({std::string(technique)})};
    const Sources sources{*loaded, scene, device->info(), ShaderLibrary::built_in()};
    benchmark::DoNotOptimize(must(declare(request, sources, Keep::outputs)));
    for (auto _ : state) benchmark::DoNotOptimize(must(declare(request, sources, Keep::outputs)));
}

const bool declarations_are_listed = [] {
    for (const Technique* technique : techniques_of(Stage::transparency))
        benchmark::RegisterBenchmark(fmt::format("declare_a_million_vertices/{}", technique->name).c_str(),
                                     [technique](benchmark::State& state) { declare_a_million_vertices(state, technique->name); })
            ->Unit(benchmark::kMillisecond);
    return true;
}();

void records_of_a_million_vertices(benchmark::State& state) {
    const std::unique_ptr<LoadedFrame> loaded = must(load_frame(million_vertices(), {}));
    for (auto _ : state) {
        const SceneFacts facts(loaded->frame);
        benchmark::DoNotOptimize(scene_records(facts));
    }
}
BENCHMARK(records_of_a_million_vertices)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strata
