#include "passes/combine/formulas.h"

#include <string_view>

#include "capture_format/frame/frame.h"
#include "passes/reference/decoded.h"
#include "passes/stage_input.h"
#include "passes/tone_curve.h"

namespace strata::combine {
namespace {

/// The texel of an image, or `missing` where the frame has no such image.
glm::dvec4 texel(const StageInput& input, std::string_view name, const ComposedSample& at, glm::dvec4 missing) {
    const auto found = input.before.find(name);
    return found == input.before.end() ? missing : found->second.at(at.x, at.y, at.sample);
}

SurfacePoint surface(const StageInput& input, const ComposedSample& at) {
    const DecodedTexels texels{texel(input, "surface_normal", at, {}), texel(input, "surface_color", at, {}),
                               texel(input, "surface_material", at, {})};
    return decoded_surface(input.frame, texels, at.x, at.y);
}

/// Diffuse light that comes from everywhere, after the material's and the screen's occlusion (docs/algorithms/deferred.md 8.3:
/// both multiply).
glm::dvec3 ambient(const StageInput& input, const ComposedSample& at, const SurfacePoint& p, const Look& look) {
    if (p.model == LightingModel::unlit) return glm::dvec3(0);
    const glm::dvec3 indirect(texel(input, "indirect", at, glm::dvec4(0)));
    const double visible = texel(input, "occlusion", at, glm::dvec4(1)).x;
    const glm::dvec3 hemisphere = look.hemisphere ? look.hemisphere(p) : hemisphere_light(input.frame, p);
    return visible * (hemisphere + p.base_color * (1 - p.metallic) * p.occlusion * indirect);
}

}  // namespace

Look recorded_look(const Frame& frame) {
    return {.fogged = [&frame](const glm::dvec3& radiance, const SurfacePoint& p) {
        const FogAt fog = fog_at(frame, fog_way(frame.fog.path, p.position));
        return radiance * fog.remains + fog.added;
    }};
}

glm::dvec3 composed(const StageInput& input, const ComposedSample& at, const Look& look) {
    const glm::dvec4 emission = texel(input, "emission", at, glm::dvec4(0));
    const glm::dvec3 shafts(texel(input, "shafts", at, glm::dvec4(0)));
    if (emission.w == 0) return glm::dvec3(input.frame.background) + shafts;
    const SurfacePoint p = surface(input, at);
    const glm::dvec3 light(texel(input, "light", at, glm::dvec4(0)));
    return look.fogged(glm::dvec3(emission) + light + ambient(input, at, p, look), p) + shafts;
}

double exposure_of(const StageInput& input) {
    const auto factor = input.before.find("exposure");
    const double recorded = input.frame.view.exposure;
    return factor == input.before.end() ? recorded : recorded * factor->second.at(0, 0).x;
}

glm::dvec3 developed(const StageInput& input, const ReferenceImage& color, std::uint32_t x, std::uint32_t y) {
    const double exposure = exposure_of(input), white = input.frame.film.white;
    glm::dvec3 sum(0);
    for (std::uint32_t sample = 0; sample < color.layers; ++sample)
        for (int c = 0; c < 3; ++c) sum[c] += tone_mapped(color.at(x, y, sample)[c] * exposure, white);
    return sum / double(color.layers);
}

bool is_drawn_over(const Frame& frame) {
    const Lens& lens = frame.lens;
    return !transparent_draws(frame).empty() || lens.bloom > 0 || lens.aperture > 0 || lens.distortion;
}

}  // namespace strata::combine
