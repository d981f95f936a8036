// Whole frames: the picture of min-max shadow maps is that of full filtering bit by bit, and what is counted in total, by map and
// by pixel is the same.
#include <algorithm>

#include <gtest/gtest.h>

#include "replay/images/host_image.h"
#include "tests/support/session.h"

namespace strata {
namespace {

constexpr std::string_view technique = "shadows/min_max";

Run run_of(std::string_view scenario, const std::string& use, const std::vector<std::string>& sets) {
    Request request = on_scenario(scenario);
    request.choices = chosen({use}, sets);
    request.outputs = {"visibility"};
    if (use == technique)
        for (const char* inside : {":classes_by_map", ":class"}) request.outputs.push_back(use + inside);
    return must(session_of_scenarios().run(request));
}

double total(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique == technique && counter.name == name) return double(counter.value);
    ADD_FAILURE() << "no counter " << name;
    return 0;
}

double sum_of_column(const Run& run, std::size_t column) {
    double sum = 0;
    for (const std::vector<double>& row : run.tables.at("shadows/min_max:classes_by_map").rows) sum += row[column];
    return sum;
}

/// Pixels whose lookup of the shown light is expensive: red.
double red_pixels(const Run& run) {
    const HostImage& shown = run.images.at("shadows/min_max:class");
    double count = 0;
    for (std::uint32_t y = 0; y < shown.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < shown.shape.extent.width; ++x)
            count += texel(shown, x, y).x == 1 && texel(shown, x, y).y == 0;
    return count;
}

TEST(MinMax, HasTheBitsOfFullFilteringInEveryMapWhereverThatLies) {
    // Cascades; a spot; a spot, the faces of a globe and a hazy sun, each in a layer of its own and side by side.
    for (const std::string_view scenario : {"sun_and_boxes", "spot_and_box", "soft_shadows"})
        for (const char* allocation : {"allocation=own", "allocation=need"}) {
            const auto full = run_of(scenario, "shadows/pcf", {"kernel=8x8", allocation});
            for (const char* form : {"form=hierarchical", "form=overlapping", "form=slab"}) {
                const auto early = run_of(scenario, std::string(technique), {"kernel=8x8", allocation, form, "block=8"});
                EXPECT_EQ(early.images.at("visibility").texels, full.images.at("visibility").texels)
                    << scenario << " " << allocation << " " << form;
                EXPECT_GT(total(early, "lit"), 1000) << scenario << " " << form;
            }
        }
}

TEST(MinMax, CountsLookupsByMapAndInTotalAlike) {
    const auto run = run_of("sun_and_boxes", std::string(technique), {"verify=on"});
    EXPECT_EQ(total(run, "mismatches"), 0);
    EXPECT_EQ(sum_of_column(run, 0), total(run, "lit"));
    EXPECT_EQ(sum_of_column(run, 1), total(run, "shadowed"));
    EXPECT_EQ(sum_of_column(run, 2), total(run, "expensive"));
    // Every sample is looked up, where cascades blend twice.
    const double lookups = total(run, "lit") + total(run, "shadowed") + total(run, "expensive") + total(run, "outside");
    EXPECT_GE(lookups, total(run, "filtered"));
    EXPECT_LT(lookups, 2 * total(run, "filtered"));
    EXPECT_LE(red_pixels(run), total(run, "expensive"));
    EXPECT_GT(red_pixels(run), 0.8 * total(run, "expensive")) << "but where cascades blend, a pixel has one lookup";
    EXPECT_EQ(run.tables.at("shadows/min_max:classes_by_map").rows.size(), 3u);
}

}  // namespace
}  // namespace strata
