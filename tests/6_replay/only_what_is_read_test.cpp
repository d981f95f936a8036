// Products without a reader in view are not made, and making them changes no pixel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "captures/scenarios.h"
#include "replay/images/image_io.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using testing::Contains;

constexpr EyeMove turned_away{.pan = 3.14}, half_away{.pan = 1.2}, far_away{.dolly = -60};

struct SeenFrom {
    std::string scenario;
    EyeMove eye;
    std::uint32_t samples = 1;
    std::vector<std::string> uses = {};
};
void PrintTo(const SeenFrom& from, std::ostream* out) { *out << from.scenario << ' ' << text(from.eye); }

Request seen(const SeenFrom& from) {
    Request request = on_scenario(from.scenario, from.samples);
    request.variant.eye = from.eye;
    if (!from.uses.empty()) request.choices = chosen(from.uses);
    return request;
}

Run with_unused(Request request) {
    request.variant.force.assign(all_features().begin(), all_features().end());
    return must(session_of_scenarios().run(request));
}

class UsedProducts : public testing::TestWithParam<SeenFrom> {
protected:
    static void expect_pixels_of_all_products(std::uint32_t extent_divisor) {
        Request request = seen(GetParam());
        request.outputs = {"color", "display"};
        request.variant.extent_divisor = extent_divisor;
        const auto run = must(session_of_scenarios().run(request));
        const auto all = with_unused(request);
        for (const auto& [name, image] : run.images) EXPECT_EQ(hash_of(image), hash_of(all.images.at(name))) << name;
    }
};
class ExhaustiveUsedProducts : public UsedProducts {};

TEST_P(UsedProducts, GiveThePixelsOfAFrameWithAllProducts) { expect_pixels_of_all_products(4); }
TEST_P(ExhaustiveUsedProducts, GiveThePixelsOfAFrameWithAllProducts) { expect_pixels_of_all_products(1); }

std::vector<SeenFrom> frames_with_products() {
    std::vector<SeenFrom> all;
    for (const char* scenario : {"two_rooms", "night_market", "roof_in_rain", "spot_and_box"})
        for (const EyeMove& eye : {turned_away, half_away}) all.push_back({scenario, eye});
    all.push_back({"courtyard", far_away});
    all.push_back({"agents_hq", turned_away, 4});
    all.push_back({"agents_hq", half_away, 1, {"shadows/min_max", "lighting/tiled"}});
    all.push_back({"hall_with_shafts", turned_away, 4});
    return all;
}

/// Turned away, half away, far, ahead, below the ground, and aside.
std::vector<SeenFrom> every_scenario_from_everywhere() {
    std::vector<SeenFrom> all;
    for (const Scenario& scenario : scenarios())
        for (const EyeMove& eye : {turned_away, half_away, far_away, EyeMove{.dolly = 2.5}, EyeMove{.pedestal = -3, .tilt = .6},
                                   EyeMove{.truck = 4, .pan = -.8}})
            all.push_back({std::string(scenario.name), eye});
    return all;
}

INSTANTIATE_TEST_SUITE_P(Views, UsedProducts, testing::ValuesIn(frames_with_products()));
INSTANTIATE_TEST_SUITE_P(Views, ExhaustiveUsedProducts, testing::ValuesIn(every_scenario_from_everywhere()));

struct LeftOut {
    SeenFrom from;
    const char* product;
    const char* why;
    const char* counter;  ///< of what is made
};
void PrintTo(const LeftOut& left_out, std::ostream* out) { PrintTo(left_out.from, out); }

/// 0 where nothing counts.
std::uint64_t made(const Run& run, std::string_view counter) {
    const auto found = std::ranges::find(run.counters, counter, &CounterRecord::name);
    return found == run.counters.end() ? 0 : found->value;
}

class Products : public testing::TestWithParam<LeftOut> {};

TEST_P(Products, WithoutAReaderAreLeftOutWithTheReason) {
    const auto& [from, product, why, counter] = GetParam();
    Request request = seen(from);
    request.once = true;  // a stage that is kept from another run declares nothing
    const auto has_name = testing::Field(&CulledStep::name, product);
    const auto run_anew = [&](const auto& made_by) {
        session_of_scenarios().forget_memo();  // what frames before it left need not be made again
        return made_by();
    };
    const auto run = run_anew([&] { return must(session_of_scenarios().run(request)); });
    const auto all = run_anew([&] { return with_unused(request); });
    EXPECT_THAT(run.culled, Contains(testing::AllOf(has_name, testing::Field(&CulledStep::reason, why))));
    EXPECT_THAT(all.culled, Not(Contains(has_name)));
    if (!std::string_view(counter).empty()) {
        EXPECT_LT(made(run, counter), made(all, counter));
    }
    request.variant.eye = {};
    EXPECT_THAT(must(session_of_scenarios().run(request)).culled, Not(Contains(has_name)));
}

INSTANTIATE_TEST_SUITE_P(
    Unseen, Products,
    testing::Values(LeftOut{{"night_market", turned_away}, "light grid 0", "nothing in view is in it", "injected"},
                    LeftOut{{"two_rooms", turned_away}, "light grid 0", "nothing in view is in it", "cells relit"},
                    LeftOut{{"roof_in_rain", turned_away}, "rain map 0", "no surface is in view", ""},
                    LeftOut{{"courtyard", far_away},
                            "shadow map 0 of the sun",
                            "no surface in view is in its range of depth",
                            "kilotexels_drawn"},
                    LeftOut{{"agents_hq", turned_away},
                            "shadow map 2 of 'lamp 42'",
                            "no surface in view is in what it sees of the light's range",
                            "kilotexels_drawn"}),
    [](const auto& named) { return named.param.from.scenario; });

}  // namespace
}  // namespace strata
