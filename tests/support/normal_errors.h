// Errors of normals that were stored and read back, in degrees.
#pragma once

#include <functional>

#include <glm/glm.hpp>

namespace strata {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b);

struct NormalErrors {
    double worst = 0, mean = 0;
};

/// Of `count` unit vectors that make_normal draws, and what `stored` gives back of them.
NormalErrors normal_errors(int count, const std::function<glm::dvec3()>& make_normal,
                           const std::function<glm::dvec3(const glm::dvec3&)>& stored);
/// Of a million directions, each as likely as any other; the same in every run.
NormalErrors errors_of_a_million_normals(const std::function<glm::dvec3(const glm::dvec3&)>& stored);

}  // namespace strata
