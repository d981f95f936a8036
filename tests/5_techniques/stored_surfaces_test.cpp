// G-buffer layouts through the device's own targets and back: codes that survive, and the errors of
// docs/algorithms/deferred.md 2.3 and 2.5, by the shaders that the techniques have.
#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/codes.h"
#include "passes/reference/shade.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/scene_records.h"
#include "tests/support/normal_errors.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata::gbuffer {
namespace {

// --- codes of half floats ---------------------------------------------------------------------------------------------------

constexpr std::uint32_t codes_wide = 320, codes_high = code_count / codes_wide;

/// How many of all codes come back wrong out of any sample of any channel of an rgba16f target.
std::size_t lost_codes(std::uint32_t samples) {
    TestFrame frame;
    frame.shader("write.frag", R"(
        #include "passes/gbuffer/codes.glsl"
        layout(location = 0) out vec4 target;
        void main() { target = vec4(half_of_code(uint(gl_FragCoord.y) * 320u + uint(gl_FragCoord.x))); })");
    frame.shader("read.comp", R"(
        #include "passes/gbuffer/codes.glsl"
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(set = 0, binding = 0) uniform sampler2DArray stored;
        layout(set = 0, binding = 1, rgba32f) writeonly uniform image2DArray codes;
        void main() {
            const ivec3 at = ivec3(gl_GlobalInvocationID);
            const vec4 halves = texelFetch(stored, at, 0);
            imageStore(codes, at, vec4(code_of_half(halves.r), code_of_half(halves.g), code_of_half(halves.b), code_of_half(halves.a)));
        })");
    const Extent extent{codes_wide, codes_high};
    Image target = frame.graph.create("target", {.extent = extent, .format = Format::rgba16f, .samples = samples});
    frame.graph.clear(target, {});
    frame.graph.fullscreen("write").covers(target);
    const Image stored = spread(frame.graph, target, "stored");
    Image codes = frame.graph.create("codes", {.extent = extent, .format = Format::rgba32f, .layers = samples});
    frame.graph.compute("read.comp").samples("stored", stored).stores("codes", codes).over({codes_wide, codes_high, samples});
    const ReferenceImage read = in_double(frame.result(codes));
    std::size_t lost = 0;
    for (std::size_t i = 0; i < read.texels.size(); ++i) lost += read.texels[i] != glm::dvec4(double(i % code_count));
    EXPECT_EQ(read.texels.size(), std::size_t(code_count) * samples);
    return lost;
}

TEST(GBufferCodes, AllSurviveATargetOfHalfFloats) {
    EXPECT_EQ(lost_codes(1), 0u);
    EXPECT_EQ(lost_codes(4), 0u);
}

// --- a million normals ------------------------------------------------------------------------------------------------------

// Of a square of 1000 x 1000: normals of all directions, normals near where packings are singular, and level walls.
constexpr std::uint32_t side = 1000;
constexpr std::size_t uniform_end = 500'000, adversarial_end = 900'000, level_end = 1'000'000;

struct LayoutProbe {
    glm::vec3 normal;
    float z;  ///< view depth
};

glm::vec3 adversarial_normal(std::size_t kind, std::mt19937_64& random) {
    std::uniform_real_distribution<double> around(0, 2 * std::numbers::pi), little(-.04, .04);
    const double a = around(random), b = little(random), r = std::sqrt(1 - b * b);
    if (kind == 0) return {r * std::cos(a), r * std::sin(a), b};  // near z = 0
    if (kind == 1) return {r * std::cos(a), b, r * std::sin(a)};  // near y = 0
    const auto sign = [&] { return random() % 2 == 0 ? 1. : -1.; };
    const double x = sign() + little(random), y = sign() + little(random), z = sign() + little(random);
    return glm::normalize(glm::dvec3(x, y, z));
}

/// Evenly around: few of them are near the ring, and random ones would say little of the mean.
glm::vec3 level_normal(std::size_t i) {
    const double a = std::numbers::pi * (double(i) + .5) / double(level_end - adversarial_end);
    return {std::cos(a), 0, -std::sin(a)};
}

const std::vector<LayoutProbe>& probes() {
    static const std::vector<LayoutProbe> made = [] {
        std::mt19937_64 random(1);
        std::normal_distribution<double> gauss;
        std::uniform_real_distribution<double> unit(0, 1);
        std::vector<LayoutProbe> all(std::size_t(side) * side);
        for (std::size_t i = 0; i < all.size(); ++i) {
            const double x = gauss(random), y = gauss(random), z = gauss(random);
            all[i].normal = glm::normalize(glm::dvec3(x, y, z));
            if (i >= uniform_end) all[i].normal = adversarial_normal(i % 3, random);
            if (i >= adversarial_end) all[i].normal = level_normal(i - adversarial_end);
            all[i].z = float(.1 * std::pow(5e4, unit(random)));  // 0.1 m to 5 km
        }
        return all;
    }();
    return made;
}

const Frame& probed_frame() {
    static const Frame frame = must(find_scenario("far_wall"))->build(0, {.width = side, .height = side});
    return frame;
}

struct LayoutRow {
    std::string_view name;
    std::size_t targets = 2;
    std::array<Format, 3> formats = {Format::rgba16f, Format::rgba8_unorm, Format::rgba8_unorm};
    double worst = 0, mean = 0;              ///< degrees, docs/algorithms/deferred.md 2.5, rounded to nearest
    double level_worst = 0, level_mean = 0;  ///< of level walls; 0: the chapter has none
};

void PrintTo(const LayoutRow& row, std::ostream* out) { *out << row.name; }

constexpr Format half = Format::rgba16f, byte = Format::rgba8_unorm;
// Of level walls the chapter has .808 for z_first, with |.| under the root: max(0, .) makes half of them exact. And .0295 for
// packed, with subnormal halves, which may be flushed and are not used here: normals near x = -1 are coarser.
const std::array layout_rows = {
    LayoutRow{"wide", 3, {half, half, byte}, .0229, .0061},
    LayoutRow{"packed", 2, {half, byte}, 2.124, .0473, 1.79, .0308},
    LayoutRow{"z_first", 2, {half, byte}, 1.886, .0408, 1.886, .402},
    LayoutRow{"oct_half", 2, {half, byte}, .0587, .0150, .0280, .0080},
    LayoutRow{"octahedral", 2, {half, byte}, .0040, .0014},
    LayoutRow{"depth_rebuilt", 3, {byte, byte, Format::r16f}, .0037, .0013, .0018, .0007},
    LayoutRow{"compact", 2, {byte, byte}, .2365, .0837},
};

/// What is written into a layout's targets and read out of them.
struct Probed {
    ReferenceImage normals;    ///< and view z; 0 where there is no surface
    ReferenceImage positions;  ///< where a reader finds the surface
};

std::string probe_shader(std::string_view layout) {
    return fmt::format(R"(
        #include "passes/shaders/camera.glsl"
        #include "passes/gbuffer/{}/encode.glsl"
        layout(location = 2) out vec4 emission;
        layout(set = 0, binding = 0, scalar) readonly buffer Probes {{ vec4 probes[]; }};
        void main() {{
            const uvec2 pixel = uvec2(gl_FragCoord.xy);
            const vec4 probe = probes[pixel.y * view.extent.x + pixel.x];
            encode(MaterialPoint(view_position(vec2(pixel) + 0.5, probe.w), probe.xyz, vec3(0.5), 1.0, 0.0, 0.5, 1.0, vec3(0.0),
                                 vec3(0.0), model_ggx, 0u));
            emission = vec4(0.0);
        }})",
                       layout);
}

std::string read_shader(std::string_view layout) {
    return fmt::format(R"(
        #include "passes/gbuffer/surface.glsl"
        #include "passes/gbuffer/{0}/decode.glsl"
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(set = 0, binding = 0, scalar) readonly buffer Probes {{ vec4 probes[]; }};
        layout(set = 0, binding = 1) uniform sampler2DArray gbuffer0;
        layout(set = 0, binding = 2) uniform sampler2DArray gbuffer1;
        layout(set = 0, binding = 3) uniform sampler2DArray gbuffer2;
        layout(set = 0, binding = 4, rgba32f) writeonly uniform image2DArray normals;
        layout(set = 0, binding = 5, rgba32f) writeonly uniform image2DArray positions;
        layout(push_constant) uniform Push {{ uint is_cleared; }};
        void main() {{
            const ivec3 at = ivec3(gl_GlobalInvocationID);
            const float depth = is_cleared != 0u ? 0.0 : view.near / probes[at.y * int(view.extent.x) + at.x].w;
            const Surface s = decode_{0}(GBufferTexel(texelFetch(gbuffer0, at, 0), texelFetch(gbuffer1, at, 0),
                                                      texelFetch(gbuffer2, at, 0), depth, vec2(at.xy) + 0.5, vec2(0.0), vec2(0.0)));
            imageStore(normals, at, s.exists ? vec4(s.normal, s.z) : vec4(0.0));
            imageStore(positions, at, s.exists ? vec4(surface_position(s, uvec2(at.xy)), 1.0) : vec4(0.0));
        }})",
                       layout);
}

enum class Written : std::uint32_t { cleared, probes };

Probed probed(const LayoutRow& row, Written written) {
    TestFrame frame;
    frame.shader("probe.frag", probe_shader(row.name));
    frame.shader("read.comp", read_shader(row.name));
    const Buffer input = import_values(frame.graph, "probes", ImportId{1}, probes());
    frame.graph.offer(
        "View", import_values(frame.graph, "view", ImportId{2}, std::vector{scene_records(SceneFacts(probed_frame())).view}));
    const std::uint32_t extent = written == Written::cleared ? 8 : side;
    const auto target = [&](const char* name, Format format) {
        Image image = frame.graph.create(name, {.extent = {extent, extent}, .format = format});
        frame.graph.clear(image, {});
        return image;
    };
    Image g0 = target("gbuffer0", row.formats[0]), g1 = target("gbuffer1", row.formats[1]), g2;
    Image emission = target("emission", Format::rgba16f);
    if (row.targets == 3) g2 = target("gbuffer2", row.formats[2]);
    if (written == Written::probes) {
        FullscreenStep probe = frame.graph.fullscreen("probe");
        probe.loads("Probes", input).covers(g0).covers(g1).covers(emission);
        if (row.targets == 3) probe.covers(g2);
    }
    Image normals = target("normals", Format::rgba32f), positions = target("positions", Format::rgba32f);
    frame.graph.compute("read.comp")
        .loads("Probes", input)
        .samples("gbuffer0", g0)
        .samples("gbuffer1", g1)
        .samples("gbuffer2", g2)
        .stores("normals", normals)
        .stores("positions", positions)
        .push(std::uint32_t(written == Written::cleared))
        .over({extent, extent});
    frame.graph.keep(normals);
    frame.graph.keep(positions);
    const Execution run = frame.run();
    return {in_double(run.images.at(normals.id)), in_double(run.images.at(positions.id))};
}

class GBufferLayout : public testing::TestWithParam<LayoutRow> {};

struct Angles {
    double worst = 0, sum = 0;
    void add(double angle) {
        worst = std::max(worst, angle);
        sum += angle;
    }
};

void expect_normals_of_the_table(const LayoutRow& row, const ReferenceImage& normals) {
    Angles uniform, level, all;
    for (std::size_t i = 0; i < probes().size(); ++i) {
        const double angle = degrees_between(glm::dvec3(normals.texels[i]), glm::dvec3(probes()[i].normal));
        all.add(angle);
        if (i < uniform_end) uniform.add(angle);
        if (i >= adversarial_end) level.add(angle);
    }
    const double mean = uniform.sum / uniform_end, level_mean = level.sum / (level_end - adversarial_end);
    testing::Test::RecordProperty("normals", fmt::format("worst {:.4f}, mean {:.4f}; level walls worst {:.4f}, mean {:.4f}",
                                                         all.worst, mean, level.worst, level_mean));
    // The chapter gives two digits of the smallest.
    EXPECT_NEAR(all.worst, row.worst, .05 * row.worst + 5e-5);
    EXPECT_NEAR(mean, row.mean, .05 * row.mean + 5e-5);
    if (row.level_mean == 0) return;
    EXPECT_NEAR(level.worst, row.level_worst, .05 * row.level_worst + 5e-5);
    EXPECT_NEAR(level_mean, row.level_mean, .05 * row.level_mean + 5e-5);
}

/// Half a step of the half float nearest to a size, as it is after rounding to nearest; 2^-15 where subnormals are flushed.
double half_step(double size) { return std::ldexp(1, std::max(std::ilogb(size) - 11, -15)); }

/// How far view depth may be off.
double depth_bound(std::string_view layout, double z) {
    // A device's log2 is off by 3 units in the last place: .01 of a step at a code of 60000.
    if (layout == "octahedral") return z * std::log(1e5) / 61439 / 2 * 1.03;
    if (layout == "depth_rebuilt" || layout == "compact") return z * 0x1p-22;
    return half_step(z);
}

void expect_positions_within_bounds(const LayoutRow& row, const ReferenceImage& positions) {
    double worst_depth = 0, worst_aside = 0;
    for (std::size_t i = 0; i < probes().size(); ++i) {
        const glm::dvec3 ray = pixel_ray(probed_frame(), double(i % side) + .5, double(i / side) + .5), got(positions.texels[i]);
        const double z = probes()[i].z, rounding = 3e-6 * z;  // of floats, from the encoder to the reader
        worst_depth = std::max(worst_depth, std::abs(got.z - z) / depth_bound(row.name, z));
        const glm::dvec2 aside = glm::abs(glm::dvec2(got) - glm::dvec2(ray) * (row.name == "wide" ? z : got.z));
        for (const int axis : {0, 1}) {
            const double bound = (row.name == "wide" ? half_step(std::abs(ray[axis]) * z) : 0) + rounding;
            worst_aside = std::max(worst_aside, aside[axis] / bound);
        }
    }
    testing::Test::RecordProperty("positions", fmt::format("depth {:.4f}, aside {:.4f} of the bound", worst_depth, worst_aside));
    EXPECT_LE(worst_depth, 1.001);
    EXPECT_LE(worst_aside, 1.001);
    EXPECT_TRUE(worst_depth > .9 || row.formats[0] == byte) << "a million depths come near the bound of a target";
}

TEST_P(GBufferLayout, KeepsAMillionNormalsAndDepthsAsWellAsTheTableSays) {
    const Probed read = probed(GetParam(), Written::probes);
    expect_normals_of_the_table(GetParam(), read.normals);
    expect_positions_within_bounds(GetParam(), read.positions);
}

TEST_P(GBufferLayout, TakesAClearedTexelForBackground) {
    const Probed read = probed(GetParam(), Written::cleared);
    for (const glm::dvec4& texel : read.normals.texels) ASSERT_EQ(texel, glm::dvec4(0));
}

INSTANTIATE_TEST_SUITE_P(Layouts, GBufferLayout, testing::ValuesIn(layout_rows),
                         [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace strata::gbuffer
