// An engine that knows nothing of Strata but its recorder: renders a crowd of boxes, records it, says what that cost.
//   consumer [--frames N] [--output FILE] [--no-record] [--budget BYTES] [--spin] [--report]
// 0 frames go on until the process is killed; --report prints after every frame how many are in the file.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "consumer/rasterizer.h"
#include "consumer/recording.h"

namespace {

struct Options {
    std::uint64_t frames = 60;
    std::string output = "consumer.strata";
    strata::RecorderOptions recorder;
    consumer::Motion motion = consumer::Motion::straight;
    bool record = true, report = false;
};

std::optional<Options> parse(int count, char** words) {
    Options options;
    for (int i = 1; i < count; ++i) {
        const std::string_view word = words[i];
        const char* value = i + 1 < count ? words[i + 1] : "";
        if (word == "--no-record") options.record = false;
        else if (word == "--report") options.report = true;
        else if (word == "--spin") options.motion = consumer::Motion::spinning;
        else if (word == "--frames") options.frames = std::strtoull(value, nullptr, 10), ++i;
        else if (word == "--budget") options.recorder.budget_bytes = std::strtoull(value, nullptr, 10), ++i;
        else if (word == "--output") options.output = value, ++i;
        else return std::nullopt;
    }
    return options;
}

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

int failed(const strata::Error& error) {
    std::fprintf(stderr, "consumer: %s\n", error.sentence.c_str());
    return static_cast<int>(error.fault);
}

int run(const Options& options) {
    consumer::Crowd crowd(2000, options.motion);
    consumer::Rasterizer rasterizer;
    std::optional<consumer::Recording> recording;
    if (options.record) {
        auto recorder = strata::Recorder::create(options.output, "a consumer's crowd", options.recorder);
        if (!recorder) return failed(recorder.error());
        recording.emplace(*std::move(recorder), crowd);
    }
    std::vector<double> frame_ms, recording_ms;
    for (std::uint64_t frame = 0; options.frames == 0 || frame < options.frames; ++frame) {
        const auto start = std::chrono::steady_clock::now();
        if (frame > 0) crowd.step(1. / 60);
        const std::vector<std::uint32_t> screen = consumer::screen_at(frame);
        rasterizer.render(crowd, screen);
        const auto rendered = std::chrono::steady_clock::now();
        if (recording)
            if (const auto done = recording->frame(crowd, frame, screen); !done) return failed(done.error());
        recording_ms.push_back(milliseconds_since(rendered));
        frame_ms.push_back(milliseconds_since(start));
        if (!options.report) continue;
        std::printf("%llu\n", static_cast<unsigned long long>(recording ? recording->recorder().frames_written() : 0));
        std::fflush(stdout);
    }
    if (recording)
        if (const auto done = recording->recorder().finish(); !done) return failed(done.error());
    std::uint64_t picture = 0;
    for (const std::uint32_t pixel : rasterizer.color()) picture = picture * 31 + pixel;
    std::fprintf(stderr, "%zu frames, median %.2f ms, of it %.3f ms recording; waited %.3f s; picture %016llx\n", frame_ms.size(),
                 median(frame_ms), median(recording_ms), recording ? recording->recorder().load().waited_s : 0,
                 static_cast<unsigned long long>(picture));
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const std::optional<Options> options = parse(count, words);
    if (!options) return std::fprintf(stderr, "consumer: see the first lines of main.cpp\n"), 2;
    return run(*options);
}
