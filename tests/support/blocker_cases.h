// Random tiles, each with a light, its blockers and portals and points of the tile's surfaces, as shaders get them; and what a
// shader makes of them, in float on the CPU. The same seed gives the same cases to tests with a device and without.
#pragma once

#include <cstdint>
#include <vector>

#include "passes/lighting/cells.h"

namespace strata {

struct BlockerCases {
    std::vector<LightRecord> lights;  ///< one per case
    std::vector<lighting::Cell<float>> cells;
    std::vector<glm::vec3> points;  ///< points_per_case per case, already off their surfaces
    std::vector<BlockerRecord> blockers;
    std::vector<LightBlockerRecord> light_blockers;
    std::vector<BlockerPortalRecord> portals;
};
inline constexpr std::size_t points_per_case = 48;

/// 1 to 5 blockers each, 0 to 2 turned portals in every one of them, some without area; a fifth of the lights is directional.
BlockerCases blocker_cases(std::size_t count, std::uint32_t seed);

/// passes/shaders/blockers.glsl in C++.
bool blockers_pass(const BlockerCases&, const LightRecord&, const glm::vec3& position, glm::uvec2 blocker_and_portal_mask);
glm::vec4 light_point(const LightRecord&);
std::uint32_t low_bits(std::uint32_t count);

/// passes/lighting/blocker_cells.glsl in C++: classes of a case's blockers and portals, by their place in the light's lists.
struct CaseClasses {
    std::vector<lighting::Reach> blockers, portals;
};
CaseClasses classes(const BlockerCases&, std::size_t index);

/// What is left to test per pixel after the classes of a tile (docs/algorithms/lighting.md 2.4, P2 to P5).
struct CaseMasks {
    std::uint32_t blockers = 0, portals = 0;
    bool killed = false;
};
CaseMasks masks(const BlockerCases&, std::size_t index, const CaseClasses&);

}  // namespace strata
