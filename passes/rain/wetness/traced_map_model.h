// The rain map in double: each texel that is asked for is a ray along the rain.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "passes/rain/wetness/wetness_params.h"
#include "passes/reference/rays.h"

namespace strata::rain {

/// What a comparison with the map says, and whether rounding may say otherwise.
struct Reached {
    bool open = true, undecided = false;
};

/// What keeps rain away, for rays.
class CastersInRain {
public:
    CastersInRain(const Frame&, const WetnessParams&);
    CastersInRain(const CastersInRain&) = delete;

    /// Distances to the nearest caster along a ray, nothing where there is none. At which mip the device looks a mask up is its
    /// choice: with masked casters as solid as can be, and without them.
    std::vector<std::optional<double>> distances(const glm::dvec3& origin, const glm::dvec3& direction, double end) const;

private:
    Frame solid_;  ///< with the casters that count, none with holes
    RayScene through_solid_;
    std::optional<Frame> open_;  ///< without those that have holes; none where all are solid
    std::optional<RayScene> through_open_;
};

/// Directions of the world that rain falls in: the recorded one, or those of a wind that turns.
std::vector<glm::dvec3> falling_directions(const Frame&, const WetnessParams&);

/// The map of one direction.
class TracedMap {
public:
    /// The casters must outlive it.
    TracedMap(const CastersInRain&, const Frame&, const WetnessParams&, const glm::dvec3& direction);

    double texel() const { return texel_; }      ///< meters
    glm::dvec3 along() const { return along_; }  ///< view space
    /// Texels along both axes and meters along the rain, of a view-space position.
    glm::dvec3 place(const glm::dvec3& position) const;
    /// Whether nothing lies above this depth, in meters along the rain, in the texel's middle.
    Reached is_reached(glm::ivec2 texel, double depth, double doubt) const;

private:
    /// Of the nearest caster, at the texel's middle or where rasterizing may move it to.
    struct Depths {
        double least = 0, most = 0;
    };
    const Depths& depths(glm::ivec2 texel) const;

    const CastersInRain* casters_;
    std::uint32_t size_;
    double texel_ = 0;
    glm::dvec3 u_, v_, along_;  ///< view space
    glm::dvec2 corner_{0};      ///< meters along u and v of the map's corner, from the eye
    mutable std::unordered_map<std::uint32_t, Depths> known_;
};

}  // namespace strata::rain
