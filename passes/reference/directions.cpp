#include "passes/reference/directions.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace strata {

std::array<glm::dvec3, 2> perpendiculars(const glm::dvec3& axis) {
    const glm::dvec3 helper = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(helper, axis));
    return {u, glm::cross(axis, u)};
}

std::uint64_t DrawnNumbers::next() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::vector<glm::dvec2> stratified(std::uint32_t side, DrawnNumbers& random) {
    std::vector<glm::dvec2> points;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const double up = random.unit(), across = random.unit();  // arguments of a call have no order
            points.push_back(glm::dvec2(x + across, y + up) / double(side));
        }
    return points;
}

std::vector<glm::dvec2> shuffled(std::uint32_t side, DrawnNumbers& random) {
    std::vector<glm::dvec2> points = stratified(side, random);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
    return points;
}

glm::dvec3 cosine_direction(const glm::dvec3& normal, const glm::dvec2& place) {
    const auto [u, v] = perpendiculars(normal);
    const double sine = std::sqrt(place.x), angle = 2 * std::numbers::pi * place.y;
    return sine * (std::cos(angle) * u + std::sin(angle) * v) + std::sqrt(1 - place.x) * normal;
}

}  // namespace strata
