#include "passes/transparency/judge.h"

#include <algorithm>
#include <cmath>

namespace strata {
namespace {

/// What `display` makes of a radiance: x (1 + x / Wt^2) / (1 + x) after exposure, at most 1.
double displayed(const Frame& frame, double radiance) {
    const double x = std::max(0., radiance * double(frame.view.exposure)), white = double(frame.film.white);
    return std::min(1., x * (1 + x / (white * white)) / (1 + x));
}

bool off_by_a_step(const Frame& frame, const glm::dvec4& got, const glm::dvec4& wanted) {
    for (int c = 0; c < 3; ++c)
        if (std::abs(displayed(frame, got[c]) - displayed(frame, wanted[c])) > 1. / 255) return true;
    return false;
}

bool undecided(const ReferenceImage& image, std::size_t i) { return !image.undecided.empty() && image.undecided[i]; }

}  // namespace

std::vector<Figure> transparency_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage& got = result.at("color");
    const ReferenceImage& wanted = truth.at("color");
    double squares = 0, power = 0, sum = 0, worst = 0, off = 0, compared = 0;
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        if (undecided(wanted, i) || undecided(got, i)) continue;
        const glm::dvec3 target(wanted.texels[i]), error = glm::dvec3(got.texels[i]) - target;
        squares += glm::dot(error, error) / 3;
        power += glm::dot(target, target) / 3;
        sum += (error.x + error.y + error.z) / 3;
        worst = std::max({worst, std::abs(error.x), std::abs(error.y), std::abs(error.z)});
        off += off_by_a_step(input.frame, got.texels[i], wanted.texels[i]) ? 1 : 0;
        compared += 1;
    }
    const double count = std::max(compared, 1.);
    return {
        {"rmse", "radiance", std::sqrt(squares / count)},
        {"relative rmse", "%", power > 0 ? 100 * std::sqrt(squares / power) : 0},
        {"worst", "radiance", worst},
        {"bias", "radiance", sum / count},
        {"off by 1/255", "%", 100 * off / count},
    };
}

}  // namespace strata
