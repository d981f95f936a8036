// Frames done in bands of rows: however small the memory, no fragment is dropped, no bit of the image changes, and no draw of a
// band meets a fragment of another.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/frame_images.h"
#include "passes/reference/fragments.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Run run_with_pool(Session& session, std::string_view pool) {
    Request request;
    request.choices = chosen({"transparency/sorted_lists"}, {fmt::format("pool={}", pool)});
    request.outputs = {"color", "depth_layers"};
    return must(session.run(request));
}

std::size_t steps_called(const Run& run, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::count(run.steps, name, &StepRecord::name));
}

TEST(SortedListsMemory, IsSharedByBandsOfRowsThatGiveTheSameBits) {
    const auto session = scenario_session("glass_and_smoke", 4);
    const auto whole = run_with_pool(*session, "64"), banded = run_with_pool(*session, "0.01");
    EXPECT_EQ(steps_called(whole, "transparency/lists/sort.comp"), 1u);
    EXPECT_GT(steps_called(banded, "transparency/lists/sort.comp"), 3u);
    EXPECT_EQ(whole.images.at("color").texels, banded.images.at("color").texels);
    for (const std::string_view counter : {"fragments", "deepest", "dropped"})
        EXPECT_EQ(counted(whole, counter), counted(banded, counter)) << counter;
}

TEST(SortedListsMemory, HoldsEveryFragmentTheReferenceFinds) {
    const auto session = scenario_session("smoke_grenade");
    const auto run = run_with_pool(*session, "2");
    const FragmentLists lists = transparent_fragments(must(session->frame(0)), in_double(run.images.at("depth_layers")));
    EXPECT_EQ(counted(run, "dropped"), 0u);
    // Coverage at the edges and alphas around 1e-5 hang on rounding.
    EXPECT_NEAR(double(counted(run, "fragments")), double(lists.total()), 1e-3 * double(lists.total()));
    EXPECT_NEAR(double(counted(run, "deepest")), double(lists.deepest()), 2);
}

/// A technique that works in bands, with settings that make one band of the frame and several.
struct Banded {
    std::string_view technique, one_band, bands, draw;  ///< draw: a draw of each band
};

const std::vector<Banded>& banded() {
    static const std::vector<Banded> techniques = {
        {"transparency/sorted_lists", "pool=64", "pool=0.01", "transparency/lists/fill"},
        {"transparency/multi_layer", "pool=64", "pool=0.01", "transparency/lists/fill"},
        {"transparency/adaptive", "pool=64", "pool=0.01", "transparency/adaptive/accumulate"},
        {"transparency/exact_function", "pool=64", "pool=0.01", "transparency/exact_function/accumulate"},
        {"transparency/stochastic", "memory=256", "memory=0.0625", "transparency/stochastic/shade"},
    };
    return techniques;
}

/// An odd number of rows, so that the last band has one, too.
Session& odd_rows() {
    static const auto session = [] {
        std::vector<Frame> frames = scenario_frames("glass_and_smoke");
        frames.push_back(scenario_frames("glass_and_smoke", 4).front());
        for (Frame& frame : frames) frame.view.width = 121, frame.view.height = 69;
        frames.push_back(frames.back());  // smoke at half resolution among panes at full
        for (Emitter& emitter : frames.back().emitters) emitter.resolution = Resolution::low;
        return session_of(std::move(frames));
    }();
    return *session;
}

Request banded_request(std::size_t frame, const Banded& technique, std::string_view setting) {
    return {.variant = {.frame = frame}, .choices = chosen({std::string(technique.technique)}, {std::string(setting)})};
}

/// The rows of the draws with this name, of targets that high, in the order of the plan.
std::vector<Rows> rows_drawn(const Plan& plan, std::string_view name, std::uint32_t height) {
    std::vector<Rows> rows;
    for (const PlannedStep& step : plan.steps) {
        const auto* draw = std::get_if<DrawWork>(&step.step.work);
        if (!draw || step.step.name != name) continue;
        if (plan.images[step.step.attachments.front().image.id].shape.extent.height != height) continue;
        rows.push_back(draw->rows.value_or(Rows{0, height}));
    }
    return rows;
}

TEST(Bands, GiveTheSameBitsAsOneBand) {
    for (const Banded& technique : banded()) {
        for (std::size_t frame = 0; frame < odd_rows().frame_count(); ++frame) {
            SCOPED_TRACE(fmt::format("{}, frame {}", technique.technique, frame));
            Request one = banded_request(frame, technique, technique.one_band),
                    several = banded_request(frame, technique, technique.bands);
            one.outputs = several.outputs = {"color"};
            const auto whole = must(odd_rows().run(one)), parts = must(odd_rows().run(several));
            EXPECT_EQ(whole.images.at("color").texels, parts.images.at("color").texels);
            EXPECT_GT(steps_called(parts, technique.draw), steps_called(whole, technique.draw));
        }
    }
}

TEST(Bands, AreDrawnRowByRowWithoutGapAndWithoutOverlap) {
    for (const Banded& technique : banded()) {
        SCOPED_TRACE(technique.technique);
        const Plan plan = must(odd_rows().plan(banded_request(1, technique, technique.bands))).plan;
        const std::vector<Rows> rows = rows_drawn(plan, technique.draw, 69);
        EXPECT_GT(rows.size(), 2u);
        std::uint32_t next = 0;
        for (const Rows& band : rows) {
            EXPECT_EQ(band.first, next);
            EXPECT_EQ(band.first % 2, 0u) << "no 2x2 quad straddles two bands";
            next = band.first + band.count;
        }
        EXPECT_EQ(next, 69u);
    }
}

TEST(Bands, OfHalfResolutionAreDrawnInHalfTheRows) {
    for (const Banded& technique : {banded()[2], banded()[3]}) {
        const Plan plan = must(odd_rows().plan(banded_request(2, technique, technique.bands))).plan;
        std::uint32_t next = 0;
        for (const Rows& band : rows_drawn(plan, technique.draw, 35)) {
            EXPECT_EQ(band.first, next);
            next = band.first + band.count;
        }
        EXPECT_EQ(next, 35u) << technique.technique;
    }
}

TEST(Bands, OfCurvesFitWhatEveryDeviceBinds) {
    Frame frame = scenario_frames("three_cards", 4).front();
    frame.view.width = 1920, frame.view.height = 1080;
    const auto session = must(Session::open({frame}, {}));
    const Plan plan = must(session->plan({.choices = chosen({"transparency/adaptive"}, {"nodes=16"})})).plan;
    std::uint64_t largest = 0, drawn = 0;
    for (const BufferRecord& buffer : plan.buffers) largest = std::max(largest, buffer.bytes);
    for (const Rows& band : rows_drawn(plan, "transparency/adaptive/accumulate", 1080)) drawn += band.count;
    EXPECT_LE(largest, 128u << 20);
    EXPECT_GT(largest, 100u << 20) << "and bands are no smaller than need be";
    EXPECT_EQ(drawn, 1080u);
}

}  // namespace
}  // namespace strata
