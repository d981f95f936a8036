// A frame to disk and back, and what it contains.
#include <unistd.h>

#include <filesystem>

#include <benchmark/benchmark.h>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const Frame& smoke() {
    static const Frame frame = scenario_frames("smoke_grenade").front();
    return frame;
}

/// A capture that is gone afterwards.
struct ScratchCapture {
    std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("speed.{}.strata", getpid());
    ~ScratchCapture() {
        std::error_code ignored;
        std::filesystem::remove(path, ignored);
    }
    bool record() const {
        Recorder recorder = must(Recorder::create(path));
        return recorder.record(smoke()) && recorder.finish();
    }
};

void record_a_frame(benchmark::State& state) {
    const ScratchCapture file;
    for (auto _ : state)
        if (!file.record()) return state.SkipWithError("cannot write the capture");
    state.counters["file_bytes"] = static_cast<double>(std::filesystem::file_size(file.path));
}
BENCHMARK(record_a_frame)->Unit(benchmark::kMillisecond);

void read_a_frame(benchmark::State& state) {
    const ScratchCapture file;
    if (!file.record()) return state.SkipWithError("cannot write the capture");
    for (auto _ : state) {
        const Capture capture = must(Capture::open(file.path));
        benchmark::DoNotOptimize(must(capture.frame(0)));
    }
}
BENCHMARK(read_a_frame)->Unit(benchmark::kMillisecond);

void find_features(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(frame_features(smoke()));
}
BENCHMARK(find_features)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace strata
