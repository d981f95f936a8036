// The same in double. What is developed is the color that the last pass found, with everything drawn over it.
#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/combine/formulas.h"
#include "passes/combine/hi_lo/hi_lo.shared.h"
#include "passes/combine/hi_lo/hi_lo_params.h"
#include "passes/edges/plain_pixels.h"
#include "passes/frame_images.h"
#include "passes/lighting/material_table_model.h"
#include "passes/luminance.h"
#include "passes/settings.h"
#include "passes/stage_input.h"
#include "passes/tone_curve.h"

namespace strata::combine {
namespace {

/// The samples of a pixel, exposed and not negative.
std::vector<glm::dvec3> exposed_samples(const StageInput& input, const ReferenceImage& color, std::uint32_t x, std::uint32_t y) {
    const double exposure = exposure_of(input);
    std::vector<glm::dvec3> samples;
    for (std::uint32_t sample = 0; sample < color.layers; ++sample)
        samples.emplace_back(glm::dvec3(color.at(x, y, sample)) * exposure);
    return samples;
}

glm::dvec3 curve(const Frame& frame, const glm::dvec3& exposed) {
    const double white = frame.film.white;
    return {tone_mapped(exposed.x, white), tone_mapped(exposed.y, white), tone_mapped(exposed.z, white)};
}

glm::dvec3 mean(std::span<const glm::dvec3> values) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& value : values) sum += value;
    return sum / double(values.size());
}

glm::dvec3 weighted_mean(std::span<const glm::dvec3> values) {
    glm::dvec3 sum(0);
    double weights = 0;
    for (glm::dvec3 value : values) {
        value = glm::clamp(value, 0.0, 1e30);
        const double weight = 1 / (1 + luminance(value));
        sum += value * weight;
        weights += weight;
    }
    return sum / weights;
}

/// Values as 8-bit targets keep them, and whether a float may take another one of them.
struct Quantized {
    glm::dvec3 value{0};
    bool undecided = false;
};

Quantized quantized(const glm::dvec3& value) {
    constexpr double steps = 255, doubtful = 1e-3;
    Quantized result;
    for (int c = 0; c < 3; ++c) {
        const double step = std::clamp(value[c], 0.0, 1.0) * steps + 0.5;
        result.value[c] = std::floor(step) / steps;
        result.undecided |= std::abs(step - std::round(step)) < doubtful && value[c] > 0 && value[c] < 1;
    }
    return result;
}

/// Lo of the original: every sample in 8 bits, and their mean in 8 bits.
Quantized resolved_lo(const Frame& frame, std::span<const glm::dvec3> exposed) {
    std::vector<glm::dvec3> samples;
    bool undecided = false;
    for (const glm::dvec3& sample : exposed) {
        const Quantized lo = quantized(curve(frame, sample));
        samples.push_back(lo.value);
        undecided |= lo.undecided;
    }
    Quantized result = quantized(mean(samples));
    result.undecided |= undecided;
    return result;
}

Quantized display_at(const StageInput& input, const ReferenceImage& color, std::uint32_t x, std::uint32_t y,
                     std::uint32_t resolve) {
    const std::vector<glm::dvec3> exposed = exposed_samples(input, color, x, y);
    if (resolve == resolve_linear) return {curve(input.frame, mean(exposed))};
    if (resolve == resolve_weighted) return {curve(input.frame, weighted_mean(exposed))};
    if (resolve == resolve_lo_hi) return resolved_lo(input.frame, exposed);
    return {developed(input, color, x, y)};
}

/// Fog as the settings have it: F = clamp(fw d + fx) or 1 - exp(-density d), and the sky by F^2
/// (docs/algorithms/deferred.md 8.2).
auto chosen_fog(const Frame& frame, const HiLoParams& params) {
    return [&frame, params](const glm::dvec3& radiance, const SurfacePoint& p) {
        const double density = double(frame.fog.density), near = double(params.fog_near), far = double(params.fog_far);
        const bool recorded = params.fog_distance == fog_as_recorded;
        const FogPath path = recorded ? frame.fog.path : static_cast<FogPath>(params.fog_distance);
        const double free_paths = density * fog_way(path, p.position);
        double share = 1 - std::exp(-free_paths);
        if (params.fog == fog_linear)
            share = std::clamp((free_paths - near) / std::max(far - near, double(least_fog_length)), 0.0, 1.0);
        const glm::dvec3 sum = glm::mix(radiance, glm::dvec3(frame.fog.color), share);
        return params.fog_sky == fog_sky_blended ? glm::mix(sum, glm::dvec3(frame.background), share * share) : sum;
    };
}

/// Sky and ground in a direction of the world, which need not be unit.
glm::dvec3 hemisphere_towards(const Frame& frame, const glm::dvec3& direction) {
    const double height = direction.y / glm::length(direction);
    return glm::mix(glm::dvec3(frame.hemisphere.ground), glm::dvec3(frame.hemisphere.sky), (1 + height) / 2);
}

/// X-Ray's (docs/algorithms/deferred.md 8.3): LUT(AO, .5 + .5 dot(R, V)), V being the way to the surface, R mirrored from it.
/// `doubts` becomes true where the table's rounding is open.
auto hemisphere_by_table(const Frame& frame, bool& doubts) {
    return [&](const SurfacePoint& p) {
        const glm::dvec3 n = facing_normal(p), v = glm::normalize(p.position), r = v - 2 * glm::dot(v, n) * n;
        const std::uint32_t slice = lighting::material_slice(p);
        const lighting::TableShares at = lighting::material_in_table(slice, p.occlusion, 0.5 + 0.5 * glm::dot(r, v));
        doubts = at.undecided;
        const glm::dmat3 to_world = glm::transpose(frame.view.to_view);
        const glm::dvec3 mirrored = to_world * r;
        const glm::dvec3 highlight = hemisphere_towards(frame, {mirrored.x, 2 * mirrored.y - 1, mirrored.z});
        return p.base_color * at.shares.x * hemisphere_towards(frame, to_world * n) +
               lighting::material_gloss(p, slice) * at.shares.y * highlight;
    };
}

ReferenceImage combined(const StageInput& input, const HiLoParams& params) {
    const View& view = input.frame.view;
    bool doubts = false;
    Look look{.fogged = chosen_fog(input.frame, params)};
    const Hemisphere& hemisphere = input.frame.hemisphere;
    const bool is_lit = hemisphere.sky != glm::vec3(0) || hemisphere.ground != glm::vec3(0);
    if (params.hemisphere == hemisphere_table && is_lit) look.hemisphere = hemisphere_by_table(input.frame, doubts);
    ReferenceImage color(view.width, view.height, view.samples);
    color.undecided.assign(color.texels.size(), false);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample)
        for (std::uint32_t y = 0; y < view.height; ++y)
            for (std::uint32_t x = 0; x < view.width; ++x) {
                const std::uint32_t shaded = is_plain_pixel(input, x, y) ? 0 : sample;
                doubts = false;
                color.at(x, y, sample) = glm::dvec4(composed(input, {x, y, shaded}, look), 1);
                color.undecided[color.index(x, y, sample)] = doubts;
            }
    return color;
}

}  // namespace

ImageSet hi_lo_model(const StageInput& input, const Settings& settings) {
    const View& view = input.frame.view;
    ReferenceImage display(view.width, view.height);
    display.undecided.assign(display.texels.size(), false);
    const auto params = settings.as<HiLoParams>();
    const ReferenceImage& found = input.before.at("color");
    for (std::uint32_t y = 0; y < view.height; ++y)
        for (std::uint32_t x = 0; x < view.width; ++x) {
            const Quantized shown = display_at(input, found, x, y, params.resolve);
            display.at(x, y) = glm::dvec4(shown.value, 1);
            display.undecided[display.index(x, y)] = shown.undecided;
        }
    ImageSet images{{"display", display}};
    if (!is_drawn_over(input.frame)) images.emplace("color", combined(input, params));
    return images;
}

}  // namespace strata::combine
