#include "passes/lens/depth_of_field/xray_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "capture_format/frame/frame.h"
#include "passes/lens/depth_of_field/focus_model.h"
#include "passes/lens/distortion/radial_model.h"
#include "passes/stage_input.h"

namespace strata::lens {
namespace {

constexpr glm::dvec2 poisson[] = {{-.326212, -.405810}, {-.840144, -.073580}, {-.695914, .457137},  {-.203345, .620716},
                                  {.962340, -.194983},  {.473434, -.480026},  {.519456, .767022},   {.185461, -.893124},
                                  {.507431, .064425},   {.896420, .412458},   {-.321940, -.932615}, {-.791559, -.597710}};

}  // namespace

double xray_blur(double z, double focus) {
    constexpr double nearest = -1.25, farthest = 600, sky = 30;
    if (std::isinf(z)) z = sky;
    const double part =
        std::clamp((z - focus) / (farthest - focus), 0., 1.) + std::clamp((z - focus) / (nearest - focus), 0., 1.);
    return part * part;
}

ReferenceImage xray_focus_model(const StageInput& input, const ReferenceImage& color) {
    const double focus = std::min(std::max(double(input.frame.lens.focus_distance), double(input.frame.view.near)), 300.);
    const glm::dvec2 kernel = 2.5 / glm::dvec2(1024, 768) * glm::dvec2(color.width, color.height);
    ReferenceImage result = color;
    result.undecided.assign(color.texels.size(), false);
    for (std::uint32_t s = 0; s < color.layers; ++s)
        for (std::uint32_t y = 0; y < color.height; ++y)
            for (std::uint32_t x = 0; x < color.width; ++x) {
                const double own = xray_blur(depth_of(input, x, y, s), focus);
                const std::size_t i = color.index(x, y, s);
                if (own == 0) continue;
                const glm::dvec3 radiance(color.texels[i]);
                const bool counts = std::isfinite(radiance.x + radiance.y + radiance.z);
                glm::dvec4 sum = counts ? glm::dvec4(radiance, 1) : glm::dvec4(0);
                for (const glm::dvec2& tap : poisson) {
                    const glm::dvec2 at = glm::dvec2(x, y) + .5 + tap * kernel * own, off = glm::abs(at - glm::round(at));
                    const auto px = std::uint32_t(std::clamp(std::floor(at.x), 0., color.width - 1.));
                    const auto py = std::uint32_t(std::clamp(std::floor(at.y), 0., color.height - 1.));
                    const double weight = xray_blur(depth_of(input, px, py, s), focus);
                    if (std::min(off.x, off.y) < 1e-4) result.undecided[i] = true;
                    sum += weight * glm::dvec4(bilinear(color, at, s), 1);
                }
                if (sum.w > 0) result.texels[i] = glm::dvec4(glm::dvec3(sum) / sum.w, color.texels[i].w);
            }
    return result;
}

}  // namespace strata::lens
