// The host's clock between two points of a program.
#pragma once

#include <chrono>
#include <utility>

namespace strata {

/// Milliseconds since the last call, or since it was made.
class HostTimer {
public:
    double operator()() {
        const auto before = std::exchange(last_, std::chrono::steady_clock::now());
        return std::chrono::duration<double, std::milli>(last_ - before).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace strata
