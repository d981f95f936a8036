// Draws that nobody sees are not drawn, and the picture is the same to the last bit: cold, warm, from any place, at any extent.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/culling/judge.h"
#include "passes/culling/truth.h"
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"
#include "tests/support/session.h"

namespace strata {
namespace {

const std::string hiz = "culling/hiz_two_phase";
const std::string pyramid = hiz + ":pyramid";
constexpr const char* settings[] = {"phases=two", "phases=one"};

Request culled(std::size_t frame, std::vector<std::string> sets = {}) {
    return {.variant = {.frame = frame}, .choices = chosen({hiz}, std::move(sets)), .outputs = {"visible"}};
}

std::uint64_t counted_by_hiz(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == hiz && counter.name == name) return counter.value;
    throw std::runtime_error(fmt::format("no counter {}", name));
}

std::uint64_t drawn(const Run& run) {
    const ReferenceImage visible = in_double(run.images.at("visible"));
    return static_cast<std::uint64_t>(std::ranges::count_if(visible.texels, [](const glm::dvec4& t) { return t.x == 1; }));
}

std::vector<Metric> judged(const Run& run, const Frame& frame) {
    const ImageSet before;
    ImageSet result;
    result.emplace("visible", in_double(run.images.at("visible")));
    const StageInput input{frame, before};
    return culling_judge(result, culling_truth(input), input);
}

std::vector<Frame> city(std::uint32_t count, const ScenarioOptions& options = {}) {
    const Scenario& scenario = *must(find_scenario("city_of_boxes"));
    ScenarioOptions animated = options;
    animated.frames = count;
    std::vector<Frame> frames;
    for (std::uint32_t i = 0; i < count; ++i) frames.push_back(scenario.build(i, animated));
    return frames;
}

TEST(OcclusionCulling, HidesNoVisibleDrawAlongAPathThroughACityAndAnswersAsIfItHadSeenNoFrameBefore) {
    constexpr std::uint32_t count = 16;  // 64 were run once: they take a minute
    const std::vector<Frame> frames = city(count);
    const auto warm = session_of(frames), cold = session_of(frames);
    std::uint64_t newly = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto run = must(warm->run(culled(i)));
        if (i % 8 == 7) {
            cold->forget_memo();
            const auto alone = must(cold->run(culled(i)));
            EXPECT_LE(counted_by_hiz(alone, "drawn first"), 64u);
            ASSERT_EQ(hash_of(run.images.at("visible")), hash_of(alone.images.at("visible"))) << "frame " << i;
        }
        const std::vector<Metric> metrics = judged(run, frames[i]);
        EXPECT_EQ(metrics[0].value, 0) << metrics[0].name << " in frame " << i;
        EXPECT_LT(metrics[2].value, .5 * double(counted_by_hiz(run, "in view"))) << "drawn in frame " << i;
        if (i > 0) newly += counted_by_hiz(run, "newly visible");
    }
    EXPECT_GT(newly, 0u) << "nothing came into sight: the second phase was never needed";
    EXPECT_LT(newly, 5 * std::uint64_t{count});
}

TEST(OcclusionCulling, DrawsWhatIsVisibleAndNothingElseInTheFirstPhaseOnceItIsKnown) {
    const auto session = scenario_session("city_of_boxes");
    const auto cold = must(session->run(culled(0))), warm = must(session->run(culled(0)));
    EXPECT_LE(counted_by_hiz(cold, "drawn first"), 64u);
    EXPECT_EQ(counted_by_hiz(cold, "tested"), counted_by_hiz(cold, "in view") - counted_by_hiz(cold, "drawn first"));
    EXPECT_EQ(counted_by_hiz(cold, "in view"), counted_by_hiz(cold, "occluded") + drawn(cold));
    EXPECT_EQ(counted_by_hiz(warm, "drawn first"), drawn(cold));
    EXPECT_EQ(counted_by_hiz(warm, "newly visible"), 0u);
    EXPECT_EQ(counted_by_hiz(warm, "occluded"), counted_by_hiz(cold, "occluded"));
    EXPECT_EQ(counted_by_hiz(warm, "pyramid texels"), 2u * 19244);
}

TEST(OcclusionCulling, ChangesNoBitOfAPicture) {
    for (const std::string_view scenario : info(Stage::culling).scenarios)
        for (const std::uint32_t samples : {1u, 4u}) {
            const auto session = scenario_session(scenario, samples);
            const auto picture = [&](std::vector<std::string> uses, std::vector<std::string> sets) {
                return must(session->run(
                                {.choices = chosen(std::move(uses), std::move(sets)), .outputs = {"color", "depth_layers"}}))
                    .images;
            };
            const auto all = picture({"culling/none"}, {});
            for (const char* set : settings)
                for (const char* state : {"cold", "warm"})
                    for (const auto& [name, image] : picture({hiz}, {set}))
                        EXPECT_EQ(hash_of(image), hash_of(all.at(name)))
                            << name << " of " << scenario << " at " << samples << ", " << set << ", " << state;
        }
}

/// The next level: least of four texels, or of those that there are.
ReferenceImage halved(const ReferenceImage& fine) {
    ReferenceImage coarse((fine.width + 1) / 2, (fine.height + 1) / 2, 1, glm::dvec4(1));
    for (std::uint32_t y = 0; y < fine.height; ++y)
        for (std::uint32_t x = 0; x < fine.width; ++x)
            coarse.at(x / 2, y / 2).x = std::min(coarse.at(x / 2, y / 2).x, fine.at(x, y).x);
    return coarse;
}

ReferenceImage farthest_sample(const ReferenceImage& depth) {
    ReferenceImage farthest(depth.width, depth.height, 1, glm::dvec4(1));
    for (std::size_t i = 0; i < depth.texels.size(); ++i) {
        double& least = farthest.texels[i % farthest.texels.size()].x;
        least = std::min(least, depth.texels[i].x);
    }
    return farthest;
}

TEST(OcclusionCulling, BuildsEveryLevelOfThePyramidFromTheDepthTheGBufferHas) {
    for (const std::uint32_t samples : {1u, 4u})
        for (const auto& [width, height] : {std::pair{53u, 31u}, {160u, 90u}, {1u, 9u}}) {
            const auto frames = city(1, {.width = width, .height = height, .samples = samples});
            const auto session = session_of(frames);
            ReferenceImage wanted;
            for (std::uint32_t level = 0; level == 0 || wanted.width > 1 || wanted.height > 1; ++level) {
                Request request = culled(0, {fmt::format("level={}", level)});
                request.outputs = {pyramid, "depth_layers"};
                const auto run = must(session->run(request));
                wanted = level == 0 ? farthest_sample(in_double(run.images.at("depth_layers"))) : halved(wanted);
                const ReferenceImage shown = in_double(run.images.at(pyramid));
                double worst = 0;
                for (std::uint32_t y = 0; y < height; ++y)
                    for (std::uint32_t x = 0; x < width; ++x) {
                        const double depth = wanted.at(x >> level, y >> level).x;
                        const double meters = depth > 0 ? double(frames[0].view.near) / depth : 0;
                        worst = std::max(worst, std::abs(shown.at(x, y).x - meters) / std::max(meters, 1e-9));
                    }
                EXPECT_LT(worst, 1e-6) << "level " << level << " of " << width << "x" << height << " at " << samples;
            }
        }
}

TEST(OcclusionCulling, DrawsNothingThatIsBehindTheEye) {
    const auto session = scenario_session("materials");
    Request away = culled(0);
    away.variant.eye.pan = std::numbers::pi;
    const auto run = must(session->run(away));
    EXPECT_EQ(counted_by_hiz(run, "in view"), drawn(run));
    Request at_it = culled(0);
    EXPECT_GT(drawn(must(session->run(at_it))), drawn(run)) << "after a turn nothing of what was known is left, and all is found";
}

TEST(OcclusionCulling, WorksOnAPictureOfOnePixel) {
    for (const std::uint32_t samples : {1u, 4u}) {
        const auto frames = city(1, {.width = 1, .height = 1, .samples = samples});
        const auto session = session_of(frames);
        for (const char* set : settings) {
            const auto run = must(session->run(culled(0, {set})));
            EXPECT_EQ(judged(run, frames[0])[0].value, 0);
            EXPECT_GE(drawn(run), 1u);
            EXPECT_EQ(counted_by_hiz(run, "pyramid texels"), set == settings[0] ? 2u : 1u);
        }
    }
}

}  // namespace
}  // namespace strata
