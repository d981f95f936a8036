#include "passes/edges/routing/ratios.h"

#include <cstddef>
#include <string>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"

namespace strata::edges {
namespace {

constexpr std::uint32_t samples = 4;
constexpr double wall_depth = 4;

/// View space to world.
glm::dmat4 from_view(const View& view) {
    glm::dmat4 matrix(glm::inverse(view.to_view));
    matrix[3] = glm::dvec4(view.origin, 1);
    return matrix;
}

/// Stripes of the wall from one column of pixels to another, in view space.
void add_stripe(Mesh& mesh, const View& view, double left, double right) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto x = [&](double column) {
        return ((2 * column / view.width - 1) - double(view.projection[2][0])) / double(view.projection[0][0]) * wall_depth;
    };
    const double y = 2 / std::abs(double(view.projection[1][1])) * wall_depth;  // beyond the picture
    for (const glm::dvec2 corner : {glm::dvec2(x(left), y), {x(right), y}, {x(right), -y}, {x(left), -y}}) {
        mesh.positions.emplace_back(corner.x, corner.y, wall_depth);
        mesh.normals.emplace_back(0, 0, -1);
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + corner);
}

/// A wall of two paints in the place of the frame's draws, whose stripes meet in the middle of every `spacing`-th column of
/// pixels (0: one paint), at 4 samples, in the light of all the frame's lights.
void stripe(Frame& frame, std::uint32_t spacing) {
    View& view = frame.view;
    view.samples = samples;
    Mesh odd, even;
    odd.name = "odd stripes";
    even.name = "even stripes";
    const double width = spacing > 0 ? spacing : 2 * view.width, first = spacing > 0 ? 0.5 - width : -0.5 * view.width;
    bool is_odd = false;
    for (double left = first; left < view.width; left += width, is_odd = !is_odd)
        add_stripe(is_odd ? odd : even, view, left, left + width);
    frame.emitters.clear();
    frame.draws.clear();
    frame.meshes = {even, odd};
    if (odd.positions.empty()) frame.meshes.pop_back();
    Material light;
    light.name = "light";
    light.roughness = 0.5f;
    light.double_sided = true;
    Material dark = light;
    dark.name = "dark";
    dark.base_color = glm::vec4(0.2f, 0.2f, 0.2f, 1);
    frame.materials = {light, dark};
    for (std::uint32_t i = 0; i < frame.meshes.size(); ++i) {
        const glm::dmat4 place = from_view(view);
        Draw draw;
        draw.mesh = draw.material = i;
        draw.to_world = draw.previous_to_world = place;
        frame.draws.push_back(draw);
    }
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        Light& lamp = frame.lights[i];
        const glm::dvec3 at(double(i % 8) - 3.5, double(i / 8 % 8) - 3.5, wall_depth - 1);
        Light bulb;
        bulb.name = lamp.name;
        bulb.position = glm::dvec3(from_view(view) * glm::dvec4(at, 1));
        bulb.intensity = lamp.intensity;
        bulb.range = 100;
        lamp = bulb;
    }
}

template <std::uint32_t spacing>
void striped(Frame& frame) {
    stripe(frame, spacing);
}

struct Wall {
    FrameChange change;
    double edges;  ///< of its pixels
};
constexpr Wall walls[] = {{{"e = 0", striped<0>}, 0},        {{"e = 1/16", striped<16>}, 1. / 16},
                          {{"e = 1/8", striped<8>}, 1. / 8}, {{"e = 1/4", striped<4>}, 1. / 4},
                          {{"e = 1/2", striped<2>}, 1. / 2}, {{"e = 1", striped<1>}, 1}};
constexpr std::string_view shading_names[] = {"shading at edges alone, e = 0",   "shading at edges alone, e = 1/16",
                                              "shading at edges alone, e = 1/8", "shading at edges alone, e = 1/4",
                                              "shading at edges alone, e = 1/2", "shading at edges alone, e = 1"};
constexpr std::string_view routing_names[] = {
    "a list of edges against idle threads, e = 0",   "a list of edges against idle threads, e = 1/16",
    "a list of edges against idle threads, e = 1/8", "a list of edges against idle threads, e = 1/4",
    "a list of edges against idle threads, e = 1/2", "a list of edges against idle threads, e = 1"};
constexpr std::string_view scenario = "hall_of_lights_64";

}  // namespace

std::vector<TimeRatio> shading_ratios() {
    std::vector<TimeRatio> ratios;
    for (std::size_t i = 0; i < std::size(walls); ++i) {
        const double e = walls[i].edges;
        ratios.push_back({.name = shading_names[i],
                          .of = "",
                          .against = "all_samples",
                          .published = ((1 - e) + samples * e) / samples,
                          .source = "((1 - e) + 4 e) / 4, docs/algorithms/deferred.md 3.4",
                          .scenario = scenario,
                          .counters = {"edge_pixels"},
                          .stages = {Stage::edges, Stage::occlusion, Stage::indirect, Stage::lighting, Stage::combine},
                          .of_frame = walls[i].change,
                          .against_frame = walls[i].change});
    }
    return ratios;
}

std::vector<TimeRatio> routing_ratios() {
    std::vector<TimeRatio> ratios;
    for (std::size_t i = 0; i < std::size(walls); ++i)
        ratios.push_back({.name = routing_names[i],
                          .of = "routing=list",
                          .against = "routing=threads",
                          .scenario = scenario,
                          .counters = {"samples_shaded"},
                          .of_frame = walls[i].change,
                          .against_frame = walls[i].change});
    return ratios;
}

}  // namespace strata::edges
