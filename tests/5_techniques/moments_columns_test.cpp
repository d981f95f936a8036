// T(z) of moments along whole columns, on the device and in double: smoke, ten times as many fragments, ten times the optical
// depth, one fragment, two, and fragments that are nearly at one depth. A frame reads T only at its fragments; here 512 depths
// per column are read, some of them close to where a node is at infinity (four depths per column of eight moments).
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/transparency/moments/model.h"
#include "passes/transparency/moments/moments.shared.h"
#include "replay/probe/probe.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using namespace transparency;

constexpr double near_end = 1, far_end = 50;

/// Fragments of equal optical depth, evenly random within `width` around `center`, in w.
struct FragmentColumn {
    const char* name;
    int fragments;
    double optical_depth, center, width;
};
constexpr FragmentColumn spread_columns[] = {
    {"thin smoke", 150, .02, 0, 1.8},
    {"smoke of ten times as many fragments", 1500, .02, 0, 1.8},
    {"smoke of ten times the optical depth", 150, .2, 0, 1.8},
    {"five fragments", 5, 1, -.1, 1.6},
};
/// So few depths that the matrix of moments is singular but for its bias.
constexpr FragmentColumn degenerate_columns[] = {
    {"one opaque fragment", 1, 10, -.37, 0},
    {"two fragments", 2, .7, -.2, 1},
    {"two opaque fragments at almost one depth", 2, 10, .41, 1e-5},
};

std::vector<WarpedFragment> fragments_of(const FragmentColumn& column) {
    std::mt19937 random(5);
    std::vector<WarpedFragment> projected;
    for (int i = 0; i < column.fragments; ++i)
        projected.push_back({column.center + column.width * (double(random()) / 4294967296. - .5), column.optical_depth});
    return projected;
}

double z_of(double w) { return near_end * std::pow(far_end / near_end, .5 * (w + 1)); }
double w_of(double z) { return 2 * std::log(z / near_end) / std::log(far_end / near_end) - 1; }

ProbedStack stack_of(const std::vector<WarpedFragment>& projected) {
    ProbedStack stack{.nearest = near_end, .farthest = far_end};
    for (const WarpedFragment& fragment : projected)
        stack.fragments.push_back({.depth = z_of(fragment.w),
                                   .transmittance = glm::dvec3(std::exp(-fragment.optical_depth)),
                                   .alpha = -std::expm1(-fragment.optical_depth),
                                   .submission = static_cast<std::uint32_t>(stack.fragments.size())});
    return stack;
}

/// Sums in FP16 are not among them: six and eight of them are noise in such columns (the technique's README).
struct ColumnVariant {
    const char* settings;
    std::uint32_t kind;
    double degenerate_tolerance;  ///< 1.3 to 2 times what is measured: float sums are a few steps finer than the bias of the kind
};

void expect_agreement(const ColumnVariant& variant, const FragmentColumn& column, double tolerance) {
    const MomentsParams params{.kind = variant.kind, .storage = storage_single, .bias = 1, .overestimation = .25f};
    const std::vector<WarpedFragment> projected = fragments_of(column);
    const ProbeOptions options{.variants = {std::string("transparency/moments ") + variant.settings},
                               .samples = column.fragments > 1000 ? 64u : 512u,
                               .from = near_end * 1.001,
                               .to = far_end / 1.001};
    const Probe made = must(probe(session_of_scenarios(), stack_of(projected), options));
    double worst = 0, at = 0;
    for (std::size_t i = 0; i < made.depths.size(); ++i) {
        const double w = w_of(made.depths[i]);
        const double off = std::abs(made.curves[0].through[i].x - transmittance_in_double(params, projected, w));
        if (!(off <= worst)) worst = off, at = w;
    }
    testing::Test::RecordProperty(column.name, fmt::format("{:.2g} at w = {:.5f}", worst, at));
    EXPECT_LE(worst, tolerance) << variant.settings << ", " << column.name << ", at w = " << at;
}

class MomentsColumns : public testing::TestWithParam<ColumnVariant> {};

TEST_P(MomentsColumns, AreWhatTheModelSaysAtEveryDepth) {
    // 5e-4 of it are the half floats in which a probe's T is written.
    for (const FragmentColumn& column : spread_columns) expect_agreement(GetParam(), column, 1e-3);
    for (const FragmentColumn& column : degenerate_columns) expect_agreement(GetParam(), column, GetParam().degenerate_tolerance);
}

std::string kind_name(const testing::TestParamInfo<ColumnVariant>& tested) {
    return std::string(tested.param.settings).substr(5);
}

// Every depth draws all fragments of its column: fewer depths where there are many. Eight moments are where digits are lost.
INSTANTIATE_TEST_SUITE_P(Exhaustive, MomentsColumns,
                         testing::Values(ColumnVariant{"kind=power8", moments_power8, .006},
                                         ColumnVariant{"kind=power4", moments_power4, .05},
                                         ColumnVariant{"kind=power6", moments_power6, .05}),
                         kind_name);

}  // namespace
}  // namespace strata
