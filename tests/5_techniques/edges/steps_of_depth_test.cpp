// Edges in layouts whose words hold no depth: a silhouette between surfaces of equal normal and material is one, too. What the
// stage's truth says is held against rays of their own.
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "replay/report/report.h"
#include "replay/report/row_truth.h"
#include "tests/support/errors.h"
#include "tests/support/pixel_triangles.h"
#include "tests/support/plain_rays.h"
#include "tests/support/session.h"

namespace strata::steps_of_depth {
namespace {

constexpr glm::uvec2 extent{64, 36};
const std::vector<std::string> without_depth = {"gbuffer/depth_rebuilt", "gbuffer/compact"};

/// A wall 6 m away, and a sheet of the same material 2 m away before a part of it: a triangle whose sides cut pixels at all
/// angles.
Frame two_planes() {
    PixelTriangle near = whole_picture(extent, 2);
    near.corners = {glm::dvec3(20.3, -40, 2), {20.3, 33.6, 2}, {200, 33.6, 2}};
    return frame_of_triangles(extent, 4, std::array{whole_picture(extent, 6), near});
}

/// How a pixel is by rays through its samples; nothing where it hangs on a hundredth of a pixel, and where triangles of one depth
/// meet.
std::optional<bool> is_edge(const PlainRays& rays, glm::dvec2 pixel) {
    constexpr std::array<glm::dvec2, 4> samples = {{{.375, .125}, {.875, .375}, {.125, .625}, {.625, .875}}};
    constexpr double near = .01, step = .003;
    const PlainTriangle* first = rays.nearest(pixel + samples[0]);
    bool is_one = true, is_step = false;
    for (const glm::dvec2 sample : samples) {
        const glm::dvec2 at = pixel + sample;
        const PlainTriangle* here = rays.nearest(at);
        for (const glm::dvec2 aside : {glm::dvec2(near, near), {-near, near}, {near, -near}, {-near, -near}})
            if (rays.nearest(at + aside) != here) return {};
        is_one = is_one && here == first;
        if (!here || !first) is_step = is_step || here != first;
        else is_step = is_step || std::abs(here->plane_z(rays.ray(at)) / first->plane_z(rays.ray(at)) - 1) > step;
    }
    if (is_step) return true;
    return is_one ? std::optional(false) : std::nullopt;
}

struct Counts {
    std::uint32_t edges = 0, missed = 0, needless = 0, decided = 0;
};

/// By pixel, row by row.
using EdgesByRays = std::vector<std::optional<bool>>;

EdgesByRays by_rays(const Frame& frame) {
    const PlainRays rays(frame);
    EdgesByRays edges;
    for (std::uint32_t y = 0; y < frame.view.height; ++y)
        for (std::uint32_t x = 0; x < frame.view.width; ++x) edges.push_back(is_edge(rays, {x, y}));
    return edges;
}

Counts against_rays(const EdgesByRays& wanted, const ReferenceImage& edges) {
    Counts counts;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (!wanted[i]) continue;
        const bool got = edges.texels[i].x != 0;
        ++counts.decided;
        counts.edges += *wanted[i];
        counts.missed += *wanted[i] && !got;
        counts.needless += !*wanted[i] && got;
    }
    return counts;
}

std::vector<Metric> judged(Session& session, const std::string& layout, const std::string& edges) {
    const Request request{.choices = chosen({layout, edges})};
    return must(session.judge(request, Stage::edges, Against::truth)).technique_errors;
}

TEST(StepsOfDepth, BetweenSurfacesOfEqualWordsAreEdgesWhateverTheLayoutStores) {
    const Frame frame = two_planes();
    const EdgesByRays wanted = by_rays(frame);
    const auto session = session_of({frame});
    for (const std::string layout : {"gbuffer/depth_rebuilt", "gbuffer/compact", "gbuffer/octahedral", "gbuffer/wide"}) {
        const Request request{.choices = chosen({layout})};
        const ReferenceImage truth = must(session->truth(request, Stage::edges)).at("edges");
        const Counts counts = against_rays(wanted, truth);
        EXPECT_GT(counts.edges, 60u);
        EXPECT_EQ(counts.missed, 0u) << layout;
        EXPECT_EQ(counts.needless, 0u) << layout;
        const bool has_depth = std::ranges::count(without_depth, layout) == 0;
        const double edges_percent = 100. * double(std::ranges::count(truth.texels, 1., &glm::dvec4::x)) / (extent.x * extent.y);
        EXPECT_DOUBLE_EQ(judged(*session, layout, "edges/bitwise")[0].value, has_depth ? 0 : edges_percent) << layout;
        EXPECT_EQ(judged(*session, layout, "edges/tolerant")[0].value, 0) << layout;
        EXPECT_EQ(judged(*session, layout, "edges/tolerant")[1].value, 0) << layout;
    }
}

/// Rays through 20 places of each pixel take 5 s of CPU: a scenario alone has no curved surfaces, or no rooms.
TEST(StepsOfDepth, OfScenariosAreThoseThatRaysSee) {
    for (const char* scenario : {"corners", "city_of_boxes", "blocker_rooms"}) {
        const Frame frame = must(find_scenario(scenario))->build(0, {.width = 160, .height = 90, .samples = 4});
        const EdgesByRays wanted = by_rays(frame);
        const auto session = session_of({frame});
        for (const std::string& layout : without_depth) {
            const auto truth = must(session->truth({.choices = chosen({layout})}, Stage::edges));
            const Counts counts = against_rays(wanted, truth.at("edges"));
            RecordProperty(fmt::format("{} in {}", scenario, layout.substr(8)),
                           fmt::format("{} of {} are edges; bitwise misses {:.3f} %", counts.edges, counts.decided,
                                       judged(*session, layout, "edges/bitwise")[0].value));
            EXPECT_EQ(counts.missed, 0u) << scenario << ", " << layout;
            EXPECT_EQ(counts.needless, 0u) << scenario << ", " << layout << ": one triangle covers all samples of these";
            EXPECT_GT(counts.edges, 60u) << scenario;
            EXPECT_GT(counts.decided, 160u * 90u * 9 / 10) << scenario;
        }
    }
}

/// Too large for the truth, so that bitwise would stand in for it.
TEST(StepsOfDepth, LetBitwiseStandInForTheTruthOnlyWhereWordsHoldDepth) {
    constexpr glm::uvec2 large{640, 180};
    const auto session = session_of({frame_of_triangles(large, 4, std::array{whole_picture(large, 6)})});
    const auto is_measured = [&](const std::string& layout) {
        const ReportRequest wanted{.base = {.choices = chosen({layout})}, .stage = Stage::edges};
        return find_row_truths(*session, wanted, std::array{Variant{.request = wanted.base}}, must(session->frame(0)));
    };
    EXPECT_THAT(must(is_measured("gbuffer/octahedral")).all[0].name, testing::StartsWith("edges/bitwise stands in"));
    for (const std::string& layout : without_depth)
        EXPECT_THAT(is_measured(layout), FailsWith("report.truth_too_large")) << layout;
}

/// The marks are integers.
TEST(GivenEdges, AreThePictureOfThePlainReplayAndOthersAnotherOne) {
    Session& session = session_of_scenarios();
    Request request = on_scenario("crossing_planes", 4);
    request.choices = chosen({"edges/bitwise"});
    request.outputs = {"display", "edges"};
    const auto plain = must(session.run(request));
    ImageSet given{{"edges", in_double(plain.images.at("edges"))}};
    request.outputs = {"display"};
    const auto same = must(session.run_from(request, Stage::edges, given));
    EXPECT_EQ(same.images.at("display").texels, plain.images.at("display").texels);
    for (glm::dvec4& texel : given.at("edges").texels) texel.x = 0;
    const auto none = must(session.run_from(request, Stage::edges, given));
    EXPECT_NE(none.images.at("display").texels, plain.images.at("display").texels);
}

}  // namespace
}  // namespace strata::steps_of_depth
