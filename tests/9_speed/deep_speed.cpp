// Flattening a deep image of 10 million fragments: ours beside OpenEXR's CompositeDeepScanLine, in turn, each with every core.
// Importing and exporting a million samples: the program beside `oiiotool --flatten` of the same image, where it is installed.
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <thread>

#include <ImfThreading.h>
#include <benchmark/benchmark.h>

#include "capture_format/container/file.h"
#include "capture_format/container/whole_file.h"
#include "replay/deep/deep_image.h"
#include "replay/deep/flatten_deep.h"
#include "replay/measure/timing.h"
#include "tests/support/deep_exr.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t width = 1000, height = 500, per_pixel = 20;

/// As `strata export --deep` writes them: sorted, floats, ZIPS. Thin layers of any color, so that every one counts.
DeepImage ten_million_fragments() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    DeepImage image{.width = width, .channels = {"A", "B", "G", "R", "Z"}, .lines = std::vector<DeepLine>(height)};
    constexpr std::size_t samples = std::size_t{width} * per_pixel;
    for (DeepLine& line : image.lines) {
        line.values.resize(samples * image.channels.size());
        for (std::uint32_t begin = 0; begin < samples; begin += per_pixel) {
            float depth = 1;
            for (std::uint32_t i = begin; i < begin + per_pixel; ++i) {
                const float alpha = .2f * unit(random);
                depth += unit(random);
                line.values[i] = alpha;
                for (std::size_t c = 1; c <= 3; ++c) line.values[c * samples + i] = alpha * unit(random);
                line.values[4 * samples + i] = depth;
            }
            line.ends.push_back(begin + per_pixel);
        }
    }
    return image;
}

/// The file, gone afterwards.
struct ScratchImage {
    std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("speed.{}.exr", getpid());
    ScratchImage() { must(write_whole_file(path, must(deep_exr(ten_million_fragments(), {})))); }
    ~ScratchImage() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
};

template <typename Run>
double milliseconds(const Run& run) {
    const auto begin = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

/// Largest difference of a channel.
double worst_difference(const FlatDeep& ours, const std::vector<glm::vec4>& theirs) {
    double worst = 0;
    for (std::uint32_t i = 0; i < width * height; ++i) {
        const glm::dvec4 off = glm::abs(texel(ours.image, i % width, i / width) - glm::dvec4(theirs[i]));
        worst = std::max({worst, off.x, off.y, off.z, off.w});
    }
    return worst;
}

void flatten_ten_million_fragments(benchmark::State& state) {
    const ScratchImage file;
    Imf::setGlobalThreadCount(static_cast<int>(std::thread::hardware_concurrency()));
    std::vector<double> ours, theirs, ratios;
    for (auto _ : state) {
        FlatDeep flat;
        std::vector<glm::vec4> composite;
        ours.push_back(milliseconds([&] {
            const ReadableFile opened = must(ReadableFile::open(file.path));
            flat = must(flatten_deep(must(opened.read(0, opened.size())), "ten million"));
        }));
        theirs.push_back(milliseconds([&] { composite = openexr_composite(file.path).texels; }));
        ratios.push_back(theirs.back() / ours.back());
        // 20 sums of numbers up to .2, in float there: 20 roundings of 2^-24 and as many of its alpha.
        if (const double off = worst_difference(flat, composite); off > 1e-5)
            return state.SkipWithError(fmt::format("the two differ by {}", off).c_str());
    }
    const Spread our_ms = spread_of(ours), their_ms = spread_of(theirs), ratio = spread_of(ratios);
    state.counters["ours_ms"] = our_ms.median;
    state.counters["ours_mad"] = our_ms.mad;
    state.counters["openexr_ms"] = their_ms.median;
    state.counters["openexr_mad"] = their_ms.mad;
    state.counters["ratio"] = ratio.median;
    state.counters["ratio_mad"] = ratio.mad;
}
/// Runs a command of the shell in a folder; false when it fails.
bool succeeds(const std::filesystem::path& folder, const std::string& command) {
    return std::system(fmt::format("cd '{}' && {} > out.txt 2>&1", folder.string(), command).c_str()) == 0;
}

/// What a command takes beside `oiiotool --flatten` of smoke.exr, in turn.
void time_beside_oiiotool(benchmark::State& state, const std::filesystem::path& folder, const std::string& command) {
    const std::string flatten = "oiiotool smoke.exr --flatten -d float -o flat.exr";
    std::vector<double> ours, ratios;
    for (auto _ : state) {
        bool done = true;
        ours.push_back(milliseconds([&] { done = succeeds(folder, command); }));
        ratios.push_back(ours.back() / milliseconds([&] { done = succeeds(folder, flatten) && done; }));
        if (!done) return state.SkipWithError(("failed: " + command).c_str());
    }
    const Spread our_ms = spread_of(ours), ratio = spread_of(ratios);
    state.counters["ours_ms"] = our_ms.median;
    state.counters["ours_mad"] = our_ms.mad;
    state.counters["to_oiiotool"] = ratio.median;
    state.counters["to_oiiotool_mad"] = ratio.mad;
}

/// The scenario smoke_grenade at 320 x 180 as a capture and as a deep image of 974,367 samples, in a folder of its own.
class DeepScratch {
public:
    DeepScratch() {
        std::filesystem::create_directories(folder);
        ready = succeeds(folder, "oiiotool --version") && succeeds(folder, strata("record smoke_grenade -o smoke.strata")) &&
                succeeds(folder, strata(std::string(exporting)));
    }
    ~DeepScratch() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    static std::string strata(const std::string& arguments) {
        return fmt::format("'{}/strata' {}", STRATA_BINARY_DIR, arguments);
    }

    static constexpr std::string_view exporting = "export smoke.strata --deep -o smoke.exr";
    std::filesystem::path folder = std::filesystem::temp_directory_path() / fmt::format("deep_speed.{}", getpid());
    bool ready = false;  ///< false also where oiiotool is not installed
};

void export_beside_oiiotool(benchmark::State& state) {
    const DeepScratch scratch;
    if (!scratch.ready) return state.SkipWithError("oiiotool is not installed, or the image was not made");
    time_beside_oiiotool(state, scratch.folder, DeepScratch::strata(std::string(DeepScratch::exporting)));
}
BENCHMARK(export_beside_oiiotool)->Iterations(9)->Unit(benchmark::kMillisecond)->UseRealTime();

void import_beside_oiiotool(benchmark::State& state) {
    const DeepScratch scratch;
    if (!scratch.ready) return state.SkipWithError("oiiotool is not installed, or the image was not made");
    time_beside_oiiotool(state, scratch.folder, DeepScratch::strata("import --deep smoke.exr -o imported.strata"));
    const auto bytes = [&](const char* name) { return double(std::filesystem::file_size(scratch.folder / name)); };
    state.counters["bytes_to_exr"] = bytes("imported.strata") / bytes("smoke.exr");
}
BENCHMARK(import_beside_oiiotool)->Iterations(9)->Unit(benchmark::kMillisecond)->UseRealTime();

BENCHMARK(flatten_ten_million_fragments)->Iterations(9)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace strata
