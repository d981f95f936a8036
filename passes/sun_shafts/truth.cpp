#include "passes/sun_shafts/truth.h"

#include <algorithm>
#include <numbers>

#include <tbb/parallel_for.h>

#include "passes/reference/shade.h"
#include "passes/sun_shafts/shadow_intervals.h"
#include "passes/sun_shafts/truths.h"

namespace strata {
namespace {

using sun_shafts::Interval, sun_shafts::ShadowVolumes;

/// Of all samples, with a phase function that is 1 / (4 pi) times a factor.
ImageSet integrated(const StageInput& input, double factor) {
    const Frame& frame = input.frame;
    const auto depth = input.before.find("depth_layers");
    if (depth == input.before.end()) return {};
    const ReferenceImage& depths = depth->second;
    const double near = double(frame.view.near), far = std::max(double(frame.sun.shadow_distance), 2 * near);
    const glm::dvec3 scattered = glm::dvec3(frame.sun.irradiance) * factor / (4 * std::numbers::pi);
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
            shafts.at(x, y, sample) = glm::dvec4(share * scattered, 1);
        }
    });
    return {{"shafts", shafts}};
}

ImageSet xray_phase(const StageInput& input) {
    const glm::dvec3 sun = glm::normalize(input.frame.view.to_view * glm::dvec3(input.frame.sun.direction));
    return integrated(input, 0.6 - 0.4 * sun.z);
}

}  // namespace

ImageSet sun_shafts_truth(const StageInput& input) { return integrated(input, 1); }

std::vector<TruthRow> other_sun_shafts_truths() {
    return {{.name = sun_shafts::xray_phase_truth,
             .make = xray_phase,
             .is = "single scattering with X-Ray's view factor, integrated in double over exact shadow intervals"}};
}

}  // namespace strata
