#include "capture_format/export/gltf_losses.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/core.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/light_types.h"

namespace strata::to_gltf_parts {
namespace {

/// How many elements have the property.
template <typename List, typename Property>
std::size_t count(const List& list, const Property& property) {
    return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), property));
}

/// Collects the sentences of what is there, with its number behind.
class Losses {
public:
    void add(std::size_t number, std::string_view sentence) {
        if (number > 0) sentences_.push_back(fmt::format("{} ({})", sentence, number));
    }
    void add_if(bool is_lost, std::string_view sentence) {
        if (is_lost) sentences_.emplace_back(sentence);
    }
    std::vector<std::string> sentences() && { return std::move(sentences_); }

private:
    std::vector<std::string> sentences_;
};

void add_surfaces(Losses& losses, const Frame& frame) {
    using M = const Material&;
    losses.add(count(frame.materials, [](M m) { return m.alpha_mode == AlphaMode::premultiplied; }),
               "materials are premultiplied; they are written as blending ones");
    losses.add(count(frame.materials, [](M m) { return m.alpha_mode == AlphaMode::additive; }),
               "materials add light; they are written as blending ones");
    losses.add(count(frame.materials,
                     [](M m) { return m.lighting_model != LightingModel::unlit && m.lighting_model != LightingModel::ggx; }),
               "materials are lit by a model of their own; glTF knows ggx and none");
    losses.add(count(frame.materials, [](M m) { return m.distortion != 0; }), "materials distort what is behind them; left out");
    losses.add(count(frame.materials, [](M m) { return !is_transparent(m.alpha_mode) && m.transmission != glm::vec3(0); }),
               "opaque materials have a transmission; left out");
    std::vector<bool> shown(frame.meshes.size());
    for (const Draw& draw : frame.draws) shown[draw.mesh] = true;
    losses.add(count(shown, [](bool is_shown) { return !is_shown; }), "meshes are drawn by nothing; left out");
}

void add_draws(Losses& losses, const Frame& frame) {
    using D = const Draw&;
    losses.add(count(frame.draws, [](D d) { return d.to_world != d.previous_to_world; }),
               "draws move; where they were is left out");
    losses.add(count(frame.draws, [](D d) { return d.sort_priority != 0; }), "draws have a sort priority; left out");
    losses.add(count(frame.draws, [](D d) { return d.resolution != Resolution::full; }),
               "draws are made at low resolution; left out");
    losses.add(count(frame.draws, [](D d) { return d.layer != 0; }), "draws are on another layer than the world; left out");
    losses.add(count(frame.draws, [](D d) { return !d.casts_shadow; }), "draws cast no shadow; left out");
    losses.add(frame.emitters.size(), "emitters of particles are left out");
}

void add_lights(Losses& losses, const Frame& frame) {
    using L = const Light&;
    losses.add(count(frame.lights, [](L l) { return !is_punctual(l); }),
               "lights are areas, square spots or take light away; left out");
    losses.add(count(frame.lights, [](L l) { return is_punctual(l) && l.texture != no_index; }),
               "lights project a texture; the texture is left out");
    losses.add(count(frame.lights, [](L l) { return is_punctual(l) && (!l.clip_planes.empty() || !l.blockers.empty()); }),
               "lights are cut by planes or blockers; they are written whole");
    losses.add(count(frame.lights, [](L l) { return is_punctual(l) && has_range(l.type) && l.window != RangeWindow::quartic; }),
               "lights end by (1 - x^4)^2 at their range; readers of glTF end them by 1 - x^4");
    losses.add(count(frame.lights, [](L l) { return is_punctual(l) && l.shadow.casts; }),
               "lights cast shadows; glTF leaves that open");
    losses.add(frame.blockers.size(), "blockers are left out");
    losses.add(frame.portals.size(), "portals are left out");
    losses.add(frame.light_volumes.size(), "light volumes are left out");
    losses.add_if(frame.sun.shafts, "the sun's shafts are left out");
    losses.add_if(frame.sun.irradiance != glm::vec3(0) && frame.sun.shadow.casts, "the sun casts shadows; glTF leaves that open");
    losses.add_if(frame.hemisphere.sky != glm::vec3(0) || frame.hemisphere.ground != glm::vec3(0),
                  "the light of the sky is left out");
}

void add_picture(Losses& losses, const Frame& frame) {
    const View& view = frame.view;
    losses.add_if(frame.background != glm::vec3(0), "the background is left out");
    losses.add_if(frame.fog.density != 0, "the fog is left out");
    losses.add_if(frame.rain.intensity != 0 || frame.rain.wetness != 0, "the rain is left out");
    losses.add_if(frame.lens.bloom != 0 || frame.lens.auto_exposure || frame.lens.aperture != 0 || frame.lens.distortion,
                  "the effects of the lens are left out");
    losses.add_if(frame.film.grain != 0 || frame.film.fade != 0 || frame.film.white != Film().white, "the film is left out");
    losses.add_if(view.exposure != 1, "the exposure is left out");
    losses.add_if(view.jitter != glm::vec2(0), "the camera's jitter is left out");
    losses.add_if(view.projection[2][0] != 0 || view.projection[2][1] != 0, "the camera looks off its center; glTF's cannot");
    losses.add(frame.recorded_with.size(), "choices of techniques are left out");
}

}  // namespace

bool is_punctual(const Light& light) {
    const LightTypeFacts& facts = facts_of(light.type);
    const bool shape = (facts.shape == LightShape::point && facts.cone != LightCone::square) || !has_range(light.type);
    return shape && glm::all(glm::greaterThanEqual(light.intensity, glm::vec3(0)));
}

std::vector<std::string> losses(const Frame& frame) {
    Losses losses;
    add_surfaces(losses, frame);
    add_draws(losses, frame);
    add_lights(losses, frame);
    add_picture(losses, frame);
    return std::move(losses).sentences();
}

}  // namespace strata::to_gltf_parts
