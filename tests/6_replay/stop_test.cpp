// What takes long can be stopped from outside, and what was stopped leaves a session that works.
#include <gtest/gtest.h>

#include "replay/images/image_io.h"
#include "replay/report/report.h"
#include "tests/support/session.h"

namespace strata {
namespace {

TEST(Stopped, EveryCallEndsAtOnceUntilThereIsAnotherToken) {
    const auto session = scenario_session("three_panes");
    const std::string before = display_hash(*session);
    session->forget_memo();
    std::stop_source stop;
    session->stop_when(stop.get_token());
    EXPECT_EQ(display_hash(*session), before);
    session->forget_memo();
    stop.request_stop();
    const Request request;
    const auto is_stopped = [](const auto& result) { return !result && result.error().fault == Fault::stopped; };
    EXPECT_TRUE(is_stopped(session->run(request)));
    EXPECT_TRUE(is_stopped(session->run({.acts = Acts::brought_back})));
    EXPECT_TRUE(is_stopped(session->run(scenario_frames("one_pane").front(), std::span(&request, 1))));
    EXPECT_TRUE(is_stopped(session->time(std::span(&request, 1), 1)));
    EXPECT_TRUE(is_stopped(session->truth(request, Stage::transparency)));
    EXPECT_TRUE(is_stopped(session->judge(request, Stage::transparency)));
    EXPECT_TRUE(is_stopped(session->step_images(request, Stage::transparency)));
    EXPECT_TRUE(is_stopped(session->pixel_steps(request, {})));
    EXPECT_TRUE(is_stopped(session->transparent_fragments(request)));
    session->stop_when({});
    EXPECT_EQ(display_hash(*session), before);
}

TEST(Stopped, AReportEndsAtTheRowThatIsBeingMade) {
    const auto session = scenario_session("three_panes");
    const std::string before = display_hash(*session);
    const std::string second(techniques_of(Stage::transparency)[1]->name);
    std::stop_source stop;
    session->stop_when(stop.get_token());
    std::vector<std::string> told;
    const auto report = make_report(*session, {.repeats = 1}, [&](std::string_view what, double) {
        told.emplace_back(what);
        if (what.starts_with(second)) stop.request_stop();
    });
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().fault, Fault::stopped);
    EXPECT_TRUE(told.back().starts_with(second)) << told.back();
    session->stop_when({});
    EXPECT_EQ(display_hash(*session), before);
}

TEST(Stopped, TimingTellsHowFarItIsAndEndsBetweenRuns) {
    const auto session = scenario_session("three_panes");
    const std::vector<Request> requests(2);
    std::vector<double> shares;
    must(session->time(requests, 3, [&](std::string_view, double done) { shares.push_back(done); }));
    ASSERT_EQ(shares.size(), 8u);  // a warm-up and three repeats of two
    for (std::size_t i = 0; i < shares.size(); ++i) EXPECT_DOUBLE_EQ(shares[i], double(i) / 8);
    std::stop_source stop;
    session->stop_when(stop.get_token());
    std::size_t calls = 0;
    const auto stopped = session->time(requests, 1000, [&](std::string_view, double) {
        if (++calls == 5) stop.request_stop();
    });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().fault, Fault::stopped);
    EXPECT_EQ(calls, 5u);
}

}  // namespace
}  // namespace strata
