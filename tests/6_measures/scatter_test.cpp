// The plot of a page: read back from its SVG.
#include <cmath>
#include <random>
#include <regex>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/report/page/scatter.h"
#include "replay/report/seen.h"

namespace strata {
namespace {

using testing::HasSubstr;

struct Drawn {
    std::size_t row = 0;
    double x = 0, y = 0;
    bool is_full = false;
};

std::vector<Drawn> marks_of(const std::string& svg) {
    std::vector<Drawn> marks;
    const std::regex mark(
        "<path class=\"pt c\\d (full|open)\" data-i=\"(\\d+)\" d=\"[^\"]*\" transform=\"translate\\(([-.\\d]+) ([-.\\d]+)\\)\"");
    for (std::sregex_iterator at(svg.begin(), svg.end(), mark), end; at != end; ++at)
        marks.push_back({std::stoul((*at)[2]), std::stod((*at)[3]), std::stod((*at)[4]), (*at)[1] == "full"});
    return marks;
}

struct TextBox {
    double x0, y0, x1, y1;
    bool meets(const TextBox& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
};

/// Boxes around letters: half a text's height above and below its middle, .55 of it wide each.
std::vector<TextBox> labels_of(const std::string& svg) {
    std::vector<TextBox> boxes;
    const std::regex label(
        "<text class=\"lb[^\"]*\" data-i=\"\\d+\" x=\"([-.\\d]+)\" y=\"([-.\\d]+)\" text-anchor=\"(\\w+)\">([^<]*)</text>");
    for (std::sregex_iterator at(svg.begin(), svg.end(), label), end; at != end; ++at) {
        const double wide = double((*at)[4].length()) * .55 * 12, x = std::stod((*at)[1]), y = std::stod((*at)[2]);
        const double begin = (*at)[3] == "start" ? x : (*at)[3] == "end" ? x - wide : x - wide / 2;
        boxes.push_back({begin, y - 9, begin + wide, y + 2});
    }
    return boxes;
}

ScatterPlot random_plot(std::size_t points) {
    ScatterPlot plot{.x_title = "time", .y_title = "error"};
    std::mt19937 random(5);
    for (std::size_t i = 0; i < points; ++i) {
        const auto draw = [&] { return std::pow(10, 3 * double(random()) / double(std::mt19937::max())); };
        const double x = draw(), y = draw();
        plot.points.push_back({.label = fmt::format("technique {} key=value", i),
                               .place = i,
                               .kind = i % 14,
                               .x = x,
                               .y = y,
                               .low_x = x / 1.1,
                               .high_x = x * 1.1});
    }
    return plot;
}

TEST(Scatter, LabelsMeetNeitherEachOtherNorMarks) {
    for (const std::size_t count : {3u, 30u, 120u}) {
        const std::string svg = as_svg(random_plot(count));
        const std::vector<TextBox> labels = labels_of(svg);
        const std::vector<Drawn> marks = marks_of(svg);
        ASSERT_EQ(marks.size(), count);
        EXPECT_GT(labels.size(), count < 100 ? count * 2 / 3 : 20u);
        for (std::size_t i = 0; i < labels.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(labels[i].meets(labels[j])) << count << ": " << i << " and " << j;
            for (const Drawn& mark : marks)
                EXPECT_FALSE(labels[i].meets({mark.x - 4, mark.y - 4, mark.x + 4, mark.y + 4}))
                    << count << ": " << i << " and " << mark.row;
        }
        const std::string left_out = fmt::format("{} point", count - labels.size());
        EXPECT_EQ(svg.find(left_out) != svg.npos, labels.size() < count);
    }
}

TEST(Scatter, AxesAreLogarithmicAndWhatNothingBeatsIsFilled) {
    const ScatterPlot plot{.points = {{.label = "a", .place = 0, .x = 1, .y = 8},
                                      {.label = "b", .place = 1, .x = 2, .y = 4},
                                      {.label = "c", .place = 2, .x = 4, .y = 2},
                                      {.label = "d", .place = 3, .x = 4, .y = 4}}};
    const std::vector<Drawn> marks = marks_of(as_svg(plot));
    ASSERT_EQ(marks.size(), 4u);
    EXPECT_NEAR(marks[1].x - marks[0].x, marks[2].x - marks[1].x, .2) << "each twice the other";
    EXPECT_NEAR(marks[1].y - marks[0].y, marks[2].y - marks[1].y, .2);
    EXPECT_GT(marks[2].y, marks[0].y) << "less error is further down";
    EXPECT_TRUE(marks[0].is_full && marks[1].is_full && marks[2].is_full);
    EXPECT_FALSE(marks[3].is_full);
}

TEST(Scatter, WhatIsBelowTheFloorLiesInTheStripAndNamesAreEscaped) {
    const ScatterPlot plot{.points = {{.label = "<exact & \"so\">", .place = 0, .x = 3, .y = 1e-9},
                                      {.label = "b", .place = 1, .x = 1, .y = 2},
                                      {.label = "c", .place = 2, .x = 2, .y = 0}},
                           .y_floor = .01,
                           .strip_title = "exact"};
    const std::string svg = as_svg(plot);
    const std::vector<Drawn> marks = marks_of(svg);
    EXPECT_EQ(marks[0].y, marks[2].y);
    EXPECT_GT(marks[0].y, marks[1].y);
    EXPECT_THAT(svg, HasSubstr(">exact</text>"));
    EXPECT_THAT(svg, HasSubstr("&lt;exact &amp; &quot;so&quot;&gt;"));
}

TEST(Scatter, BarsEndWithinThePlot) {
    const ScatterPlot plot{.points = {{.label = "a", .place = 0, .x = 1, .y = 8, .low_x = .2, .high_x = 1.5},
                                      {.label = "b", .place = 1, .x = 2, .y = 4, .low_x = 1.9, .high_x = 30}}};
    const std::string svg = as_svg(plot);
    const std::regex bar("<line class=\"sp c\\d\" x1=\"([-.\\d]+)\" x2=\"([-.\\d]+)\"");
    std::size_t bars = 0;
    for (std::sregex_iterator at(svg.begin(), svg.end(), bar), end; at != end; ++at, ++bars) {
        EXPECT_GE(std::stod((*at)[1]), 58);
        EXPECT_LE(std::stod((*at)[2]), 708);
        EXPECT_LT(std::stod((*at)[1]), std::stod((*at)[2]));
    }
    EXPECT_EQ(bars, 2u);
}

TEST(SeenClasses, AreOfTheirBounds) {
    for (const auto& [error, words] : {std::pair(0., "not seen"),
                                       {.00499, "not seen"},
                                       {.005, "seen only when switching"},
                                       {.0199, "seen when looked for"},
                                       {.02, "visible"},
                                       {.05, "obvious"},
                                       {.1, "wrong"},
                                       {HUGE_VAL, "wrong"}})
        EXPECT_STREQ(seen_as(error).words, words) << error;
}

}  // namespace
}  // namespace strata
