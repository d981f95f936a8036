// An engine that knows nothing of Strata but its recorder: renders a crowd of boxes, records it, says what that cost.
// 0 frames go on until the process is killed; --report prints after every frame how many are in the file.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include "consumer/engine.h"

namespace {

using namespace consumer;

constexpr std::string_view usage =
    "consumer [--frames N] [--output FILE] [--no-record] [--no-render] [--budget BYTES] [--spin] [--uneven] [--report]";

struct Options {
    std::uint64_t frames = 60;
    std::string output = "consumer.strata";
    strata::RecorderOptions recorder;
    Motion motion = Motion::straight;
    Pace pace = Pace::even;
    Drawing drawing = Drawing::rasterized;
    bool record = true, report = false;
};

std::optional<Options> parse(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string_view word = words[i];
        if (word == "--no-record") {
            options.record = false;
        } else if (word == "--no-render") {
            options.drawing = Drawing::none;
        } else if (word == "--report") {
            options.report = true;
        } else if (word == "--spin") {
            options.motion = Motion::spinning;
        } else if (word == "--uneven") {
            options.pace = Pace::uneven;
        } else if (word == "--frames" && i + 1 < count) {
            options.frames = std::strtoull(words[++i], nullptr, 10);
        } else if (word == "--budget" && i + 1 < count) {
            options.recorder.budget_bytes = std::strtoull(words[++i], nullptr, 10);
        } else if (word == "--output" && i + 1 < count) {
            options.output = words[++i];
        } else {
            return std::nullopt;
        }
    }
    return options;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

/// The most memory the process had, as the system tells it.
std::string peak_memory() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("VmHWM:")) return line.substr(6);
    return " unknown";
}

int failed(const strata::Error& error) {
    std::fprintf(stderr, "consumer: %s (%s)\n", error.sentence.c_str(), std::string(error.id.text()).c_str());
    return static_cast<int>(error.fault);
}

int run(const Options& options) {
    Engine engine(options.motion, options.pace, options.drawing);
    std::optional<Recording> recording;
    if (options.record) {
        auto recorder = strata::Recorder::create(options.output, "a consumer's crowd", options.recorder);
        if (!recorder) return failed(recorder.error());
        recording.emplace(*std::move(recorder), engine.crowd());
    }
    for (std::uint64_t frame = 0; options.frames == 0 || frame < options.frames; ++frame) {
        if (const auto done = engine.frame(recording ? &*recording : nullptr); !done) return failed(done.error());
        if (!options.report || !recording) continue;
        std::printf("%llu\n", static_cast<unsigned long long>(recording->recorder().frames_written()));
        std::fflush(stdout);
    }
    if (recording)
        if (const auto done = recording->recorder().finish(); !done) return failed(done.error());
    const double frame_ms = median(engine.frame_ms), recording_ms = median(engine.recording_ms);
    std::printf("%zu frames, median %.2f ms, of it %.3f ms (%.1f %%) recording\n", engine.frame_ms.size(), frame_ms, recording_ms,
                100 * recording_ms / frame_ms);
    if (recording) std::printf("waited for the budget: %.3f s\n", recording->recorder().load().waited_s);
    std::printf("peak memory:%s\n", peak_memory().c_str());
    return 0;
}

}  // namespace

int main(int count, char** words) {
    if (const std::optional<Options> options = parse(count, words)) return run(*options);
    std::fprintf(stderr, "%s\n", usage.data());
    return 2;
}
