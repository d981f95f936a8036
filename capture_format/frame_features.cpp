// Walks what a frame uses, from draws to materials and from lights to their lists, and notes the first reason for each bit.
#include "capture_format/frame_features.h"

#include <algorithm>
#include <cstddef>

#include <fmt/core.h>

#include "capture_format/frame/lens.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/particles.h"
#include "capture_format/light_types.h"

namespace strata {
namespace {

constexpr std::size_t feature_count = static_cast<std::size_t>(Feature::count_);

constexpr std::array<std::string_view, feature_count> names = {
    "opaque",
    "masked",
    "transparent",
    "chromatic",
    "additive",
    "particles",
    "soft_particles",
    "distortion",
    "low_resolution",
    "interface_layers",
    "emissive",
    "multisampled",
    "sun",
    "local_lights",
    "shadows",
    "hemisphere",
    "fog",
    "light_volumes",
    "blockers",
    "portals",
    "projected_textures",
    "area_lights",
    "clip_planes",
    "darks",
    "rain",
    "sun_shafts",
    "bloom",
    "auto_exposure",
    "depth_of_field",
    "lens_distortion",
    "grain",
};
static_assert(names.back() == "grain", "one name per feature, in order");

constexpr auto every_feature = [] {
    std::array<Feature, feature_count> all{};
    for (std::size_t i = 0; i < feature_count; ++i) all[i] = static_cast<Feature>(i);
    return all;
}();

constexpr std::string_view alpha_mode_names[] = {"opaque", "mask", "blend", "premultiplied", "additive"};

/// Its name, or its number when it has none.
std::string called(std::string_view kind, std::string_view own_name, std::size_t index) {
    return own_name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, own_name);
}

bool any(const glm::vec3& color) { return color != glm::vec3(0); }

/// Layer and resolution mean the same for draws and emitters.
template <typename Submission>
void find_placement(Features& features, const Submission& submission, const std::string& subject) {
    if (submission.resolution == Resolution::low) features.set(Feature::low_resolution, subject + " is drawn at low resolution");
    if (submission.layer != 0) {
        features.set(Feature::interface_layers, fmt::format("{} is in interface layer {}", subject, submission.layer));
    }
}

void find_in_transparent(Features& features, const Material& material, const std::string& use) {
    const glm::vec3 k = material.transmission;
    features.set(Feature::transparent, use);
    if (material.alpha_mode == AlphaMode::additive) {
        features.set(Feature::additive, use);
    } else if (material.alpha_mode == AlphaMode::premultiplied && material.base_color.w == 0) {
        features.set(Feature::additive, use + " and no coverage");
    } else if (k.x != k.y || k.y != k.z) {
        features.set(Feature::chromatic, fmt::format("{}, which transmits ({}, {}, {})", use, k.x, k.y, k.z));
    }
    if (material.distortion != 0) {
        features.set(Feature::distortion, fmt::format("{}, which distorts by {}", use, material.distortion));
    }
}

void find_in_draws(Features& features, const Frame& frame) {
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        const Draw& draw = frame.draws[i];
        if (frame.meshes[draw.mesh].indices.empty()) continue;
        const Material& material = frame.materials[draw.material];
        const std::string subject = called("draw", draw.name, i);
        const std::string use =
            fmt::format("{} uses {} with alpha mode {}", subject, called("material", material.name, draw.material),
                        alpha_mode_names[static_cast<std::size_t>(material.alpha_mode)]);
        find_placement(features, draw, subject);
        if (any(material.emissive)) features.set(Feature::emissive, use + ", which emits");
        if (is_transparent(material.alpha_mode)) {
            find_in_transparent(features, material, use);
            continue;
        }
        // Masked surfaces fill the G-buffer like the others: whoever asks for opaque ones means both.
        features.set(Feature::opaque, use);
        if (material.alpha_mode == AlphaMode::mask) features.set(Feature::masked, use);
    }
}

void find_in_emitters(Features& features, const Frame& frame) {
    for (std::size_t i = 0; i < frame.emitters.size(); ++i) {
        const Emitter& emitter = frame.emitters[i];
        if (emitter.particles.empty()) continue;
        const std::string subject = called("emitter", emitter.name, i);
        const std::string use = fmt::format("{} has {} particles with alpha mode {}", subject, emitter.particles.size(),
                                            alpha_mode_names[static_cast<std::size_t>(emitter.alpha_mode)]);
        find_placement(features, emitter, subject);
        features.set(Feature::transparent, use);
        features.set(Feature::particles, use);
        if (emitter.alpha_mode == AlphaMode::additive) features.set(Feature::additive, use);
        const auto only_adds = [](const Particle& particle) { return particle.alpha == 0 && any(particle.emissive); };
        if (std::any_of(emitter.particles.begin(), emitter.particles.end(), only_adds)) {
            features.set(Feature::additive, subject + " has particles that emit and do not cover");
        }
        if (emitter.soft_depth_fade > 0) {
            features.set(Feature::soft_particles, fmt::format("{} fades over {} m", subject, emitter.soft_depth_fade));
        }
        const auto glows = [](const Particle& particle) { return any(particle.emissive); };
        if (std::any_of(emitter.particles.begin(), emitter.particles.end(), glows)) {
            features.set(Feature::emissive, subject + " has particles that emit");
        }
    }
}

void find_in_light(Features& features, const Light& light, const std::string& subject) {
    features.set(Feature::local_lights, subject + " shines");
    if (light.texture != no_index) features.set(Feature::projected_textures, subject + " has a texture");
    if (is_area(light.type)) features.set(Feature::area_lights, fmt::format("{} is a {}", subject, facts_of(light.type).title));
    if (!light.clip_planes.empty()) features.set(Feature::clip_planes, subject + " has clip planes");
    if (light.intensity.x < 0 || light.intensity.y < 0 || light.intensity.z < 0) {
        features.set(Feature::darks, subject + " has negative intensity");
    }
    if (!light.blockers.empty()) features.set(Feature::blockers, subject + " has blockers");
    if (!light.portals.empty()) features.set(Feature::portals, subject + " has portals");
}

/// A shadow needs a light that casts one and something that throws it.
void find_in_lights(Features& features, const Frame& frame) {
    const bool thrown = std::any_of(frame.draws.begin(), frame.draws.end(), [](const Draw& draw) { return draw.casts_shadow; });
    if (any(frame.sun.irradiance)) {
        features.set(Feature::sun, "the sun shines");
        if (frame.sun.shadow.casts && thrown) features.set(Feature::shadows, "the sun casts shadows");
        if (frame.sun.shafts) features.set(Feature::sun_shafts, "the sun has shafts");
    }
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        if (!any(frame.lights[i].intensity)) continue;
        const std::string subject = called("light", frame.lights[i].name, i);
        find_in_light(features, frame.lights[i], subject);
        if (frame.lights[i].shadow.casts && thrown) features.set(Feature::shadows, subject + " casts shadows");
    }
}

void find_in_surroundings(Features& features, const Frame& frame) {
    if (frame.view.samples > 1) features.set(Feature::multisampled, fmt::format("the view has {} samples", frame.view.samples));
    if (any(frame.hemisphere.sky) || any(frame.hemisphere.ground)) features.set(Feature::hemisphere, "sky or ground shines");
    if (frame.fog.density > 0) features.set(Feature::fog, fmt::format("the fog's density is {} per meter", frame.fog.density));
    if (!frame.light_volumes.empty()) {
        features.set(Feature::light_volumes, fmt::format("the frame has {} light volumes", frame.light_volumes.size()));
    }
    if (frame.rain.intensity > 0) features.set(Feature::rain, fmt::format("it rains with intensity {}", frame.rain.intensity));
    if (frame.rain.wetness > 0) features.set(Feature::rain, fmt::format("surfaces are wet by {}", frame.rain.wetness));
}

void find_in_camera(Features& features, const Lens& lens, const Film& film) {
    if (lens.distortion) features.set(Feature::lens_distortion, "the lens distorts");
    if (lens.bloom > 0) features.set(Feature::bloom, fmt::format("the lens blooms by {}", lens.bloom));
    if (lens.auto_exposure) features.set(Feature::auto_exposure, "the camera sets its exposure itself");
    if (lens.aperture > 0) features.set(Feature::depth_of_field, fmt::format("the aperture is {} m", lens.aperture));
    if (film.grain > 0) features.set(Feature::grain, fmt::format("the film's grain is {}", film.grain));
    if (film.fade > 0) features.set(Feature::grain, fmt::format("the film fades by {}", film.fade));
}

}  // namespace

std::string_view name(Feature feature) { return names[static_cast<std::size_t>(feature)]; }

std::span<const Feature> all_features() { return every_feature; }

std::optional<Feature> find_feature(std::string_view wanted) {
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) return std::nullopt;
    return static_cast<Feature>(found - names.begin());
}

std::string_view Features::reason(Feature feature) const {
    const std::optional<std::string>& reason = reasons_[static_cast<std::size_t>(feature)];
    return reason ? std::string_view(*reason) : std::string_view();
}

void Features::set(Feature feature, std::string reason) {
    std::optional<std::string>& held = reasons_[static_cast<std::size_t>(feature)];
    if (!held) held = std::move(reason);
}

Features frame_features(const Frame& frame) {
    Features features;
    find_in_draws(features, frame);
    find_in_emitters(features, frame);
    find_in_lights(features, frame);
    find_in_surroundings(features, frame);
    find_in_camera(features, frame.lens, frame.film);
    return features;
}

}  // namespace strata
