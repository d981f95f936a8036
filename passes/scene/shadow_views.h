// Where shadow maps look from: one view per cascade of the sun, one per shadowed spot, six per shadowed omni light, in double.
// The scene uploads them as ShadowRecord; a view's place in the list is its slot.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/scene/draw_bounds.h"
#include "passes/scene/light_list.h"

namespace strata {

/// (u, v, depth, w) = view_to_map * (p, 1): after division by w the map covers uv 0..1 and depth is 1 at the light, 0 far.
struct ShadowView {
    glm::dmat4 view_to_map{1};
    std::uint32_t light = 0;  ///< in the order of light_list()
    std::uint32_t size = 0;   ///< texels per edge
    double bias = 0;          ///< meters towards the light along its rays
    double range_begin = 0;   ///< view depth from which a cascade serves ...
    double read_from = 0;     ///< view depth from which a cascade is read: where the one before it blends into it
    double range_end = 0;     ///< ... and until which; its last tenth blends into the next cascade, the last one's into lit
    double texel = 0;         ///< edge of a texel in meters: anywhere for the sun, else at one meter along the axis
    double source_width = 0;  ///< of the light, meters: twice source_radius; of the sun per meter: 2 tan(angular_radius)
    bool soft = false;        ///< wants penumbrae
    glm::uvec2 offset{0};     ///< of its upper left texel in its layer
    std::uint32_t layer = 0;  ///< of shadow_maps
};

/// own: as large as the light asks for, in a layer each, which is as large as the largest. need: as large as the light's reach on
/// the screen calls for (map_places.h), several in a layer. The same lights and slots either way.
enum class Allocation : std::uint32_t { own, need };

/// Of the lights that can have maps (the sun, round and square spots, omni lights and spheres), shine and cast. A sphere's map is
/// that of its center. Tubes, discs, rectangles and further directional lights cast no mapped shadow.
std::vector<ShadowView> shadow_views(const Frame&, Allocation = Allocation::own);
/// The same where the lights and the spheres around the casters are known, as SceneFacts does: no vertex is walked.
struct LitCasters {
    std::span<const Light> lights;  ///< light_list()
    std::span<const BoundingSphere> casters;
};
std::vector<ShadowView> shadow_views(const Frame&, const LitCasters&, Allocation);

/// Whether a light has six maps, one per face of a cube that stands along the world's axes: +x, -x, +y, -y, +z, -z.
bool has_faces(const Light&);
/// The face whose axis the direction is nearest to; x before y before z where two are equally near.
std::uint32_t cube_face(const glm::dvec3& world_direction);

/// Lights that have views, each once: the k-th owns the layers k * samples ... of FrameImages::visibility.
std::vector<std::uint32_t> shadowed_lights(std::span<const ShadowView>);

/// Ends of the splits of near..far: share * logarithmic + (1 - share) * uniform (Zhang et al. 2006,
/// docs/algorithms/lighting.md 6.4).
std::vector<double> cascade_ends(double near, double far, std::uint32_t count, double share);

/// Share of the logarithmic scheme (CSM_LAMBDA, docs/algorithms/lighting.md 8.1).
inline constexpr double cascade_share = 0.75;
/// Share of a cascade's depth over which it blends into the next (docs/algorithms/lighting.md 6.4).
inline constexpr double cascade_blend = 0.1;

}  // namespace strata
