#include "ui/replayer/work_queue.h"

namespace strata::ui {

WorkQueue::WorkQueue() : thread_([this] { run(); }) {}

WorkQueue::~WorkQueue() {
    {
        const std::scoped_lock lock(mutex_);
        stopping_ = true;
        first_.clear();
        rest_.clear();
    }
    wake_.notify_all();
    thread_.join();
}

void WorkQueue::add(std::function<void()> work) {
    {
        const std::scoped_lock lock(mutex_);
        rest_.push_back(std::move(work));
    }
    wake_.notify_all();
}

void WorkQueue::add_first(std::function<void()> work) {
    {
        const std::scoped_lock lock(mutex_);
        first_.push_back(std::move(work));
    }
    wake_.notify_all();
}

void WorkQueue::serve_first() {
    for (;;) {
        std::function<void()> work;
        {
            const std::scoped_lock lock(mutex_);
            if (first_.empty()) return;
            work = std::move(first_.front());
            first_.pop_front();
        }
        work();
    }
}

bool WorkQueue::is_idle() const {
    const std::scoped_lock lock(mutex_);
    return !busy_ && first_.empty() && rest_.empty();
}

void WorkQueue::run() {
    std::unique_lock lock(mutex_);
    for (;;) {
        wake_.wait(lock, [&] { return stopping_ || !first_.empty() || !rest_.empty(); });
        if (stopping_) return;
        std::deque<std::function<void()>>& from = first_.empty() ? rest_ : first_;
        std::function<void()> work = std::move(from.front());
        from.pop_front();
        busy_ = true;
        lock.unlock();
        work();
        work = nullptr;  // what it holds goes while nobody waits for the lock
        lock.lock();
        busy_ = false;
    }
}

bool Progress::at(double fraction, const std::string& doing) {
    fraction_ = fraction;
    {
        const std::scoped_lock lock(mutex_);
        doing_ = doing;
    }
    resume();  // those who interrupted it are served now
    queue_->serve_first();
    return !cancelled_ && !queue_->is_stopping();
}

void Progress::cancel() {
    cancelled_ = true;
    interrupt();
}

void Progress::interrupt() {
    std::stop_source stop;
    {
        const std::scoped_lock lock(mutex_);
        stop = stop_;
    }
    stop.request_stop();
}

void Progress::resume() {
    const std::scoped_lock lock(mutex_);
    if (!cancelled_ && stop_.stop_requested()) stop_ = std::stop_source();
}

std::stop_token Progress::token() const {
    const std::scoped_lock lock(mutex_);
    return stop_.get_token();
}

std::string Progress::doing() const {
    const std::scoped_lock lock(mutex_);
    return doing_;
}

}  // namespace strata::ui
