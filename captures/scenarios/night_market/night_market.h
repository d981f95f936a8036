// The parts of night_market: what its sources share. World axes: the street runs along -z, 5.2 m wide, y = 0 is its paving.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "captures/scenarios/frame_builder.h"

namespace strata::scenario::market {

/// Indices of materials.
struct Materials {
    std::uint32_t setts, kerb, brick, plaster, planks, boards;  // surfaces of the street
    std::uint32_t iron, steel, ceramic, dough, rubber;
    std::uint32_t red_cloth, blue_cloth, green_cloth, coat, dark_coat, skin, red_nylon, dark_nylon;
    std::uint32_t paper, lit_paper, lit_window, dark_window, warm_bulb;
    std::uint32_t pink_neon, amber_neon, cyan_neon;
    std::uint32_t clear_glass, green_glass, amber_glass, blue_glass, red_glass;
    std::uint32_t orange, apple, lime, plum, leaf;
};
Materials add_materials(FrameBuilder&);

/// Adds lights and remembers them, for the puffs and drops they shine on: particles are recorded as already lit.
class Lamps {
public:
    explicit Lamps(FrameBuilder& builder) : builder_(&builder) {}

    /// A sphere light; its intensity in W/sr, however large it is. The reference holds until the next light.
    Light& globe(std::string name, glm::dvec3 position, glm::vec3 intensity, float radius);
    /// A tube light along an axis; intensity in W/sr, straight across.
    Light& tube(std::string name, glm::dvec3 middle, glm::vec3 half_axis, glm::vec3 intensity);
    /// A round spot.
    Light& spot(std::string name, glm::dvec3 position, glm::vec3 direction, glm::vec3 intensity);
    /// Radiance that a white puff scatters there.
    glm::vec3 scattered(glm::dvec3 place) const;

private:
    struct Shine {
        glm::dvec3 position;
        glm::vec3 intensity;
    };

    Light& add(std::string name, LightType, glm::dvec3 position, glm::vec3 intensity);

    FrameBuilder* builder_;
    std::vector<Shine> shines_;
};

/// Paving, houses, signs, cables, the room behind the open door with its light volume.
void add_street(FrameBuilder&, const Materials&, Lamps&);
/// Counters, awnings, goods and lanterns.
void add_stalls(FrameBuilder&, const Materials&, Lamps&);
/// Sellers and passers-by.
void add_people(FrameBuilder&, const Materials&);
/// Steam, smoke, haze, rain, sparks and the glow around neon: after all lamps.
void add_air(FrameBuilder&, const Lamps&);
/// Letters of glass tube, upright: `meters` high, right of `start` along the x axis or below each other. S T R A O D L E N B P.
enum class Lettering { along, down };
Mesh neon_letters(const std::string& text, float meters, Lettering);

constexpr glm::dvec3 pot{1.1, 1.32, -6.19};    ///< where steam rises
constexpr glm::dvec3 grill{1.45, 1.1, -10.9};  ///< where smoke and sparks rise

}  // namespace strata::scenario::market
