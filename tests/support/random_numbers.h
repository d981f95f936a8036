// Numbers and vectors at random, by their seed the same in every run.
#pragma once

#include <cstdint>
#include <random>

#include <glm/glm.hpp>

namespace strata {

class Numbers {
public:
    explicit Numbers(unsigned seed) : random_(seed) {}
    float from(float low, float high) { return std::uniform_real_distribution<float>(low, high)(random_); }
    std::uint32_t below(std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random_); }
    glm::vec3 box(float half) { return {from(-half, half), from(-half, half), from(-half, half)}; }
    glm::vec3 direction() {
        for (;;)
            if (const glm::vec3 v(from(-1, 1), from(-1, 1), from(-1, 1)); glm::dot(v, v) < 1 && glm::dot(v, v) > .01f)
                return glm::normalize(v);
    }
    glm::vec3 across(const glm::vec3& axis) {
        for (;;)
            if (const glm::vec3 v = glm::cross(axis, direction()); glm::dot(v, v) > .01f) return glm::normalize(v);
    }

private:
    std::mt19937 random_;
};

}  // namespace strata
