// Random numbers that are the same on every platform: std::random's distributions are not.
#pragma once

#include <cstdint>

namespace strata::scenario {

/// SplitMix64 (Steele, Lea, Flood 2014). Draw at most one number per expression, or inside braces: the order in which
/// operands and arguments in parentheses are evaluated is the compiler's.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15ull;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    float between(float low, float high) {
        return static_cast<float>(between(static_cast<double>(low), static_cast<double>(high)));
    }
    /// In [0, count).
    std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(unit() * count); }

private:
    std::uint64_t state_;
};

}  // namespace strata::scenario
