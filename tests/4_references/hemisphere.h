// Directions around the normal (0, 0, -1), and integrals over them.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace strata {

inline glm::dvec3 toward(double cosine, double azimuth) {
    const double sine = std::sqrt(1 - cosine * cosine);
    return {sine * std::cos(azimuth), sine * std::sin(azimuth), -cosine};
}

struct Quadrature {
    int polar, azimuthal;
};

/// The integral of f(l) cos over the hemisphere; midpoints, in cos^2 so that the cosine is in the measure. f is even in azimuth.
template <typename Function>
double reflected_share(const Quadrature& steps, const Function& f) {
    double sum = 0;
    for (int i = 0; i < steps.polar; ++i) {
        const double cosine = std::sqrt((i + 0.5) / steps.polar);
        for (int j = 0; j < steps.azimuthal; ++j) sum += f(toward(cosine, std::numbers::pi * (j + 0.5) / steps.azimuthal));
    }
    return sum * std::numbers::pi / (double(steps.polar) * steps.azimuthal);
}

}  // namespace strata
