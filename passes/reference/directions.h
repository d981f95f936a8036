// Directions for truths: around an axis, and over a surface, drawn at random and equal for equal keys on every platform.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

/// Two unit vectors perpendicular to a unit one and to each other; the three are right-handed.
std::array<glm::dvec3, 2> perpendiculars(const glm::dvec3& axis);

/// SplitMix64 (Steele, Lea and Flood 2014), begun by what the numbers are for.
class DrawnNumbers {
public:
    DrawnNumbers(std::uint64_t pixel, std::uint64_t batch)
        : state_((pixel * 0x2545f4914f6cdd1du) ^ (batch * 0xd1342543de82ef95u)) {}
    /// From 0 up to, not including, 1.
    double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(unit() * static_cast<double>(count)); }

private:
    std::uint64_t next();
    std::uint64_t state_;
};

/// One point in each of side x side parts of the unit square.
std::vector<glm::dvec2> stratified(std::uint32_t side, DrawnNumbers&);
/// The same in any order (Fisher and Yates), so that they pair with other points without a pattern.
std::vector<glm::dvec2> shuffled(std::uint32_t side, DrawnNumbers&);

/// Distributed by the cosine to the normal: equal areas of the unit square are equal shares of irradiance.
glm::dvec3 cosine_direction(const glm::dvec3& normal, const glm::dvec2& place);

}  // namespace strata
