// How a session stays within its memory budget: the memo shrinks first, and what does not fit beside an empty memo is refused.
#include "replay/session/device_session.h"

namespace strata {

MemoryNeed DeviceSession::need_of(const Plan& plan, const RunOptions& options) const {
    return memory_need(*executor_, plan, options, scene_.bytes());
}

Result<void> DeviceSession::check_budget(const Plan& plan, const RunOptions& options) const {
    if (memory_budget_ == 0) return {};
    const MemoryNeed need = need_of(plan, options);
    if (need.total() <= memory_budget_) return {};
    return fail(
        Fault::device_lacks, "session.memory_budget",
        "frame {frame} needs {needed_mebibytes:.1f} MiB: {shares}; the memory budget is {budget_mebibytes:.1f} MiB. Give it "
        "more, or {advice}",
        loaded_->variant.frame, double(need.total()) / (1 << 20), text(need), double(memory_budget_) / (1 << 20),
        loaded_->frame.view.samples > 1 ? "replay with --samples 1"
                                        : "choose a technique or settings that take less (strata graph lists the steps)");
}

Result<void> DeviceSession::make_room(const Plan& plan, const RunOptions& options) {
    if (const auto fits = check_budget(plan, options); !fits) return fits;
    if (memory_budget_ != 0) memo_.limit(memory_budget_ - need_of(plan, options).total());
    return {};
}

Result<Declaration> DeviceSession::prepare_with_memo(const Request& request, const RunOptions& options) {
    if (memory_budget_ == 0) return prepare(request, &memo_, Keep::outputs);
    auto plain = prepare(request, nullptr, Keep::outputs);
    if (!plain) return plain;
    if (const auto room = make_room(plain->plan, options); !room) return room.error();
    // What the memo takes now must not come on top of what the frame before left.
    executor_->forget_plan();
    if (not_uploaded_) scene_.forget();
    const RunTimes loaded = times_;
    auto remembering = prepare(request, &memo_, Keep::outputs);
    times_.load = loaded.load;
    if (remembering && need_of(remembering->plan, options).total() + memo_.held() <= memory_budget_) return remembering;
    memo_.clear();
    return plain;
}

}  // namespace strata
