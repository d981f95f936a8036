// A frame for those who use some of its members: the lists are of types that the headers beside this one define, so that a reader
// of lights includes light.h, too. capture_format/frame.h has all.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"
#include "capture_format/frame/lens.h"
#include "capture_format/frame/weather.h"
#include "capture_format/view.h"

namespace strata {

struct Blocker;      // light.h
struct Draw;         // draw.h
struct Emitter;      // particles.h
struct Light;        // light.h
struct LightVolume;  // light_volume.h
struct Material;     // material.h
struct Mesh;         // mesh.h
struct Portal;       // light.h
struct StageChoice;  // stage_choice.h
struct Texture;      // texture.h

struct Frame {
    Frame();
    Frame(const Frame&);
    Frame(Frame&&) noexcept;
    Frame& operator=(const Frame&);
    Frame& operator=(Frame&&) noexcept;
    ~Frame();

    View view;
    double time = 0;          ///< seconds
    std::uint64_t index = 0;  ///< of the recording application
    std::uint64_t seed = 0;

    std::vector<Texture> textures;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Draw> draws;        ///< in submission order
    std::vector<Emitter> emitters;  ///< submitted after all draws

    std::vector<Light> lights;
    std::vector<Blocker> blockers;
    std::vector<Portal> portals;
    Sun sun;
    Hemisphere hemisphere;
    glm::vec3 background{0};  ///< radiance where no surface is
    Fog fog;
    std::vector<LightVolume> light_volumes;
    Rain rain;
    Lens lens;
    Film film;

    std::vector<StageChoice> recorded_with;

    /// Factor that all radiance above has been multiplied by for the replay (passes/scene/pre_exposure.h); the base color of
    /// unlit materials has not. 1 in a recorded frame; no part of a capture.
    double pre_exposure = 1;
};

}  // namespace strata
