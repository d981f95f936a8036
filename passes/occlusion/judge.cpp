#include "passes/occlusion/judge.h"

#include <algorithm>
#include <cmath>

#include "passes/reference/decoded.h"
#include "passes/reference/difference.h"
#include "passes/stage_input.h"

namespace strata {
namespace {

const ReferenceImage* find(const ImageSet& images, std::string_view name) {
    const auto found = images.find(name);
    return found == images.end() ? nullptr : &found->second;
}

/// What the hemisphere's light is at a sample before the screen's occlusion, root mean square over the colors; 0 of an unlit
/// surface.
double ambient_at(const StageInput& input, std::uint32_t x, std::uint32_t y, std::uint32_t sample) {
    const ReferenceImage *normal = find(input.before, "surface_normal"), *color = find(input.before, "surface_color"),
                         *material = find(input.before, "surface_material");
    if (!normal || !color || !material) return 0;
    const DecodedTexels texels{normal->at(x, y, sample), color->at(x, y, sample), material->at(x, y, sample)};
    const SurfacePoint p = decoded_surface(input.frame, texels, x, y);
    if (p.model == LightingModel::unlit) return 0;
    const glm::dvec3 light = hemisphere_light(input.frame, p);
    return std::sqrt(glm::dot(light, light) / 3);
}

/// Sums over samples that are compared.
struct Sums {
    double worst = 0, errors = 0;
    ErrorSums visibility, light;

    void add(double got, double wanted, double ambient) {
        const double error = visibility.add(got, wanted);
        worst = std::max(worst, std::abs(error));
        errors += error;
        light.add(got * ambient, wanted * ambient);
    }
};

}  // namespace

std::vector<Metric> occlusion_judge(const ImageSet& result, const ImageSet& truth, const StageInput& input) {
    const ReferenceImage &got = result.at("occlusion"), &wanted = truth.at("occlusion");
    const ReferenceImage* normal = find(input.before, "surface_normal");
    Sums sums;
    for (std::uint32_t sample = 0; sample < wanted.layers; ++sample)
        for (std::uint32_t y = 0; y < wanted.height; ++y)
            for (std::uint32_t x = 0; x < wanted.width; ++x) {
                const std::size_t i = wanted.index(x, y, sample);
                if (!decided(got, wanted, i) || (normal && normal->texels[i].w <= 0)) continue;
                sums.add(got.texels[i].x, wanted.texels[i].x, ambient_at(input, x, y, sample));
            }
    return {{"rmse", "", sums.visibility.rmse()},
            {"worst", "", sums.worst},
            {"bias", "", std::isnan(sums.errors) ? HUGE_VAL : sums.errors / std::max(1.0, sums.visibility.values)},
            {"ambient relative rmse", "", sums.light.relative()}};
}

}  // namespace strata
