// The thread that works for the window: order, cancelling, and what both sides may touch at once.
#include "ui/replayer/work_queue.h"

#include <future>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strata::ui {
namespace {

using testing::ElementsAre;

void wait_until_idle(const WorkQueue& queue) {
    while (!queue.is_idle()) std::this_thread::yield();
}

TEST(WorkQueue, DoesWhatWasAddedFirstBeforeWhatWaits) {
    std::vector<int> done;
    std::promise<void> begin;
    {
        WorkQueue queue;
        queue.add([&, may_begin = begin.get_future().share()] { may_begin.wait(); });
        queue.add([&] { done.push_back(2); });
        queue.add_first([&] { done.push_back(1); });
        begin.set_value();
        wait_until_idle(queue);
    }
    EXPECT_THAT(done, ElementsAre(1, 2));
}

TEST(WorkQueue, DropsWhatHasNotBegunWhenItEnds) {
    std::atomic<bool> has_begun = false, is_late = false;
    {
        WorkQueue queue;
        queue.add([&] {
            has_begun = true;
            while (!queue.is_stopping()) std::this_thread::yield();
        });
        queue.add([&] { is_late = true; });
        while (!has_begun) std::this_thread::yield();
    }
    EXPECT_FALSE(is_late);
}

TEST(WorkQueue, TellsHowFarAJobIsAndGivesItsResultOnce) {
    WorkQueue queue;
    const auto job = start<int>(queue, [](Progress& progress) -> Result<int> {
        for (int step = 1; step <= 100; ++step) progress.at(step / 100., "step " + std::to_string(step));
        return 42;
    });
    while (job->result() == nullptr) {
        EXPECT_LE(job->progress.fraction(), 1);
        (void)job->progress.doing();
    }
    EXPECT_EQ(**job->result(), 42);
    EXPECT_EQ(job->progress.doing(), "step 100");
}

TEST(WorkQueue, AJobServesPicturesThatWaitAndEndsWhenItIsCancelled) {
    WorkQueue queue;
    std::atomic<int> served = 0;
    std::atomic<bool> has_begun = false, has_ended = false;
    const auto job = start<int>(queue, [&](Progress& progress) -> Result<int> {
        int steps = 0;
        has_begun = true;
        while (progress.at(.5, "endless")) ++steps;
        has_ended = true;
        return steps;
    });
    while (!has_begun) std::this_thread::yield();  // a job that is cancelled before has no result
    for (int i = 0; i < 10; ++i) queue.add_first([&] { ++served; });
    while (served < 10) std::this_thread::yield();
    job->progress.cancel();
    while (!has_ended) std::this_thread::yield();
    EXPECT_TRUE(job->progress.is_interrupted()) << "a cancelled job never resumes";
}

TEST(WorkQueue, AJobThatIsCancelledBeforeItBeginsHasNoResult) {
    WorkQueue queue;
    std::promise<void> begin;
    queue.add([may_begin = begin.get_future().share()] { may_begin.wait(); });
    const auto job = start<int>(queue, [](Progress&) -> Result<int> { return 1; });
    job->progress.cancel();
    begin.set_value();
    wait_until_idle(queue);
    EXPECT_EQ(job->result(), nullptr);
}

TEST(WorkQueue, AnInterruptionEndsWithTheNextStep) {
    WorkQueue queue;
    Progress progress(queue);
    progress.interrupt();
    EXPECT_TRUE(progress.is_interrupted());
    EXPECT_TRUE(progress.at(.1, "next"));
    EXPECT_FALSE(progress.is_interrupted());
}

}  // namespace
}  // namespace strata::ui
