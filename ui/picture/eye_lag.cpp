#include "ui/picture/eye_lag.h"

#include <algorithm>

namespace strata::ui {
namespace {

// Pictures that are later than this are dimmed. One replay's time passes between the least and the most that a picture lags while
// the eye moves: what is dimmed stays so until it lags much less, or a device that needs 150 ms would flicker.
constexpr double most_seconds = .25, least_seconds = .1;

}  // namespace

bool differs_by_the_eye_alone(MadeOf a, const MadeOf& b) {
    a.request.variant.eye = b.request.variant.eye;
    return a == b;
}

void EyeLag::note(const MadeOf& asked, const MadeOf& shown, double seconds) {
    if (asked_ && *asked_ != asked) {
        if (!differs_by_the_eye_alone(*asked_, asked)) passed_.clear();
        else passed_.push_back({asked_->request.variant.eye, seconds});
    }
    asked_ = asked;
    if (shown == asked) {
        passed_.clear();
        is_small_ = true;
    } else {
        is_small_ = differs_by_the_eye_alone(shown, asked) && !is_late(shown.request.variant.eye, seconds);
    }
}

bool EyeLag::is_late(const EyeMove& shown, double seconds) {
    const auto last = std::find_if(passed_.rbegin(), passed_.rend(), [&](const Passed& each) { return each.eye == shown; });
    if (last == passed_.rend()) return true;
    passed_.erase(passed_.begin(), std::prev(last.base()));
    return seconds - passed_.front().until > (is_small_ ? most_seconds : least_seconds);
}

}  // namespace strata::ui
