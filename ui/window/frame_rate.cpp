#include "ui/window/frame_rate.h"

#include <algorithm>

#include <fmt/format.h>

namespace strata::ui {
namespace {

constexpr double seconds_that_count = 2;

}  // namespace

void FrameRate::add(double seconds) {
    seconds_.push_back(seconds);
    sum_ += seconds;
    while (sum_ - seconds_.front() >= seconds_that_count) {
        sum_ -= seconds_.front();
        seconds_.pop_front();
    }
}

double FrameRate::per_second() const { return sum_ > 0 ? static_cast<double>(seconds_.size()) / sum_ : 0; }

double FrameRate::slowest_ms() const { return seconds_.empty() ? 0 : *std::ranges::max_element(seconds_) * 1000; }

std::string text(const FrameRate& rate) {
    if (rate.per_second() == 0) return "";
    return fmt::format("{:.0f} frames a second while something is computed, the slowest took {:.0f} ms", rate.per_second(),
                       rate.slowest_ms());
}

}  // namespace strata::ui
