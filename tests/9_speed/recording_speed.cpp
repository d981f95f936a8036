// What recording costs an engine: the consumer of tests/1_capture/consumer, its frames with and without a recorder. Whole runs
// alternate, because the recorder's thread works on while the next frame is drawn; the ratio is that of two neighboring runs.
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include <benchmark/benchmark.h>

#include "capture_format/reader.h"
#include "consumer/engine.h"
#include "passes/frame_images.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using consumer::Drawing;
using consumer::Engine;
using consumer::Motion;
using consumer::Pace;

constexpr int frames = 60, pairs = 31;

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

/// Median absolute deviation.
double spread(std::vector<double> values) {
    const double middle = median(values);
    for (double& value : values) value = std::abs(value - middle);
    return median(values);
}

struct Run {
    double frame_ms = 0, recording_ms = 0;  ///< medians over its frames
    double whole_ms = 0;                    ///< with the end of the recording
    double cpu_ms = 0;                      ///< of the drawing thread alone: comparable on a machine that does other things, too
};

double thread_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

Run run(Motion motion, Pace pace, const std::filesystem::path& path) {
    const auto start = std::chrono::steady_clock::now();
    Engine engine(motion, pace, Drawing::rasterized);
    std::optional<consumer::Recording> recording;
    if (!path.empty()) recording.emplace(must(Recorder::create(path)), engine.crowd());
    const double cpu_before = thread_ms();
    for (int frame = 0; frame < frames; ++frame) (void)engine.frame(recording ? &*recording : nullptr);
    const double cpu_ms = thread_ms() - cpu_before;
    if (recording) (void)recording->recorder().finish();
    const std::chrono::duration<double, std::milli> whole = std::chrono::steady_clock::now() - start;
    return {median(engine.frame_ms), median(engine.recording_ms), whole.count(), cpu_ms};
}

void record_an_engine(benchmark::State& state, Motion motion, Pace pace) {
    const std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("engine.{}.strata", getpid());
    std::vector<double> alone, recorded, ratios, whole_ratios, cpu_ratios, recording;
    for (auto _ : state) {
        for (int pair = 0; pair < pairs; ++pair) {
            // Which of the two goes first alternates as well.
            const Run first = run(motion, pace, pair % 2 ? path : ""), second = run(motion, pace, pair % 2 ? "" : path);
            const Run &without = pair % 2 ? second : first, &with = pair % 2 ? first : second;
            alone.push_back(without.frame_ms);
            recorded.push_back(with.frame_ms);
            ratios.push_back(with.frame_ms / without.frame_ms);
            whole_ratios.push_back(with.whole_ms / without.whole_ms);
            cpu_ratios.push_back(with.cpu_ms / without.cpu_ms);
            recording.push_back(with.recording_ms);
        }
    }
    state.counters["frame_ms"] = median(alone);
    state.counters["recorded_ms"] = median(recorded);
    state.counters["calls_ms"] = median(recording);
    state.counters["ratio"] = median(ratios);
    state.counters["ratio_mad"] = spread(ratios);
    state.counters["cpu_ratio"] = median(cpu_ratios);
    state.counters["cpu_ratio_mad"] = spread(cpu_ratios);
    state.counters["whole_ratio"] = median(whole_ratios);
    state.counters["file_bytes"] = static_cast<double>(std::filesystem::file_size(path));
    std::filesystem::remove(path);
}
BENCHMARK_CAPTURE(record_an_engine, straight, Motion::straight, Pace::even)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(record_an_engine, spinning, Motion::spinning, Pace::even)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(record_an_engine, straight_uneven, Motion::straight, Pace::uneven)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(record_an_engine, spinning_uneven, Motion::spinning, Pace::uneven)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

/// The crowd's 60 frames in a file.
struct CrowdFile {
    std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("crowd.{}.strata", getpid());
    CrowdFile() { run(Motion::straight, Pace::even, path); }
    ~CrowdFile() { std::filesystem::remove(path); }
};

void read_sixty_frames_in_order(benchmark::State& state) {
    const CrowdFile file;
    for (auto _ : state) {
        const Capture capture = must(Capture::open(file.path));
        for (std::size_t i = 0; i < capture.frame_count(); ++i) benchmark::DoNotOptimize(must(capture.frame(i)));
    }
}
BENCHMARK(read_sixty_frames_in_order)->Unit(benchmark::kMillisecond);

void read_the_frame_farthest_from_a_key(benchmark::State& state) {
    const CrowdFile file;
    for (auto _ : state) {
        const Capture capture = must(Capture::open(file.path));
        benchmark::DoNotOptimize(must(capture.frame(frames - 1)));
    }
}
BENCHMARK(read_the_frame_farthest_from_a_key)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace strata
