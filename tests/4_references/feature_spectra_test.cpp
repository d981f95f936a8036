// Feature spectra and the search for modes against the numbers of docs/algorithms/lighting.md 3.4, 3.5, 3.7 and against
// exhaustive search.
#include <algorithm>
#include <bit>
#include <random>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/lighting/mode_search.h"

namespace strata::lighting {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;

constexpr std::uint32_t A = feature_blockers, P = feature_portals, S = feature_shadows, F = feature_soft_shadows,
                        Q = feature_square_spot, T = feature_tube, R = feature_projected_texture, E = feature_area;
constexpr std::uint32_t all_eight = A | P | S | F | Q | T | R | E;

const Histogram example = {{0, 1716},    {A | P, 2917}, {A | S | F | Q, 2154}, {S, 600},
                           {S | Q, 400}, {A | S, 250},  {all_eight, 123}};

ModeProblem problem_of(std::size_t modes) {
    return {.scenes = {{.tiles = example}}, .modes = modes, .cost = weighted_cost, .full = all_eight};
}

std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> modes) {
    std::ranges::sort(modes);
    return modes;
}

std::vector<std::uint32_t> masks(const ModeSet& set) {
    std::vector<std::uint32_t> found;
    for (const Mode& mode : set.modes) found.push_back(mode.features);
    return sorted(std::move(found));
}

/// A random histogram of spectra that use some of the bits.
Histogram random_histogram(std::mt19937& random, std::size_t spectra, std::uint32_t bits) {
    Histogram histogram;
    while (histogram.size() < spectra) histogram[std::uint32_t(random() & random()) & bits] = 1 + random() % 1000;
    return histogram;
}

/// The least cost over every set of at most so many modes, the full one included.
double exhaustive_cost(const ModeProblem& problem) {
    const std::vector<std::uint32_t> modes = candidates(problem);
    double best = cost_of(problem, {});
    for (std::uint64_t set = 0; set < std::uint64_t(1) << modes.size(); ++set) {
        std::vector<std::uint32_t> chosen;
        for (std::size_t i = 0; i < modes.size(); ++i)
            if ((set >> i & 1) != 0 && modes[i] != problem.full) chosen.push_back(modes[i]);
        if (chosen.size() < problem.modes) best = std::min(best, cost_of(problem, chosen));
    }
    return best;
}

TEST(FeatureSpectra, T3_1_TheReadoutOfTheTalksCaptureIsTheTalks) {
    const std::vector<SpectrumRow> rows = {{A | P, 2917, 6, A | P | S | Q | T},
                                           {A | S | F | Q, 2154, 11, A | P | S | F | Q | R | E | T},
                                           {0, 1716, 0, S},
                                           {S, 600, 0, S}};
    EXPECT_EQ(readout(rows),
              "(1) 2917 tiles {Blockers, Portals}, shading mode 6, superfluous {Shadows, Square Spot, Tube}\n"
              "(2) 2154 tiles {Blockers, Shadows, Soft Shadows, Square Spot}, shading mode 11, superfluous {Portals, Projected "
              "Textures, Area, Tube}\n"
              "(3) 1716 tiles <Nothin' Special>, shading mode 0, superfluous {Shadows}\n");
    // The same from a histogram and the masks that the read-out reveals.
    std::vector<Mode> modes(12, {every_light_feature, 100});
    modes[0] = {S, weighted_cost(S)};
    modes[6] = {A | P | S | Q | T, weighted_cost(A | P | S | Q | T)};
    modes[11] = {A | P | S | F | Q | R | E | T, weighted_cost(A | P | S | F | Q | R | E | T)};
    EXPECT_EQ(readout(sorted_rows({{0, 1716}, {A | P, 2917}, {A | S | F | Q, 2154}}, modes)), readout(rows));
    EXPECT_EQ(readout(rows, 1), readout(std::span(rows).first(1)));
    EXPECT_EQ(readout({}), "");
}

TEST(FeatureSpectra, EveryBitHasANameOfItsOwn) {
    const auto names = feature_names();
    ASSERT_EQ(names.size(), light_feature_bits);
    EXPECT_EQ(std::set<std::string_view>(names.begin(), names.end()).size(), names.size());
    EXPECT_EQ(names[std::size_t(std::countr_zero(feature_square_spot))], "Square Spot");
    EXPECT_EQ(names[std::size_t(std::countr_zero(feature_projected_texture))], "Projected Textures");
    EXPECT_EQ(names[std::size_t(std::countr_zero(feature_hair))], "Hair");
    for (std::uint32_t bit = 0; bit < light_feature_bits; ++bit)
        EXPECT_EQ(braced_names(1u << bit), fmt::format("{{{}}}", names[bit]));
    EXPECT_EQ(std::ranges::count(braced_names(every_light_feature), ','), 15);
}

TEST(FeatureSpectra, T3_2_TheFullModeAloneTheIdealAndTheClosureAreTheChapters) {
    EXPECT_EQ(tiles_of(example), 8160u);
    EXPECT_NEAR(cost_of(problem_of(1), {}), 27336.00, 1e-6);
    EXPECT_NEAR(ideal_cost(problem_of(1)), 12881.70, 1e-6);
    EXPECT_EQ(candidates(problem_of(1)).size(), 11u);
    EXPECT_EQ(masks(best_modes(problem_of(1))), std::vector{all_eight});
}

TEST(FeatureSpectra, T3_2_TheOptimaOfTwoToSevenModesAreTheChapters) {
    const std::vector<std::uint32_t> five = {0, A | P, S | Q, A | S | F | Q, all_eight};
    const std::pair<double, std::vector<std::uint32_t>> optima[] = {
        {18217.35, {A | P | S | Q, all_eight}},
        {14788.90, {A | P, A | S | F | Q, all_eight}},
        {13717.30, {A | P, S | Q, A | S | F | Q, all_eight}},
        {13116.70, five},
        {12941.70, {0, A | P, A | S, S | Q, A | S | F | Q, all_eight}},
        {12881.70, {0, A | P, S, A | S, S | Q, A | S | F | Q, all_eight}}};
    for (std::size_t i = 0; i < std::size(optima); ++i) {
        const auto& [cost, modes] = optima[i];
        const ModeSet best = best_modes(problem_of(i + 2));
        EXPECT_NEAR(best.cost, cost, 1e-6) << i + 2;
        EXPECT_NEAR(cost_of(problem_of(i + 2), modes), cost, 1e-6) << i + 2;
        EXPECT_THAT(masks(best), ElementsAreArray(sorted(modes))) << i + 2;
        EXPECT_TRUE(best.proven);
        EXPECT_NEAR(exhaustive_cost(problem_of(i + 2)), cost, 1e-6) << i + 2;
    }
    EXPECT_EQ(best_modes(problem_of(16)).modes.size(), 7u) << "more modes than spectra save nothing";
}

TEST(FeatureSpectra, T3_2_GreedyIsTheChaptersAndOneSwapReachesTheOptimum) {
    const double greedy[] = {18217.35, 15847.95, 14226.40, 13454.20, 13004.20, 12941.70};
    for (std::size_t i = 0; i < std::size(greedy); ++i)
        EXPECT_NEAR(greedy_modes(problem_of(i + 2)).cost, greedy[i], 1e-6) << i + 2;
    for (const std::size_t modes : {3u, 4u, 5u, 6u}) {
        const ModeSet swapped = swapped_modes(problem_of(modes));
        EXPECT_EQ(swapped.swaps, 1u) << modes;
        EXPECT_NEAR(swapped.cost, best_modes(problem_of(modes)).cost, 1e-6) << modes;
    }
}

TEST(FeatureSpectra, T3_5_TheTableIsTheCheapestServingModeOfAll65536Spectra) {
    std::mt19937 random(35);
    for (int round = 0; round < 4; ++round) {
        std::vector<Mode> modes;
        for (int i = 0; i < 12; ++i) {
            const std::uint32_t features = (random() | random()) & every_light_feature;
            modes.push_back({features, round % 2 == 0 ? weighted_cost(features) : double(random() % 4)});  // costs that tie, too
        }
        modes.push_back(modes[3]);  // a mode that is there twice
        if (round < 3) modes.push_back({every_light_feature, weighted_cost(every_light_feature)});
        const std::vector<std::uint8_t> table = mode_table(modes);
        ASSERT_EQ(table.size(), 65536u);
        std::size_t unserved = 0;
        for (std::uint32_t spectrum = 0; spectrum < 65536; ++spectrum) {
            ASSERT_EQ(table[spectrum], choose(modes, spectrum)) << spectrum;
            std::size_t expected = no_mode;
            for (std::size_t i = 0; i < modes.size(); ++i)
                if ((modes[i].features & spectrum) == spectrum && (expected == no_mode || modes[i].cost < modes[expected].cost))
                    expected = i;
            ASSERT_EQ(table[spectrum], expected) << spectrum;
            unserved += expected == no_mode;
        }
        EXPECT_EQ(unserved == 0, round < 3) << "the full mode serves whatever comes";
    }
}

TEST(FeatureSpectra, BranchAndBoundFindsWhatExhaustiveSearchFinds) {
    std::mt19937 random(7);
    int compared = 0;
    for (int round = 0; round < 60; ++round) {
        ModeProblem problem{.scenes = {}, .modes = 2 + random() % 4, .cost = weighted_cost};
        for (int scene = 0; scene <= round % 3; ++scene)
            problem.scenes.push_back({random_histogram(random, 3, 0x3f & std::uint32_t(random() | 0x15)), .5 + scene});
        problem.aim = round % 2 == 0 ? Aim::sum : Aim::worst;
        problem.dispatch = round % 5 == 0 ? 60 : 0;
        if (candidates(problem).size() > 14) continue;  // 16384 sets
        ++compared;
        const ModeSet best = best_modes(problem);
        EXPECT_TRUE(best.proven);
        EXPECT_NEAR(best.cost, exhaustive_cost(problem), 1e-6 * best.cost) << round;
        EXPECT_NEAR(best.cost, cost_of(problem, masks(best)), 1e-9 * best.cost) << round;
        EXPECT_LE(best.cost, swapped_modes(problem).cost * (1 + 1e-9));
        EXPECT_LE(swapped_modes(problem).cost, greedy_modes(problem).cost * (1 + 1e-9));
        EXPECT_LE(best.modes.size(), problem.modes);
    }
    EXPECT_GE(compared, 30);
}

TEST(FeatureSpectra, ASetOfModesDoesNotDependOnTheOrderOfScenesAndIsOrderedByCost) {
    std::mt19937 random(11);
    ModeProblem problem{.scenes = {}, .modes = 6, .cost = weighted_cost};
    for (int scene = 0; scene < 4; ++scene) problem.scenes.push_back({random_histogram(random, 9, 0x007f), 1});
    const ModeSet first = best_modes(problem);
    std::ranges::reverse(problem.scenes);
    const ModeSet second = best_modes(problem);
    ASSERT_EQ(first.modes.size(), second.modes.size());
    for (std::size_t i = 0; i < first.modes.size(); ++i) {
        EXPECT_EQ(first.modes[i].features, second.modes[i].features);
        if (i > 0) {
            EXPECT_LE(first.modes[i - 1].cost, first.modes[i].cost);
        }
    }
    EXPECT_EQ(first.modes.back().features, every_light_feature);
    // Twice the tiles, or twice the weight, are the same question.
    for (Scene& scene : problem.scenes) scene.weight = 2;
    EXPECT_EQ(masks(best_modes(problem)), masks(first));
}

TEST(FeatureSpectra, AModeMoreIsNotTakenWhenItSavesLessThanItsDispatch) {
    ModeProblem problem = problem_of(16);
    // What the best set of one mode more saves, from the optima of docs/algorithms/lighting.md T3.2: 9118.65, 3428.45, 1071.6,
    // 600.6, 175, 60.
    const std::pair<double, std::size_t> counts[] = {{0, 7},   {59, 7},  {61, 6},   {174, 6},
                                                     {176, 5}, {601, 4}, {1072, 3}, {9200, 1}};
    for (const auto& [dispatch, modes] : counts) {
        problem.dispatch = dispatch;
        EXPECT_EQ(best_modes(problem).modes.size(), modes) << dispatch;
    }
}

TEST(FeatureSpectra, TheWorstSceneDecidesWhereItIsAimedAt) {
    const std::uint32_t rare = T | E, frequent = A | P;
    ModeProblem problem{.scenes = {{.tiles = {{frequent, 1000}}, .weight = 10}, {.tiles = {{rare, 5000}}, .weight = .1}},
                        .modes = 2,
                        .cost = weighted_cost};
    EXPECT_EQ(masks(best_modes(problem)), (std::vector{frequent, std::uint32_t(every_light_feature)}));
    for (Scene& scene : problem.scenes) scene.weight = 1;
    problem.aim = Aim::worst;
    EXPECT_EQ(masks(best_modes(problem)), (std::vector{rare, std::uint32_t(every_light_feature)}));
    EXPECT_NEAR(best_modes(problem).cost, 5000 * weighted_cost(rare), 1e-6);
}

TEST(FeatureSpectra, AModeThatLeavesNoMoreWavesThanALargerOneIsDiscarded) {
    // By the optimum of 4 of docs/algorithms/lighting.md T3.2: soft shadows or areas halve the waves, anything else leaves ten.
    ModeProblem problem = problem_of(16);
    problem.waves = [](std::uint32_t features) { return (features & (F | E)) != 0 ? 4u : 10u; };
    const ModeSet best = best_modes(problem);
    const std::vector<std::uint32_t> chosen = masks(best);
    for (const std::uint32_t small : chosen)
        for (const std::uint32_t large : chosen)
            EXPECT_TRUE(small == large || !serves(large, small) || problem.waves(small) != problem.waves(large)) << small;
    EXPECT_EQ(std::ranges::count(chosen, A | S | F | Q), 0) << "as few waves as the full mode";
    EXPECT_THAT(chosen, ElementsAreArray(sorted({A | P, A | S, S | Q, all_eight}))) << "none is another's subset";
    EXPECT_TRUE(best.proven);
    problem.waves = [](std::uint32_t) { return 8u; };
    EXPECT_EQ(masks(best_modes(problem)), std::vector{all_eight}) << "registers that never change leave one mode";
    problem.waves = [](std::uint32_t features) { return std::uint32_t(17 - std::popcount(features)); };
    EXPECT_EQ(masks(best_modes(problem)), masks(best_modes(problem_of(16)))) << "a target that every bit moves discards nothing";
}

TEST(FeatureSpectra, AClosureBeyondTheCapIsReplacedByPairsAndMerges) {
    std::vector<std::uint32_t> bits;
    Histogram histogram;
    for (std::uint32_t bit = 0; bit < 16; ++bit) {
        bits.push_back(1u << bit);
        histogram[1u << bit] = 100 - bit;
    }
    EXPECT_TRUE(union_closure(bits, largest_closure).empty());
    EXPECT_EQ(union_closure(std::span(bits).first(12), largest_closure).size(), 4095u);
    const ModeProblem problem{.scenes = {{.tiles = histogram}}, .modes = 5, .cost = weighted_cost};
    const std::vector<std::uint32_t> found = candidates(problem);
    EXPECT_GE(found.size(), 16u + 120u);
    EXPECT_LE(found.size(), 16u + 120u + 15u);
    EXPECT_EQ(std::ranges::count(found, std::uint32_t(every_light_feature)), 1) << "all merged";
    const ModeSet best = best_modes(problem);
    EXPECT_LT(best.cost, cost_of(problem, {}));
    EXPECT_EQ(best.modes.size(), 5u);
}

TEST(FeatureSpectra, MeasuredCostsAreCompletedWithoutEverCostingLessForMore) {
    std::mt19937 random(3);
    std::map<std::uint32_t, double> known;
    for (int i = 0; i < 25; ++i) {
        const std::uint32_t features = (random() & random()) & 0x3ff;
        known[features] = weighted_cost(features) * (1 + .2 * (double(random() % 1000) / 1000 - .5));
    }
    const ModeCost cost = completed_cost(known);
    for (std::uint32_t features = 0; features < 1024; ++features)
        for (std::uint32_t bit = 0; bit < 10; ++bit) ASSERT_LE(cost(features), cost(features | 1u << bit)) << features;
    // What is monotone already stays; between a subset and a superset lies the middle.
    const ModeCost simple = completed_cost({{0, 1}, {A, 2}, {A | P | S, 4}});
    EXPECT_THAT((std::vector{simple(0), simple(A), simple(A | P | S)}), ElementsAre(1, 2, 4));
    EXPECT_EQ(simple(A | P), 3);
    EXPECT_EQ(simple(P), 2.5);
    EXPECT_EQ(simple(every_light_feature), 4);
    const ModeCost turned = completed_cost({{A, 3}, {A | P, 2}});
    EXPECT_EQ(turned(A), 2.5);
    EXPECT_EQ(turned(A | P), 2.5);
}

TEST(FeatureSpectra, CompilersCyclesAreWeightedByTheWavesThatAreLeft) {
    EXPECT_EQ(occupancy_penalty(10, 10), 1);
    EXPECT_EQ(occupancy_penalty(16, 10), 1);
    EXPECT_DOUBLE_EQ(occupancy_penalty(4, 16), 2);
    EXPECT_DOUBLE_EQ(occupancy_penalty(4, 16, 1), 4);
    const ModeCost cost = compiled_cost({{0, {1000, 16}}, {A, {1200, 16}}, {A | S | F, {1500, 4}}});
    EXPECT_DOUBLE_EQ(cost(0), 1000);
    EXPECT_DOUBLE_EQ(cost(A), 1200);
    EXPECT_DOUBLE_EQ(cost(A | S | F), 3000);
    EXPECT_DOUBLE_EQ(cost(A | S), 2100);
}

TEST(FeatureSpectra, ACompilersWordOnAModeStandsEvenWhereMoreFeaturesCostLess) {
    const ModeCost cost = compiled_cost({{A, {3, 4}}, {A | P, {2, 4}}, {every_light_feature, {9, 4}}});
    EXPECT_EQ(cost(A), 3);
    EXPECT_EQ(cost(A | P), 2);
    const ModeProblem problem{.scenes = {{.tiles = {{A, 10}, {A | P, 1}}}}, .modes = 3, .cost = cost};
    EXPECT_EQ(ideal_cost(problem), 11 * 2) << "a mode of its own for A would cost more than the one of both";
    const ModeSet best = best_modes(problem);
    EXPECT_EQ(best.cost, 11 * 2);
    EXPECT_THAT(masks(best), ElementsAre(A | P, every_light_feature));
}

}  // namespace
}  // namespace strata::lighting
