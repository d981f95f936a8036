// The references in double: what a test of a technique waits for.
#include <atomic>

#include <benchmark/benchmark.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Frame smoke(const benchmark::State& state) {
    return scenario_frames("smoke_grenade", static_cast<std::uint32_t>(state.range(0))).front();
}

void rasterize_smoke(benchmark::State& state) {
    const Frame frame = smoke(state);
    const std::vector<std::uint32_t> draws = transparent_draws(frame);
    std::uint64_t points = 0;
    for (auto _ : state) {
        std::atomic<std::uint64_t> visited = 0;
        rasterize(frame, draws, {}, [&](const RasterPoint&) { visited.fetch_add(1, std::memory_order_relaxed); });
        points = visited;
    }
    state.counters["fragments"] = static_cast<double>(points);
}
BENCHMARK(rasterize_smoke)->ArgName("samples")->Arg(1)->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

void shade_fragments_of_smoke(benchmark::State& state) {
    const Frame frame = smoke(state);
    const ReferenceImage nothing_opaque(frame.view.width, frame.view.height, frame.view.samples);
    std::uint64_t fragments = 0;
    for (auto _ : state) fragments = transparent_fragments(frame, nothing_opaque).total();
    state.counters["fragments"] = static_cast<double>(fragments);
}
BENCHMARK(shade_fragments_of_smoke)->ArgName("samples")->Arg(1)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace strata
