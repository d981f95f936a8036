#include "passes/scene/frame_spectrum.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/light_types.h"
#include "passes/scene/frustum.h"
#include "passes/scene/light_features.h"
#include "passes/scene/view_space.h"
#include "passes/shaders/light_features.shared.h"

namespace strata {
namespace {

/// Of each kind of light that may reach a tile.
std::set<std::uint32_t> features_by_light(const Frame& frame, std::span<const Light> lights, const Frustum& frustum) {
    std::set<std::uint32_t> features;
    for (const Light& light : lights)
        if (!has_range(light.type) || frustum.meets({in_view_space(frame.view, light.position), double(light.range)}))
            features.insert(light_features(light));
    return features;
}

std::uint32_t features_of_surfaces(const Frame& frame, const DrawBounds& bounds, const Frustum& frustum) {
    std::uint32_t features = 0;
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const Material& material = frame.materials[frame.draws[i].material];
        const std::uint32_t needed = is_transparent(material.alpha_mode) ? 0 : model_feature(material.lighting_model);
        if ((needed & ~features) != 0 && frustum.meets(bounds.spheres[i])) features |= needed;
    }
    return features;
}

/// Volumes whose light stops at blockers are read tap by tap (docs/algorithms/lighting.md 5.8). Settings may make it stop in any
/// volume, whatever is recorded.
std::uint32_t features_of_volumes(const Frame& frame) {
    return !frame.light_volumes.empty() && !frame.blockers.empty() ? feature_gi_tap_visibility : 0;
}

// Of a light: those that a tile may lack though the light is in its list.
constexpr std::uint32_t features_of_some_tiles =
    feature_blockers | feature_portals | feature_shadows | feature_soft_shadows | feature_clip_planes;

void add_each_bit(std::uint32_t always, std::uint32_t optional, std::set<std::uint32_t>& parts) {
    for (; optional != 0; optional &= optional - 1) parts.insert(always | (optional & ~(optional - 1)));
}

/// Spectra of which every other one is a union.
std::set<std::uint32_t> spectrum_parts(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds,
                                       std::uint32_t features) {
    const Frustum frustum(frame.view);
    std::set<std::uint32_t> parts;
    for (const std::uint32_t light : features_by_light(frame, lights, frustum)) {
        const std::uint32_t always = light & features & ~features_of_some_tiles;
        parts.insert(always);
        add_each_bit(always, light & features & features_of_some_tiles, parts);
    }
    add_each_bit(0, features & (features_of_surfaces(frame, bounds, frustum) | features_of_volumes(frame)), parts);
    return parts;
}

}  // namespace

std::uint32_t frame_spectrum(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds) {
    const Frustum frustum(frame.view);
    std::uint32_t features = features_of_surfaces(frame, bounds, frustum) | features_of_volumes(frame);
    for (const std::uint32_t light : features_by_light(frame, lights, frustum)) features |= light;
    return features;
}

std::vector<std::uint32_t> possible_spectra(const Frame& frame, std::span<const Light> lights, const DrawBounds& bounds,
                                            std::uint32_t features) {
    std::vector<bool> is_known(std::size_t{every_light_feature} + 1);
    std::vector<std::uint32_t> spectra{0};
    is_known[0] = true;
    for (const std::uint32_t part : spectrum_parts(frame, lights, bounds, features & every_light_feature))
        for (std::size_t i = 0, before = spectra.size(); i < before; ++i) {
            const std::uint32_t spectrum = spectra[i] | part;
            if (!is_known[spectrum]) spectra.push_back(spectrum);
            is_known[spectrum] = true;
        }
    return spectra;
}

}  // namespace strata
