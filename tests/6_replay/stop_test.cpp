// What takes long can be stopped from outside, and what was stopped leaves a session that works.
#include <atomic>
#include <chrono>
#include <ctime>
#include <thread>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/estimated_image.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "replay/report/report.h"
#include "replay/session/until_stopped.h"
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
    EXPECT_TRUE(is_stopped(session->run({.passes = Passes::read_back})));
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

TEST(Stopped, AReportHasTheRowsThatWereMade) {
    const auto session = scenario_session("three_panes");
    const std::string before = display_hash(*session);
    const std::string second = fmt::format(", {}", techniques_of(Stage::transparency)[0]->name);  // after the unit of time
    std::stop_source stop;
    session->stop_when(stop.get_token());
    std::vector<std::string> told;
    const auto report = make_report(*session, {.repeats = 1}, [&](std::string_view what, double) {
        told.emplace_back(what);
        if (what.ends_with(second)) stop.request_stop();
    });
    ASSERT_TRUE(report) << report.error().sentence;
    ASSERT_EQ(report->rows.size(), 1u);
    EXPECT_EQ(report->rows[0].technique, "transparency/alpha_blend");
    EXPECT_FALSE(report->is_timed);
    EXPECT_TRUE(report->stopped.starts_with("stopped after the errors of 1 of ")) << report->stopped;
    EXPECT_EQ(told.back(), "done");
    EXPECT_TRUE(told[told.size() - 2].ends_with(second)) << "nothing is begun after it: " << told[told.size() - 2];
    session->stop_when({});
    EXPECT_EQ(display_hash(*session), before);
}

TEST(Stopped, TimingTellsHowFarItIsAndEndsBetweenRuns) {
    // On a device of its own, which has no pipelines of other tests.
    const auto session = must(Session::open(scenario_frames("three_panes"), {.validation = true}));
    const std::vector<Request> requests(2);
    std::vector<double> shares;
    must(session->time(requests, 3, [&](std::string_view, double done) { shares.push_back(done); }));
    ASSERT_EQ(shares.size(), 8u);  // a warm-up and three repeats of two
    for (std::size_t i = 0; i < shares.size(); ++i) EXPECT_DOUBLE_EQ(shares[i], double(i) / 8);
    shares.clear();
    must(session->time(requests, 3, [&](std::string_view, double done) { shares.push_back(done); }));
    EXPECT_EQ(shares.size(), 6u) << "every pipeline is there, so the first turn counts";
    for (const std::size_t last : {2u, 3u, 5u, 8u}) {
        std::stop_source stop;
        session->stop_when(stop.get_token());
        std::size_t calls = 0;
        const auto stopped = session->time(requests, 1000, [&](std::string_view, double) {
            if (++calls == last) stop.request_stop();
        });
        EXPECT_EQ(calls, last);
        const std::size_t complete = (last - 1) / 2;  // turns
        ASSERT_EQ(bool(stopped), complete > 0);
        if (!stopped) EXPECT_EQ(stopped.error().fault, Fault::stopped);
        else EXPECT_EQ(stopped->back().frame_ms->repeats, complete);
    }
}

TEST(Stopped, AnEstimateEndsAtTheNextSample) {
    const Frame frame = scenario_frames("corners").front();
    const ReferenceImage texels(160, 90, 1, glm::dvec4(1));
    std::stop_source stop;
    std::atomic<std::size_t> batches = 0;
    std::chrono::milliseconds each(1);  // a core that is busy elsewhere does not hear of the stop before its turn
    const auto batch = [&](const SurfacePoint&, DrawnNumbers) {
        ++batches;
        stop.request_stop();
        std::this_thread::sleep_for(each);
        return glm::dvec3(0);
    };
    const auto make = [&] { estimated_image(frame, {texels, texels}, 2, glm::dvec4(0), batch); };
    EXPECT_FALSE(until_stopped(stop.get_token(), make));
    EXPECT_GE(batches, 2u);
    EXPECT_LE(batches, 288u) << "1 of 100";
    batches = 0;
    each = {};
    EXPECT_FALSE(until_stopped(stop.get_token(), make)) << "requested before";
    EXPECT_EQ(batches, 0u);
    EXPECT_TRUE(until_stopped({}, make));
    EXPECT_EQ(batches, 2u * 160 * 90);
}

/// Seconds of the process, which do not depend on what else the machine does.
double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// The light that 160 x 90 samples gather takes half a minute.
TEST(Stopped, ATruthDoesNotRunToItsEnd) {
    const auto session = scenario_session("courtyard");
    const Request request{.choices = chosen({"indirect/ambient"}), .outputs = {"indirect"}};
    must(session->run(request));
    for (const bool is_judged : {false, true}) {
        std::stop_source stop;
        session->stop_when(stop.get_token());
        const double begin = cpu_seconds();
        const std::jthread stops([&] {
            while (cpu_seconds() < begin + .3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            stop.request_stop();
        });
        const auto fault = is_judged ? session->judge(request, Stage::indirect, Against::truth).error().fault
                                     : session->truth(request, Stage::indirect).error().fault;
        EXPECT_EQ(fault, Fault::stopped);
        EXPECT_LT(cpu_seconds() - begin, 3);
    }
}

}  // namespace
}  // namespace strata
