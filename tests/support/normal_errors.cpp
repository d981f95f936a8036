#include "tests/support/normal_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace strata {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

NormalErrors normal_errors(int count, const std::function<glm::dvec3()>& make_normal,
                           const std::function<glm::dvec3(const glm::dvec3&)>& stored) {
    NormalErrors errors;
    for (int i = 0; i < count; ++i) {
        const glm::dvec3 n = make_normal();
        const double error = degrees_between(stored(n), n);
        errors.worst = std::max(errors.worst, error);
        errors.mean += error / count;
    }
    return errors;
}

NormalErrors errors_of_a_million_normals(const std::function<glm::dvec3(const glm::dvec3&)>& stored) {
    std::mt19937_64 random(1);
    std::normal_distribution<double> gauss;
    const auto any_direction = [&] {
        const double x = gauss(random), y = gauss(random), z = gauss(random);
        return glm::normalize(glm::dvec3(x, y, z));
    };
    return normal_errors(1000000, any_direction, stored);
}

}  // namespace strata
