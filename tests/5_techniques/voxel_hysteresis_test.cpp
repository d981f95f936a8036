// transparency/voxel over frames: a coarser volume is held, so that slices do not pop (docs/algorithms/transparency.md 6.11).
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/session.h"

namespace strata {
namespace {

// 32 slices; an inch for each is where the curve begins to be logarithmic.
constexpr double nearest = 1, linear = 32 * .0254;
double bend(double farthest) { return std::log1p((farthest - nearest) / linear); }

/// Content along a share of the range's slices, without a gap, and two cards out of sight that pin the range.
Frame filled(double share, double farthest = 50) {
    std::vector<Card> cards;
    for (const double z : {nearest, farthest}) cards.push_back({.center = {1e4, 0, z}, .half = .1f});
    for (int i = 0; i <= 128; ++i) {
        const double z = nearest + linear * std::expm1(share * i / 128 * bend(farthest));
        cards.push_back({.center = {0, 0, z}, .half = float(1.5 * z), .color = {float(i) / 128, 1, 1, .1f}});
    }
    return frame_of_cards(cards, 8);
}

// Of 128 slices as many as 57, of 64 as many as 29: they are halved once more.
const Frame few = filled(.45), many = filled(.85);

struct Volume {
    std::uint64_t halvings = 0, held = 0;
    std::vector<std::byte> color = {};
};

Volume volume_of(Session& session, std::size_t frame, const std::string& hysteresis, std::vector<std::string> outputs = {}) {
    outputs.emplace_back("color");
    const strata::Run run =
        must(session.run({.variant = {.frame = frame},
                          .choices = chosen({voxel}, {"slices=32", "thinnest=1e-5", "hysteresis=" + hysteresis}),
                          .outputs = std::move(outputs)}));
    return {counted(run, "halvings"), counted(run, "halvings held"), run.images.at("color").texels};
}

TEST(VoxelHysteresis, HoldsWhatIsCoarserForSoManyFrames) {
    const auto session = session_of({few, many});
    const Volume thin = volume_of(*session, 0, "0"), thick = volume_of(*session, 1, "0");
    EXPECT_EQ(thick.halvings, thin.halvings + 1);
    for (const std::size_t frame : {0u, 1u, 0u, 1u})
        EXPECT_EQ(volume_of(*session, frame, "0").halvings, thin.halvings + frame) << "off, it flips with every frame";

    constexpr struct {
        std::size_t frame, coarser, held;
    } wanted[] = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {0, 1, 1}, {0, 1, 1}, {0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 0}, {0, 1, 1}};
    for (const auto& [frame, coarser, held] : wanted) {
        const Volume now = volume_of(*session, frame, "3");
        EXPECT_EQ(now.halvings, thin.halvings + coarser);
        EXPECT_EQ(now.held, held);
    }
}

TEST(VoxelHysteresis, IsAsWithoutInAFirstFrame) {
    const auto session = session_of({few, many});
    const Volume without = volume_of(*session, 0, "0");
    EXPECT_EQ(volume_of(*session, 0, "10").color, without.color);
    volume_of(*session, 1, "10");
    EXPECT_NE(volume_of(*session, 0, "10").color, without.color);
    session->forget_memo();
    EXPECT_EQ(volume_of(*session, 0, "10").color, without.color);
}

TEST(VoxelHysteresis, CountsAFrameOnceThatIsLookedAtFromInside) {
    const auto session = session_of({few, many});
    const std::vector<std::string> inside = {voxel + ":warp", voxel + ":slices", voxel + ":normalization"};
    volume_of(*session, 1, "3", inside);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(volume_of(*session, 0, "3", inside).held, 1u);
    EXPECT_EQ(volume_of(*session, 0, "3", inside).held, 0u);
}

TEST(VoxelHysteresis, HoldsTheThicknessWhateverTheRangeBecomes) {
    constexpr double nearer_end = 8;
    const auto session = session_of({many, filled(.1, nearer_end)});
    const auto thickness = [](const Volume& volume, double farthest) {
        return linear * bend(farthest) / 8192 * std::exp2(double(volume.halvings));
    };
    const Volume before = volume_of(*session, 0, "10"), after = volume_of(*session, 1, "10");
    EXPECT_GT(after.held, 0u);
    EXPECT_NE(after.halvings, before.halvings);
    const double ratio = thickness(after, nearer_end) / thickness(before, 50);
    EXPECT_LT(ratio, std::sqrt(2.) + 1e-6);
    EXPECT_GT(ratio, std::sqrt(.5) - 1e-6);
}

}  // namespace
}  // namespace strata
