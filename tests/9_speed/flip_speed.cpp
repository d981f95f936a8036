// FLIP of radiance at 1920 x 1080 against the straightforward version in double, in turn: the ratio is what counts.
#include <chrono>
#include <cmath>

#include <benchmark/benchmark.h>

#include "replay/measure/timing.h"
#include "tests/support/plain_flip.h"

namespace strata {
namespace {

/// Waves, edges and points of light over six stops, as much as the reference program's Desk has.
ColorPlanes scene(double shift) {
    ColorPlanes planes{1920, 1080, {}, {}};
    for (std::uint32_t y = 0; y < planes.height; ++y)
        for (std::uint32_t x = 0; x < planes.width; ++x) {
            const double wave = .5 + .5 * std::sin(.013 * (x + shift)) * std::cos(.017 * y),
                         edge = (x / 64 + y / 64) % 2 ? 1 : .5;
            const double light = .2 + 6 * wave * wave * edge + (x % 97 == 0 && y % 89 == 0 ? 30 : 0);
            for (std::size_t c = 0; c < 3; ++c) planes.rgb[c].push_back(static_cast<float>(light * (c == y / 270 % 3 ? .6 : 1)));
        }
    return planes;
}

template <typename Work>
double milliseconds_taken(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    benchmark::DoNotOptimize(work());
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

void radiance_flip_against_plain(benchmark::State& state) {
    const ColorPlanes a = scene(0), b = scene(.7);
    const ExposureRange range = exposures_of(a, b);
    std::vector<double> fast, plain, ratios;
    for (auto _ : state) {
        fast.push_back(milliseconds_taken([&] { return radiance_flip(a, b); }));
        plain.push_back(milliseconds_taken([&] { return plain_radiance_flip(a, b, range); }));
        ratios.push_back(plain.back() / fast.back());
    }
    const Spread ratio = spread_of(ratios);
    state.counters["exposures"] = range.count;
    state.counters["fast_ms"] = spread_of(fast).median;
    state.counters["plain_ms"] = spread_of(plain).median;
    state.counters["times_as_fast"] = ratio.median;
    state.counters["lowest"] = ratio.low;
    state.counters["highest"] = ratio.high;
}
BENCHMARK(radiance_flip_against_plain)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace strata
