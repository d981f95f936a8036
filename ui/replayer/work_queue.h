// A thread that does one thing after the other, and what a panel holds of a thing it had started. The window never waits for it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "capture_format/result.h"

namespace strata::ui {

class WorkQueue {
public:
    WorkQueue();
    /// Drops what has not begun and waits for what has.
    ~WorkQueue();

    void add(std::function<void()>);
    /// Before everything that waits.
    void add_first(std::function<void()>);
    /// From inside a piece of work: does now what was added first meanwhile.
    void serve_first();
    /// Nothing waits and nothing runs.
    bool is_idle() const;
    bool is_stopping() const { return stopping_; }

private:
    void run();

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> first_, rest_;
    bool busy_ = false;
    std::atomic<bool> stopping_ = false;
    std::thread thread_;  // last: it uses all of the above
};

/// What a running job says of itself, and what it is told.
class Progress {
public:
    explicit Progress(WorkQueue& queue) : queue_(&queue) {}

    /// From the job, between two steps of it: how far it is. Lets pictures that a person waits for go first. False: stop now.
    bool at(double fraction, const std::string& doing);

    /// From anywhere: for good.
    void cancel();
    bool is_cancelled() const { return cancelled_; }
    /// From anywhere: until the job begins anew, or comes to at().
    void interrupt();
    bool is_interrupted() const { return token().stop_requested(); }
    void resume();
    /// Tells what the job is in to end; of the time since it was last resumed.
    std::stop_token token() const;

    double fraction() const { return fraction_; }
    std::string doing() const;

private:
    WorkQueue* queue_;
    std::atomic<bool> cancelled_ = false;
    std::atomic<double> fraction_ = 0;
    mutable std::mutex mutex_;
    std::stop_source stop_;
    std::string doing_;
};

/// What it computes, or a sentence where the host's memory did not suffice: nothing else knows what to do with that.
template <typename T>
Result<T> within_memory(const std::function<Result<T>()>& compute) {
    try {
        return compute();
    } catch (const std::bad_alloc&) {
        return fail(Fault::device_failed, "machine.out_of_memory",
                    "there is not enough memory for this; a smaller frame or fewer samples need less");
    }
}

/// Something that is being computed elsewhere. Held by shared_ptr, because neither side knows which of them ends first.
template <typename T>
class Job {
public:
    explicit Job(WorkQueue& queue) : progress(queue) {}

    Progress progress;
    /// Null until it is done; then it stays.
    const Result<T>* result() const { return done_ ? &*result_ : nullptr; }
    void finish(Result<T> result) {
        result_.emplace(std::move(result));
        done_ = true;
    }

private:
    std::optional<Result<T>> result_;
    std::atomic<bool> done_ = false;
};
template <typename T>
using JobOf = std::shared_ptr<Job<T>>;

/// Computes on the queue's thread. A job that was cancelled before it began never runs and never has a result.
template <typename T>
JobOf<T> start(WorkQueue& queue, std::function<Result<T>(Progress&)> compute) {
    auto job = std::make_shared<Job<T>>(queue);
    queue.add([job, compute = std::move(compute)] {
        if (!job->progress.is_cancelled()) job->finish(within_memory<T>([&] { return compute(job->progress); }));
    });
    return job;
}

}  // namespace strata::ui
