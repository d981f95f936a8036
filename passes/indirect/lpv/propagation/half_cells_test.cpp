// Facts about cells that hold half floats, on the model (docs/algorithms/lighting.md 7, N13): what is far away survives, a unit
// changes nothing, and sums over 64 steps stay below the largest half float.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "passes/indirect/lpv/propagation/half_cells_model.h"

namespace strata::indirect::in_double {
namespace {

using glm::dvec4, glm::uvec3;
using std::numbers::pi;

constexpr PropagationRule linear_halves{propagation_linear, faces_centre},
    energy_true_halves{propagation_energy_true, faces_centre};
const dvec4 lobe_of_a_watt(.5 / std::sqrt(pi), 0, 0, std::sqrt(pi / 3) / pi);  // of a watt towards +z

/// A grid of so many cells each way with light in its middle cell.
struct LitMiddle {
    std::uint32_t cells;
    Channel channel{std::size_t{cells} * cells * cells};

    LitMiddle(std::uint32_t n, const dvec4& light) : cells(n) { channel[at(n / 2, n / 2, n / 2)] = light; }
    std::size_t at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return cell_index(uvec3(cells), {x, y, z}); }
    Channel summed(const PropagationRule& rule, std::uint32_t steps) const {
        const Links links{uvec3(cells)};
        return propagated_in_halves({links, links}, HalfCells({channel, {}, {}}), {channel, channel}, rule, steps);
    }
};

// T5.8: eight cells away a source of a watt gives 5e-4 of it.
TEST(HalfCells, KeepWhatIsEightCellsAway) {
    const LitMiddle room(41, {.5 / std::sqrt(pi), 0, 0, 0});
    const Channel sum = room.summed(linear_halves, 32);
    struct Row {
        std::uint32_t r;
        double l0, l1;
    };
    for (const Row& row : {Row{1, 9.143692e-2, 1.278159e-2}, Row{2, 3.670566e-2, 4.148318e-3}, Row{4, 8.495548e-3, 7.197236e-4},
                           Row{8, 5.461394e-4, 4.815268e-5}}) {
        const dvec4 cell = sum[room.at(20, 20, 20 + row.r)];
        EXPECT_NEAR(cell.x / row.l0, 1, 2e-3) << row.r << " cells away";
        EXPECT_NEAR(cell.w / row.l1, 1, 5e-3) << row.r << " cells away";
    }
}

// T5.16
TEST(HalfCells, ScaleWithTheirSourceByAnyPowerOfTwo) {
    for (const PropagationRule& rule : {linear_halves, energy_true_halves}) {
        const Channel sum = LitMiddle(9, lobe_of_a_watt).summed(rule, 16);
        for (const double factor : {0x1p-200, .25, 0x1p100}) {
            Channel wanted = sum;
            for (dvec4& cell : wanted) cell *= factor;
            EXPECT_EQ(LitMiddle(9, lobe_of_a_watt * factor).summed(rule, 16), wanted) << factor;
        }
    }
}

TEST(HalfCells, HoldWhatTheyAreGivenToTheNearestHalf) {
    // Of a brightest l0 of 1 sums have a unit of 1 / 128: there half floats between 64 and 128 are 1 / 16 apart, those between
    // 128 and 256 are 1 / 8 apart.
    const HalfCells halves({Channel{{1, 0, 0, 0}}, {}, {}});
    const double half_step = 0x1p-3 / 128 / 2;
    const Channel stored = halves.summed({{1 + .9 * half_step, 1 + 1.1 * half_step, -1 - half_step, .5 + .9 * half_step}});
    EXPECT_EQ(stored[0], dvec4(1, 1 + 2 * half_step, -1, .5 + half_step)) << "a tie goes to the even neighbor";
    EXPECT_EQ(halves.summed({{0x1.8p-23, 0x1.8p-22, 0, 1e9}})[0], dvec4(0, 0x1p-21, 0, 65504. / 128))
        << "no subnormals, no infinity";
    EXPECT_EQ(halves.before_step({{0x1p-26, 0, 0, 0}}, linear_halves)[0].x, 0x1p-26) << "a step's unit is 1 / 4096";
}

/// What the middle cell may hold at most of l0 where every cell of a grid holds a lobe of l0 1 that points wherever it gives the
/// middle most. By symmetry the middle takes of a cell what that cell takes of the middle: `even` of a source (1, 0, 0, 0),
/// `along_x` of (0, 1, 0, 0). Light along y and z gives what that along x gives to the cell whose places are exchanged.
double brightest_middle(const LitMiddle& room, const Channel& even, const Channel& along_x) {
    double most = 0;
    for (std::uint32_t z = 0; z < room.cells; ++z)
        for (std::uint32_t y = 0; y < room.cells; ++y)
            for (std::uint32_t x = 0; x < room.cells; ++x) {
                const glm::dvec3 aimed(along_x[room.at(x, y, z)].x, along_x[room.at(y, x, z)].x, along_x[room.at(z, y, x)].x);
                most += std::abs(even[room.at(x, y, z)].x) + 2 / std::sqrt(3.) * glm::length(aimed);
            }
    return most;
}

TEST(HalfCells, HoldTheBrightestLightThatThereMayBe) {
    const LitMiddle even(25, {1, 0, 0, 0}), along_x(25, {0, 1, 0, 0});
    const Links links{uvec3(25)};
    const double one_step =
        brightest_middle(even, next_step(links, even.channel, linear_halves), next_step(links, along_x.channel, linear_halves));
    const double sum = brightest_middle(even, propagated(links, even.channel, linear_halves, 64),
                                        propagated(links, along_x.channel, linear_halves, 64));
    EXPECT_NEAR(one_step, 6 * .4715413, 1e-5) << "six lobes that face the cell";
    RecordProperty("sum", std::to_string(sum));
    // Clamped faces add a third of the light in the first step at most.
    EXPECT_LT(1.34 * one_step * 0x1p13, 65504);
    EXPECT_LT(1.34 * sum * 0x1p8, 65504);
}

}  // namespace
}  // namespace strata::indirect::in_double
