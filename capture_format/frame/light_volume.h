// Light propagation volumes of a frame.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture_format/frame/glm_types.h"

namespace strata {

enum class VolumeKind : std::uint32_t { cascaded_global, fixed_local };
enum class VolumeOcclusion : std::uint32_t { none, fuzzy_geometry, axial };

/// A light propagation volume.
struct LightVolume {
    VolumeKind kind = VolumeKind::cascaded_global;
    VolumeOcclusion occlusion = VolumeOcclusion::none;
    glm::dvec3 center{0};
    glm::vec3 half_extent{16};
    glm::uvec3 cells{32};
    std::uint32_t cascades = 1;
    std::uint32_t iterations = 16;
};

}  // namespace strata
