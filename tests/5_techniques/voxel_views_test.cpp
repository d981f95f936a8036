// The views and tables of transparency/voxel: what they show is what is in the volume.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "tests/5_techniques/voxel_name.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::uint32_t extent = 8;

Frame cards_at(std::initializer_list<double> depths, float alpha = .5f) {
    std::vector<Card> cards;
    for (const double z : depths) cards.push_back({.center = {0, 0, z}, .half = float(1.5 * z), .color = {1, 1, 1, alpha}});
    return frame_of_cards(cards, extent);
}

strata::Run run_of(const Frame& frame, std::vector<std::string> sets, const std::vector<std::string>& inside) {
    Request request{.choices = chosen({voxel}, std::move(sets)), .outputs = {"color"}};
    for (const std::string& name : inside) request.outputs.push_back(voxel + ":" + name);
    return must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
}

/// Least and most.
using Range = std::array<double, 2>;
/// Of a view's channel.
Range shown(const strata::Run& run, const std::string& view, int channel = 0) {
    Range reach{INFINITY, -INFINITY};
    for (const glm::dvec4& texel : in_double(run.images.at(voxel + ":" + view)).texels)
        reach = {std::min(reach[0], texel[channel]), std::max(reach[1], texel[channel])};
    return reach;
}

Range self_occlusion(const Frame& frame, std::vector<std::string> sets) {
    return shown(run_of(frame, std::move(sets), {"self-occlusion"}), "self-occlusion");
}

const std::vector<std::vector<double>>& rows_of(const strata::Run& run, const std::string& table) {
    return run.tables.at(voxel + ":" + table).rows;
}

double summed(const std::vector<std::vector<double>>& rows, std::size_t column) {
    double sum = 0;
    for (const std::vector<double>& row : rows) sum += row[column];
    return sum;
}

// docs/algorithms/transparency.md 6.7: linear samples one slice in front read up to a quarter of the fragment itself, two in
// front nothing.
TEST(ExhaustiveVoxelViews, SelfOcclusionIsWhatAFragmentReadsOfItself) {
    double most = 0;
    for (int i = 0; i < 16; ++i) {
        const Frame frame = cards_at({5 + .03 * i, 9});
        const std::vector<std::string> few = {"volume=dense", "range=fixed", "bits=16"};
        EXPECT_EQ(self_occlusion(frame, few), (Range{0, 0}));
        EXPECT_EQ(self_occlusion(frame, {few[0], few[1], few[2], "splatting=point", "sampling=point"}), (Range{0, 0}));
        EXPECT_LE(self_occlusion(frame, {few[0], few[1], few[2], "sampling=bicubic"})[1], .0012 * std::log(2.));
        most = std::max(most, self_occlusion(frame, {few[0], few[1], few[2], "shift=1"})[1]);
    }
    EXPECT_NEAR(most, .25 * std::log(2.), .01);
}

TEST(ExhaustiveVoxelViews, SelfOcclusionIsWhereAColumnHoldsMoreThanAPixel) {
    const std::vector<Card> slanted{{.center = {0, 0, 5}, .half = 2, .color = {1, 1, 1, .9f}, .tilt = .8}};
    const Frame frame = frame_of_cards(slanted, 64);
    EXPECT_EQ(self_occlusion(frame, {}), (Range{0, 0}));
    const Range coarse = self_occlusion(frame, {"resolution=eighth"});
    EXPECT_EQ(coarse[0], 0);
    EXPECT_GT(coarse[1], .1);
    EXPECT_LE(coarse[1], std::log(255.) + 1e-4);
}

TEST(VoxelViews, ASliceShowsItsOwnAndWhatIsInFrontOfIt) {
    const Frame frame = cards_at({5, 5.001, 20});
    const std::vector<std::string> sets = {"volume=dense", "range=fixed", "splatting=point", "sampling=point"};
    const auto histogram = rows_of(run_of(frame, sets, {"histogram"}), "histogram");
    ASSERT_EQ(histogram.size(), 128u);
    const auto first = std::ranges::find_if(histogram, [](const auto& row) { return row[3] > 0; });
    ASSERT_NE(first, histogram.end());
    EXPECT_LT((*first)[0], 5);
    EXPECT_GT((*first)[1], 5.001);
    EXPECT_EQ((*first)[3], double(extent * extent));
    EXPECT_EQ(summed(histogram, 3), 2. * extent * extent);
    const auto at = static_cast<int>((*first)[2]);
    const double two = 64 * std::log(255.) / 255;
    for (const int offset : {-1, 0, 1}) {
        std::vector<std::string> chosen = sets;
        chosen.push_back(fmt::format("shown_slice={}", at + offset));
        const strata::Run run = run_of(frame, chosen, {"slice", "slice integral"});
        EXPECT_NEAR(shown(run, "slice")[0], offset == 0 ? two : 0, 1e-5) << offset;
        EXPECT_NEAR(shown(run, "slice integral")[1], offset < 0 ? 0 : two, 1e-5) << offset;
    }
}

TEST(VoxelViews, TablesAddUpToTheCounters) {
    const Frame frame = cards_at({5, 5, 5, 7, 9}, .99f);
    for (const char* volume : {"volume=dense", "volume=adaptive"}) {
        const strata::Run run = run_of(frame, {volume}, {"slices", "histogram", "overflows", "divider"});
        const auto& histogram = rows_of(run, "histogram");
        const auto& divider = rows_of(run, "divider").at(0);
        const std::size_t used = rows_of(run, "slices").size();
        EXPECT_EQ(divider[0], double(counted(run, "halvings")));
        EXPECT_EQ(divider[2], double(histogram.size()));
        EXPECT_EQ(divider[3], double(used));
        EXPECT_EQ(std::ranges::count_if(histogram, [](const auto& row) { return row[2] >= 0; }), std::ptrdiff_t(used));
        for (const auto& slice : rows_of(run, "slices"))
            EXPECT_EQ(slice[0], histogram.at(static_cast<std::size_t>(slice[2]))[0]) << volume;
        EXPECT_GT(counted(run, "overflowed"), 0u);
        EXPECT_EQ(summed(rows_of(run, "overflows"), 2), double(counted(run, "overflowed")));
        EXPECT_EQ(summed(rows_of(run, "overflows"), 3), double(counted(run, "saturated")));
    }
}

// Red light passes, green and blue are absorbed three times in one slice.
TEST(VoxelViews, TellChannelsApart) {
    Frame frame = cards_at({5, 5, 5}, 1);
    for (Material& material : frame.materials) material.transmission = {1, 0, 0};
    for (const char* packing : {"packing=planes", "packing=rgb10"}) {
        const strata::Run run = run_of(frame, {packing}, {"overflow", "thickness"});
        EXPECT_EQ(shown(run, "overflow", 0), (Range{0, 0})) << packing;
        for (const int absorbed : {1, 2}) EXPECT_GT(shown(run, "overflow", absorbed)[0], 0) << packing;
        EXPECT_GT(shown(run, "thickness")[0], 0) << packing;
    }
}

/// Black, and never the color of the most: where there is nothing, a sentence can say it.
TEST(VoxelViews, NoneIsZero) {
    const Frame thin = cards_at({5, 9}), thick = cards_at({5, 5, 9}, .99f);
    for (const char* view : {"overflow", "saturation depth"}) {
        EXPECT_EQ(shown(run_of(thin, {}, {view}), view), (Range{0, 0})) << view;
        EXPECT_GT(shown(run_of(thick, {}, {view}), view)[0], 0) << view;
    }
    const double depth = shown(run_of(thick, {}, {"saturation depth"}), "saturation depth")[0];
    EXPECT_GT(depth, 4.9);
    EXPECT_LT(depth, 5.3);
}

TEST(VoxelViews, SayWhenThereIsNothingToShow) {
    for (const DebugView& view : must(find_technique(voxel))->views) {
        const bool has_nothing = view.help.find("; 0: ") != view.help.npos || view.name == "culled";
        EXPECT_TRUE(!has_nothing || !view.if_zero.empty()) << view.name;
    }
}

}  // namespace
}  // namespace strata
