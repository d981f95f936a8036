// How times grow with what a frame holds: lights, particles, triangles, and the frames of a capture. All sizes are measured in
// turn within one run. growth_K is the time of size K over that of the size before, by the ratio of the two sizes: 1 where an
// element costs the same, below 1 where it costs less among more.
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>

#include <benchmark/benchmark.h>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "passes/shaders/scene/materials.shared.h"
#include "replay/gpu/host_timer.h"
#include "replay/measure/timing.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::size_t turns = 5;

/// By size, by turn.
using Times = std::vector<std::vector<double>>;

void report_growth(benchmark::State& state, const std::vector<double>& sizes, const Times& ms) {
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        state.counters[fmt::format("ms_{}", sizes[k])] = spread_of(ms[k]).median;
        if (k == 0) continue;
        std::vector<double> growth;
        for (std::size_t turn = 0; turn < ms[k].size(); ++turn)
            growth.push_back(ms[k][turn] / ms[k - 1][turn] / (sizes[k] / sizes[k - 1]));
        const Spread spread = spread_of(growth);
        state.counters[fmt::format("growth_{}", sizes[k])] = spread.median;
        state.counters[fmt::format("growth_{}_mad", sizes[k])] = spread.mad;
    }
}

/// Of one stage's technique over frames of these sizes.
void grow(benchmark::State& state, std::vector<Frame> frames, const std::vector<double>& sizes, std::string_view stage,
          std::string_view technique) {
    std::vector<Request> requests;
    for (std::size_t i = 0; i < frames.size(); ++i)
        requests.push_back({.variant = {.frame = i}, .choices = chosen({std::string(technique)})});
    const auto session = must(Session::open(std::move(frames), {}));
    for (auto _ : state) {
        Times ms;
        for (const Run& run : must(session->time(requests, turns))) ms.push_back(run.stage_ms_by_repeat.at(std::string(stage)));
        report_growth(state, sizes, ms);
    }
    state.SetLabel(session->device().name);
}

/// Lights that shrink as they grow in number: about as many reach any point.
void lights(benchmark::State& state, std::string_view technique) {
    std::vector<Frame> grown;
    for (const char* scenario : {"hall_of_lights_64", "hall_of_lights_512", "hall_of_lights_4096"})
        grown.push_back(scenario_frames(scenario).front());
    grow(state, std::move(grown), {64, 512, 4096}, "lighting", technique);
}

/// Particles of about four pixels, anywhere in sight between 5 and 15 m.
Frame dust(std::size_t count) {
    Frame frame = scenario_frames("smoke_grenade").front();
    frame.draws.clear();
    Emitter& emitter = frame.emitters.front();
    frame.emitters.resize(1);
    emitter.particles.clear();
    std::mt19937 random(1);
    const auto unit = [&] { return double(random()) / 4294967296.; };
    const View& view = frame.view;
    for (std::size_t i = 0; i < count; ++i) {
        const double z = 5 + 10 * unit();
        const glm::dvec3 there{(2 * unit() - 1) * z / double(view.projection[0][0]),
                               (2 * unit() - 1) * z / double(view.projection[1][1]), z};
        emitter.particles.push_back({.center = view.origin + glm::transpose(view.to_view) * there,
                                     .size = static_cast<float>(2 * z / (view.width * double(view.projection[0][0]))),
                                     .alpha = .1f});
    }
    return frame;
}

void particles(benchmark::State& state, std::string_view technique) {
    std::vector<Frame> grown;
    const std::vector<double> sizes{10e3, 40e3, 160e3, 640e3};
    for (const double count : sizes) grown.push_back(dust(static_cast<std::size_t>(count)));
    grow(state, std::move(grown), sizes, "transparency", technique);
}

/// A wavy sheet of 2 edge^2 triangles that fills the image.
Frame sheet(std::uint32_t edge, AlphaMode mode) {
    Frame frame = scenario_frames("smoke_grenade").front();
    frame.emitters.clear();
    Mesh mesh{.name = "sheet"};
    for (std::uint32_t y = 0; y <= edge; ++y)
        for (std::uint32_t x = 0; x <= edge; ++x) {
            const double u = 2. * x / edge - 1, v = 2. * y / edge - 1;
            mesh.positions.emplace_back(6 * u, 4 * v, .2 * std::sin(20 * u) * std::cos(20 * v));
            mesh.normals.emplace_back(0, 0, 1);
        }
    for (std::uint32_t y = 0; y < edge; ++y)
        for (std::uint32_t x = 0; x < edge; ++x) {
            const std::uint32_t a = y * (edge + 1) + x, above = a + edge + 1;
            for (const std::uint32_t corner : {a, a + 1, above + 1, a, above + 1, above}) mesh.indices.push_back(corner);
        }
    frame.meshes = {std::move(mesh)};
    frame.materials.resize(1);
    frame.materials.front().alpha_mode = mode;
    frame.materials.front().base_color.w = .5f;
    frame.materials.front().double_sided = true;
    const glm::dvec3 before_the_eye = frame.view.origin + glm::transpose(frame.view.to_view) * glm::dvec3(0, 0, 5);
    Draw draw{.mesh = 0, .material = 0};
    draw.to_world = glm::dmat4(glm::transpose(frame.view.to_view));
    draw.to_world[3] = glm::dvec4(before_the_eye, 1);
    draw.previous_to_world = draw.to_world;
    frame.draws = {draw};
    return frame;
}

void triangles(benchmark::State& state, AlphaMode mode, std::string_view stage, std::string_view technique) {
    std::vector<Frame> grown;
    std::vector<double> sizes;
    for (const std::uint32_t edge : {175u, 350u, 700u, 1400u}) {
        sizes.push_back(2. * edge * edge);
        grown.push_back(sheet(edge, mode));
    }
    grow(state, std::move(grown), sizes, stage, technique);
}

/// Recording so many frames in which smoke moves, or opening the capture and reading its last.
enum class Of { recording, reading_the_last };
void captured_frames(benchmark::State& state, Of what) {
    const std::vector<double> sizes{16, 64, 256};
    const std::vector<Frame> moving = scenario_frames("smoke_grenade", 1, 256);
    const std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("growth.{}.strata", getpid());
    Times ms(sizes.size());
    for (auto _ : state)
        for (std::size_t turn = 0; turn < turns; ++turn)
            for (std::size_t k = 0; k < sizes.size(); ++k) {
                HostTimer timer;
                Recorder recorder = must(Recorder::create(path));
                for (std::size_t i = 0; i < static_cast<std::size_t>(sizes[k]); ++i) must(recorder.record(moving[i]));
                must(recorder.finish());
                if (what == Of::reading_the_last) {
                    timer = {};
                    const Capture capture = must(Capture::open(path));
                    benchmark::DoNotOptimize(must(capture.frame(capture.frame_count() - 1)));
                }
                ms[k].push_back(timer());
            }
    report_growth(state, sizes, ms);
    std::filesystem::remove(path);
}

#define GROWS(function, name, ...) \
    BENCHMARK_CAPTURE(function, name, __VA_ARGS__)->Iterations(1)->Unit(benchmark::kMillisecond)->UseRealTime()

GROWS(lights, brute_force, "lighting/brute_force");
GROWS(lights, tiled, "lighting/tiled");
GROWS(lights, z_binned, "lighting/z_binned");
GROWS(particles, alpha_blend, "transparency/alpha_blend");
GROWS(particles, weighted, "transparency/weighted");
GROWS(particles, moments, "transparency/moments");
GROWS(particles, voxel, "transparency/voxel");
GROWS(particles, sorted_lists, "transparency/sorted_lists");
GROWS(triangles, opaque, AlphaMode::opaque, "gbuffer", "gbuffer/octahedral");
GROWS(triangles, sorted_lists, AlphaMode::blend, "transparency", "transparency/sorted_lists");
GROWS(captured_frames, recorded, Of::recording);
GROWS(captured_frames, last_read, Of::reading_the_last);

}  // namespace
}  // namespace strata
