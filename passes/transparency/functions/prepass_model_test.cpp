// Facts about what the model of a prepass holds while it computes.
#include <algorithm>
#include <map>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "passes/stage_input.h"
#include "passes/transparency/functions/model.h"

namespace strata::transparency {
namespace {

struct Seen {
    std::uint32_t projections = 0, lookups = 0;
    std::uint32_t rows_ahead = 0;  ///< most rows by which a thread's latest projected texel is below the pixel it looks up next
    bool are_kept = true;          ///< every projected list is one of those that the input keeps
};

/// Runs a model that counts what it is asked, by several threads at a time.
Seen seen_of(const Frame& frame, std::optional<FragmentLists>& kept) {
    Seen seen;
    std::mutex counting;
    std::map<std::thread::id, std::uint32_t> latest;  // projected rows
    const ImageSet before{{"color", ReferenceImage(frame.view.width, frame.view.height, frame.view.samples)}};
    PrepassModel model;
    model.project = [&](std::span<const Fragment> fragments, glm::uvec2 texel) {
        const std::lock_guard lock(counting);
        ++seen.projections;
        latest[std::this_thread::get_id()] = texel.y;
        seen.are_kept = seen.are_kept && kept && fragments.data() == kept->at(texel.x, texel.y).data();
        return std::vector<double>{1};
    };
    model.function = [&](std::span<const double>, glm::uvec2 texel) -> Transmittance {
        const std::lock_guard lock(counting);
        ++seen.lookups;
        const std::uint32_t row = latest.at(std::this_thread::get_id());
        seen.rows_ahead = std::max(seen.rows_ahead, row - std::min(row, texel.y));
        return [](const Fragment&) { return glm::dvec3(1); };
    };
    function_model({frame, before, &kept}, accumulation_single, model);
    return seen;
}

TEST(PrepassModel, ProjectsATexelOnceJustBeforeItIsRead) {
    for (const std::uint32_t samples : {1u, 4u}) {
        Frame frame = (*find_scenario("three_panes"))->build(0, {.width = 32, .height = 18});
        frame.view.samples = samples;
        std::optional<FragmentLists> kept;
        const Seen seen = seen_of(frame, kept);
        EXPECT_GT(seen.lookups, 0u);
        EXPECT_LE(seen.projections, 32u * 18) << samples;
        EXPECT_LE(seen.rows_ahead, 1u) << samples;
    }
}

/// A second copy would be most of what a model holds: 117 MB of smoke_grenade at 320 x 180.
TEST(PrepassModel, ReadsTheFragmentsThatAreKept) {
    const Frame frame = (*find_scenario("three_panes"))->build(0, {.width = 32, .height = 18});
    std::optional<FragmentLists> kept;
    EXPECT_TRUE(seen_of(frame, kept).are_kept);
}

}  // namespace
}  // namespace strata::transparency
