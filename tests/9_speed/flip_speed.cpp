// FLIP of radiance at 1920 x 1080 against the straightforward version in double, and against the reference program where it is on
// PATH, in turn: the ratio is what counts.
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <ImfArray.h>
#include <ImfRgbaFile.h>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

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

/// One part without a name, which every reader of EXR takes.
void write_halves(const std::filesystem::path& path, const ColorPlanes& planes) {
    Imf::Array2D<Imf::Rgba> texels(planes.height, planes.width);
    for (std::uint32_t y = 0; y < planes.height; ++y)
        for (std::uint32_t x = 0; x < planes.width; ++x) {
            const std::size_t at = std::size_t{y} * planes.width + x;
            texels[y][x] = Imf::Rgba(planes.rgb[0][at], planes.rgb[1][at], planes.rgb[2][at]);
        }
    Imf::RgbaOutputFile file(path.c_str(), static_cast<int>(planes.width), static_cast<int>(planes.height), Imf::WRITE_RGB);
    file.setFrameBuffer(&texels[0][0], 1, planes.width);
    file.writePixels(static_cast<int>(planes.height));
}

/// Two images, gone afterwards.
struct ScratchImages {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / fmt::format("flip_speed.{}", getpid());
    ScratchImages() {
        std::filesystem::create_directories(folder);
        write_halves(folder / "a.exr", scene(0));
        write_halves(folder / "b.exr", scene(.7));
    }
    ~ScratchImages() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    /// Exit status of a command in the folder.
    int run(const std::string& command) const {
        return std::system(fmt::format("cd '{}' && {} > out.txt 2>&1", folder.string(), command).c_str());
    }
};

/// Whole programs on the same files: both read them, and neither writes a picture.
void radiance_flip_against_the_reference_program(benchmark::State& state) {
    if (std::system("flip --help > /dev/null 2>&1") != 0) return state.SkipWithError("the program flip is not on PATH");
    const ScratchImages images;
    const std::string ours = fmt::format("'{}/strata' diff a.exr b.exr > said.txt; grep -qi flip said.txt", STRATA_BINARY_DIR);
    std::vector<double> our_ms, their_ms, ratios;
    for (auto _ : state) {
        int failed = 0;
        our_ms.push_back(milliseconds_taken([&] { return failed |= images.run(ours); }));
        their_ms.push_back(milliseconds_taken([&] { return failed |= images.run("flip -r a.exr -t b.exr -nexm -nerm"); }));
        if (failed != 0) return state.SkipWithError("one of the two programs failed");
        ratios.push_back(their_ms.back() / our_ms.back());
    }
    const Spread ratio = spread_of(ratios);
    state.counters["our_ms"] = spread_of(our_ms).median;
    state.counters["their_ms"] = spread_of(their_ms).median;
    state.counters["times_as_fast"] = ratio.median;
    state.counters["mad"] = ratio.mad;
}
BENCHMARK(radiance_flip_against_the_reference_program)->Iterations(5)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace strata
