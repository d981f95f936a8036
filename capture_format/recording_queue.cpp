// One mutex, two conditions: room for those who push, work for the one who pops.
#include "capture_format/recording_queue.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <utility>

namespace strata {
namespace {

bool is_frame(const Recorded& item) {
    return std::holds_alternative<SubmittedFrame>(item) || std::holds_alternative<WholeFrame>(item);
}

}  // namespace

/// Resources alone are no reason to wake the thread: each switch costs the application more than the resource.
bool RecordingQueue::worth_waking() const {
    if (entries_.empty()) return closed_;
    return closed_ || drainers_ > 0 || frames_ > 0 || load_.held_bytes > budget_ / 2;
}

Result<void> RecordingQueue::push(Recorded item, std::uint64_t bytes, std::string_view what) {
    if (bytes > budget_) {
        return fail(Fault::usage, "record.budget",
                    "{resource} takes {bytes} bytes, more than the recorder's budget of {budget}; allow more with "
                    "RecorderOptions::budget_bytes",
                    what, bytes, budget_);
    }
    std::unique_lock lock(mutex_);
    if (load_.held_bytes + bytes > budget_) {
        const auto start = std::chrono::steady_clock::now();
        ++drainers_;
        work_.notify_one();
        room_.wait(lock, [&] { return load_.held_bytes + bytes <= budget_; });
        --drainers_;
        load_.waited_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const bool adds_frame = is_frame(item);
    entries_.push_back({std::move(item), bytes});  // first: without memory nothing is counted
    load_.held_bytes += bytes;
    load_.most_held_bytes = std::max(load_.most_held_bytes, load_.held_bytes);
    frames_ += adds_frame;
    if (!working_ && worth_waking()) work_.notify_one();
    return {};
}

std::optional<Recorded> RecordingQueue::pop() {
    std::unique_lock lock(mutex_);
    load_.held_bytes -= std::exchange(popped_bytes_, 0);
    working_ = false;
    room_.notify_all();
    work_.wait(lock, [&] { return worth_waking(); });
    if (entries_.empty()) return std::nullopt;
    working_ = true;
    Entry next = std::move(entries_.front());
    entries_.pop_front();
    popped_bytes_ = next.bytes;
    frames_ -= is_frame(next.item);
    return std::move(next.item);
}

void RecordingQueue::drain() {
    std::unique_lock lock(mutex_);
    ++drainers_;
    work_.notify_one();
    room_.wait(lock, [&] { return entries_.empty() && !working_; });
    --drainers_;
}

void RecordingQueue::close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    work_.notify_one();
}

RecorderLoad RecordingQueue::load() const {
    const std::lock_guard lock(mutex_);
    return load_;
}

void RecordingQueue::give_back(std::unique_ptr<Frame> frame) {
    // All but the lists is as in a new frame, and these keep their room.
    Frame fresh;
    const auto keep_room = [](auto& from, auto& to) {
        from.clear();
        to.swap(from);
    };
    keep_room(frame->draws, fresh.draws);
    keep_room(frame->emitters, fresh.emitters);
    keep_room(frame->lights, fresh.lights);
    keep_room(frame->blockers, fresh.blockers);
    keep_room(frame->portals, fresh.portals);
    *frame = std::move(fresh);
    const std::lock_guard lock(mutex_);
    spare_ = std::move(frame);
}

std::unique_ptr<Frame> RecordingQueue::empty_frame() {
    {
        const std::lock_guard lock(mutex_);
        if (spare_) return std::move(spare_);
    }
    return std::make_unique<Frame>();
}

}  // namespace strata
