#include "passes/sun_shafts/truth.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <tbb/parallel_for.h>

#include "capture_format/frame/frame.h"
#include "passes/reference/shade.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/shadow_intervals.h"
#include "passes/sun_shafts/truths.h"

namespace strata {
namespace {

using sun_shafts::Interval, sun_shafts::ShadowVolumes;

/// A phase function times 4 pi, by the unit direction of a ray.
using PhaseFactor = std::function<double(const glm::dvec3&)>;

/// Of all samples.
ImageSet integrated(const StageInput& input, const PhaseFactor& factor) {
    const Frame& frame = input.frame;
    const auto depth = input.before.find("depth_layers");
    if (depth == input.before.end()) return {};
    const ReferenceImage& depths = depth->second;
    const double near = double(frame.view.near), far = std::max(double(frame.sun.shadow_distance), 2 * near);
    const glm::dvec3 scattered = glm::dvec3(frame.sun.irradiance) / (4 * std::numbers::pi);
    std::optional<ShadowVolumes> volumes;
    if (frame.sun.shadow.casts) volumes.emplace(frame);
    ReferenceImage shafts(depths.width, depths.height, depths.layers, {0, 0, 0, 1});
    tbb::parallel_for(0u, depths.height * depths.layers, [&](std::uint32_t row) {
        const std::uint32_t y = row % depths.height, sample = row / depths.height;
        const glm::dvec2 offset = sample_position(depths.layers, sample);
        for (std::uint32_t x = 0; x < depths.width; ++x) {
            const double device_depth = depths.at(x, y, sample).x;
            const double z = device_depth > 0 ? std::min(near / device_depth, far) : far;
            const glm::dvec3 end = z * pixel_ray(frame, x + offset.x, y + offset.y);
            const double length = glm::length(end);
            std::vector<Interval> shadows;
            if (volumes) shadows = volumes->shadows(end / length, length);
            const double share = scattered_share(shadows, length, double(frame.fog.density));
            shafts.at(x, y, sample) = glm::dvec4(share * factor(end / length) * scattered, 1);
        }
    });
    return {{"shafts", shafts}};
}

/// The way of sunlight, view space.
glm::dvec3 sunlight(const StageInput& input) {
    return glm::normalize(input.frame.view.to_view * glm::dvec3(input.frame.sun.direction));
}

ImageSet xray_phase(const StageInput& input) {
    const double factor = 0.6 - 0.4 * sunlight(input).z;
    return integrated(input, [=](const glm::dvec3&) { return factor; });
}

/// Light that comes to the eye along a ray goes against its direction.
template <std::size_t Row>
ImageSet asymmetric(const StageInput& input) {
    constexpr double g = sun_shafts::phase_asymmetries[Row];
    const glm::dvec3 before = sunlight(input);
    return integrated(input, [=](const glm::dvec3& ray) {
        const double turned = glm::dot(before, -ray), squared = 1 - 2 * g * turned + g * g;
        return (1 - g * g) / (squared * std::sqrt(squared));
    });
}

}  // namespace

ImageSet sun_shafts_truth(const StageInput& input) {
    return integrated(input, [](const glm::dvec3&) { return 1.; });
}

std::vector<TruthRow> other_sun_shafts_truths() {
    const std::string_view is =
        "single scattering by Henyey and Greenstein's phase, integrated in double over exact shadow intervals";
    const auto& names = sun_shafts::asymmetric_truths;
    return {{.name = sun_shafts::xray_phase_truth,
             .make = xray_phase,
             .is = "single scattering with X-Ray's view factor, integrated in double over exact shadow intervals"},
            {.name = names[0], .make = asymmetric<0>, .is = is},
            {.name = names[1], .make = asymmetric<1>, .is = is},
            {.name = names[2], .make = asymmetric<2>, .is = is},
            {.name = names[3], .make = asymmetric<3>, .is = is}};
}

}  // namespace strata
