// Plots: where values lie, which numbers stand at the axes, what the mouse means.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_inspector/desk.h"
#include "tests/support/session.h"
#include "ui/widgets/plot.h"

namespace strata::ui {
namespace {

using testing::ElementsAre;

std::vector<std::string> labels(const std::vector<Tick>& ticks) {
    std::vector<std::string> made;
    for (const Tick& tick : ticks)
        if (!tick.label.empty()) made.push_back(tick.label);
    return made;
}

TEST(Ticks, OfALinearAxisAreRoundNumbersThatFit) {
    EXPECT_THAT(labels(ticks({0, 1}, AxisScale::linear, 5)), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1"));
    EXPECT_THAT(labels(ticks({-3, 12}, AxisScale::linear, 4)), ElementsAre("0", "5", "10"));
    EXPECT_THAT(labels(ticks({.013, .019}, AxisScale::linear, 3)), ElementsAre("0.014", "0.016", "0.018"));
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTenWithLinesBetween) {
    const auto made = ticks({.05, 200}, AxisScale::logarithmic, 10);
    EXPECT_THAT(labels(made), ElementsAre("0.1", "1", "10", "100"));
    EXPECT_GT(made.size(), 20u);
    EXPECT_THAT(labels(ticks({1e-6, 1e6}, AxisScale::logarithmic, 5)), ElementsAre("1e-06", "0.001", "1", "1000", "1e+06"));
}

TEST(Ticks, OfLessThanAPowerOfTenAreLinear) {
    EXPECT_THAT(labels(ticks({2, 8}, AxisScale::logarithmic, 4)), ElementsAre("2", "4", "6", "8"));
}

TEST(Axis, PlaceAndValueAreInverse) {
    for (const AxisScale scale : {AxisScale::linear, AxisScale::logarithmic})
        for (const double value : {.02, .5, 3.0, 99.0})
            EXPECT_NEAR(value_at({.01, 100}, scale, place_in({.01, 100}, scale, value)), value, 1e-12 * value + 1e-12);
    EXPECT_DOUBLE_EQ(place_in({.01, 100}, AxisScale::logarithmic, 1), .5);
    EXPECT_DOUBLE_EQ(place_in({-1, 3}, AxisScale::linear, 0), .25);
}

PlotSeries series(std::string label, SeriesKind kind, std::vector<glm::dvec2> points) {
    return {.label = std::move(label), .kind = kind, .points = std::move(points), .color = {1, .5f, 0, 1}};
}

TEST(Range, HoldsAllShownPointsAndNoneThatTheAxisCannotHave) {
    const std::vector all = {series("a", SeriesKind::line, {{0, 1}, {10, 3}}),
                             series("b", SeriesKind::line, {{-5, 100}, {1, 0}})};
    EXPECT_DOUBLE_EQ(range_of(all, {.hidden = {"b"}}, 0, AxisScale::linear).low, -.5);
    EXPECT_DOUBLE_EQ(range_of(all, {.hidden = {"b"}}, 0, AxisScale::linear).high, 10.5);
    EXPECT_NEAR(range_of(all, {}, 1, AxisScale::logarithmic).low, std::pow(10, -.1), 1e-12);
    EXPECT_NEAR(range_of(all, {}, 1, AxisScale::logarithmic).high, std::pow(10, 2.1), 1e-9);
    const AxisRange one = range_of(std::vector{series("c", SeriesKind::scatter, {{4, 4}})}, {}, 0, AxisScale::linear);
    EXPECT_LT(one.low, 4);
    EXPECT_GT(one.high, 4);
}

/// A plot by itself in the whole window.
class PlotWindow {
public:
    PlotWindow() : desk_(&Desk::clean()) {}
    PlotEvent frame() {
        widgets.begin_frame();
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({600, 400});
        ImGui::Begin("plot", nullptr, ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove);
        const PlotEvent event = draw_plot(widgets, {"plot", {"ms", AxisScale::logarithmic}, {"error"}, {560, 340}}, all, view);
        ImGui::End();
        ImGui::Render();
        must(desk_->layer->draw(*ImGui::GetDrawData()));
        return event;
    }
    /// Where it says that a point lies: "fast/1".
    ImVec2 on_screen(std::string_view point) {
        frame();
        widgets.begin_frame();
        return widgets.find(fmt::format("plot/points/{}", point))->from;
    }

    Widgets widgets;
    PlotView view;
    std::vector<PlotSeries> all = {series("fast", SeriesKind::scatter, {{1, .5}, {10, .1}}),
                                   series("steps", SeriesKind::step, {{1, 0}, {5, 1}}),
                                   series("curve", SeriesKind::line, {{2, .2}, {20, .9}})};

private:
    Desk* desk_;
};

TEST(Plot, TheMouseFindsThePointItIsOnAndAClickTakesIt) {
    PlotWindow window;
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = window.on_screen("fast/1");
    window.frame();
    EXPECT_EQ(window.frame().under, (PlotPoint{0, 1}));
    io.MouseDown[0] = true;
    window.frame();
    io.MouseDown[0] = false;
    EXPECT_EQ(window.frame().clicked, (PlotPoint{0, 1}));
    io.MousePos = {-1000, -1000};
    window.frame();
    EXPECT_EQ(window.frame().under, std::nullopt);
}

TEST(Plot, TheWheelZoomsAndADoubleClickShowsEverythingAgain) {
    PlotWindow window;
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = window.on_screen("fast/1");
    window.frame();
    const AxisRange before = range_of(window.all, window.view, 0, AxisScale::logarithmic);
    io.MouseWheel = 3;
    window.frame();
    io.MouseWheel = 0;
    ASSERT_TRUE(window.view.x);
    EXPECT_GT(window.view.x->low, before.low);
    EXPECT_LT(window.view.x->high, before.high);
    EXPECT_EQ(window.frame().under, (PlotPoint{0, 1})) << "the point under the pointer stays there";
    for (int click = 0; click < 2; ++click) {
        io.MouseDown[0] = true;
        window.frame();
        io.MouseDown[0] = false;
        window.frame();
    }
    EXPECT_FALSE(window.view.x);
}

TEST(Plot, TheLegendSwitchesSeriesOff) {
    PlotWindow window;
    window.frame();
    EXPECT_EQ(window.widgets.records().front().path, "plot/legend/fast");
    const WidgetRecord fast = window.widgets.records().front();
    ImGuiIO& io = ImGui::GetIO();
    io.MousePos = {(fast.from.x + fast.to.x) / 2, (fast.from.y + fast.to.y) / 2};
    window.frame();
    io.MouseDown[0] = true;
    window.frame();
    io.MouseDown[0] = false;
    window.frame();
    EXPECT_THAT(window.view.hidden, ElementsAre("fast"));
}

TEST(Plot, ALegendThatIsTooLongForALineGoesOn) {
    PlotWindow window;
    for (int i = 0; i < 20; ++i) window.all.push_back(series(fmt::format("technique {}", i), SeriesKind::line, {{1, 0}, {2, 1}}));
    window.frame();
    for (const WidgetRecord& record : window.widgets.records()) EXPECT_LE(record.to.x, 600) << record.path;
    EXPECT_EQ(window.widgets.records()[0].from.y, window.widgets.records()[1].from.y) << "and fills it first";
}

}  // namespace
}  // namespace strata::ui
