// The session on its thread: who waits for whom, and what is left after a failure.
#include "ui/replayer/replayer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "captures/scenarios.h"
#include "tests/support/errors.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

using namespace std::chrono_literals;

Replayer::Open counted_open(std::atomic<int>& opened) {
    return [&opened] {
        ++opened;
        std::vector<Frame> frames;
        frames.push_back(must(find_scenario("smoke_grenade"))->build(0, {.width = 64, .height = 36}));
        return Session::open(std::move(frames), {.validation = true});
    };
}

template <typename Done>
void take_until(Replayer& replayer, Done done) {
    const auto begin = std::chrono::steady_clock::now();
    while (!done()) {
        replayer.take_results();
        std::this_thread::sleep_for(1ms);
        if (std::chrono::steady_clock::now() - begin > 5min) FAIL() << "waited five minutes";
    }
}

struct Opened {
    std::atomic<int> count = 0;
    Replayer replayer{counted_open(count)};
    Opened() {
        replayer.show("A", {});
        take_until(replayer, [this] { return replayer.is_current("A"); });
    }
};

Request with_another_eye() { return {.variant = {.eye = {.dolly = .5}}}; }

/// As a session's call that takes long: until somebody asks it to stop.
Result<int> until_stopped(ui::Progress& progress) {
    while (!progress.is_interrupted()) std::this_thread::sleep_for(1ms);
    return fail(Fault::stopped, "session.stopped", "stopped");
}

TEST(Replayer, APictureStopsTheJobThatHoldsItUpAndTheJobBeginsAnewAfterIt) {
    Opened opened;
    std::atomic<int> tries = 0;
    const auto job = opened.replayer.start<int>([&tries](Session& session, ui::Progress& progress) -> Result<int> {
        if (++tries == 1) return until_stopped(progress);
        const auto run = session.run({});
        return run ? Result<int>(int(tries)) : run.error();
    });
    take_until(opened.replayer, [&] { return tries == 1; });
    opened.replayer.show("A", with_another_eye());
    take_until(opened.replayer, [&] { return opened.replayer.is_current("A"); });
    EXPECT_EQ(opened.replayer.error("A"), nullptr);
    take_until(opened.replayer, [&] { return job->result() != nullptr; });
    EXPECT_EQ(must(*job->result()), 2);
}

TEST(Replayer, AJobThatYieldsBetweenItsStepsKeepsWhatItHasAndThePictureIsMadeInBetween) {
    Opened opened;
    std::atomic<int> tries = 0;
    std::atomic<bool> is_made = false;
    const auto job = opened.replayer.start<int>(
        [&](Session& session, ui::Progress& progress) -> Result<int> {
            ++tries;
            while (!is_made && progress.at(.5, "waiting")) std::this_thread::sleep_for(1ms);
            const auto run = session.run({});
            return run ? Result<int>(int(tries)) : run.error();
        },
        Yields::between_steps);
    opened.replayer.show("A", with_another_eye());
    take_until(opened.replayer, [&] {
        is_made = opened.replayer.is_current("A");
        return job->result() != nullptr;
    });
    EXPECT_TRUE(is_made);
    EXPECT_EQ(must(*job->result()), 1);
}

TEST(Replayer, AJobThatIsCancelledStopsWhatTheSessionIsInAndTheNextOneIsNotStopped) {
    Opened opened;
    std::atomic<bool> begun = false;
    const auto job = opened.replayer.start<int>([&begun](Session& session, ui::Progress& progress) -> Result<int> {
        begun = true;
        static_cast<void>(until_stopped(progress));
        const auto run = session.run(with_another_eye());
        return run ? Result<int>(0) : run.error();
    });
    take_until(opened.replayer, [&] { return begun.load(); });
    job->progress.cancel();
    const auto next = opened.replayer.start<std::size_t>([](Session& session, ui::Progress&) -> Result<std::size_t> {
        const auto run = session.run(with_another_eye());
        return run ? Result<std::size_t>(run->passes_executed) : run.error();
    });
    take_until(opened.replayer, [&] { return next->result() != nullptr; });
    ASSERT_NE(job->result(), nullptr);
    EXPECT_EQ(job->result()->error().fault, Fault::stopped);
    EXPECT_GT(must(*next->result()), 0u);
}

TEST(Replayer, WhatHasNotEnoughMemoryIsASentenceAndTheCaptureIsOpenedAnewForTheNext) {
    Opened opened;
    const auto good = opened.replayer.shown("A");
    const auto job = opened.replayer.start<int>([](Session&, ui::Progress&) -> Result<int> { throw std::bad_alloc(); });
    take_until(opened.replayer, [&] { return job->result() != nullptr; });
    EXPECT_THAT(*job->result(), FailsWith("machine.out_of_memory"));
    EXPECT_EQ(opened.replayer.shown("A"), good);
    opened.replayer.show("A", with_another_eye());
    take_until(opened.replayer, [&] { return opened.replayer.is_current("A"); });
    EXPECT_EQ(opened.replayer.error("A"), nullptr);
    EXPECT_EQ(opened.count, 2);
}

TEST(Replayer, ThatIsClosedStopsItsJob) {
    std::atomic<bool> begun = false;
    Opened opened;
    const auto job = opened.replayer.start<int>([&begun](Session&, ui::Progress& progress) {
        begun = true;
        return until_stopped(progress);
    });
    take_until(opened.replayer, [&] { return begun.load(); });
    // The destructors that follow would wait for ever.
}

}  // namespace
}  // namespace strata::ui
