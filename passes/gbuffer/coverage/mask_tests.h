// The modes of coverage.shared.h in double, on recorded frames.
#pragma once

#include <cstdint>

#include "passes/gbuffer/coverage/bands.h"
#include "passes/reference/mask_test.h"

namespace strata {

struct Material;  // capture_format/frame/material.h

}  // namespace strata

namespace strata::gbuffer {

/// Which samples a masked surface covers by a mode. Attributes are shaded at the pixel's center, where one decision is made for
/// all samples of the pixel, or at the sample.
MaskTest mask_model(const Frame&, std::uint32_t mode, ShadeAt);

/// What alpha is made of at a point of a masked surface, and its change per pixel as the 2x2 quad of the pixel has it.
struct MaskPoint {
    glm::dvec2 uv{0}, uv_x{0}, uv_y{0};
    double vertex = 1, vertex_x = 0, vertex_y = 0;  ///< alpha of the vertices' colors
};

/// The same where one sample in the middle of each pixel is drawn, of whatever picture: casters of shadow maps.
using PointMaskTest = std::function<MaskCover(const Material&, const MaskPoint&, const BandPlace&)>;

/// The frame must outlive it; materials are its own. The mode is masked_clip, masked_mip_coverage or one of bands.
PointMaskTest point_mask_model(const Frame&, std::uint32_t mode);

/// Alpha at a point, and whether it reaches a cutoff whatever a float makes of it.
double alpha_at(const Frame&, const Material&, const MaskPoint&);
MaskCover cover_by_cutoff(double alpha, double cutoff);

/// Of a masked material: by what alpha of a mip is multiplied with masked=mip_coverage.
double mip_scale_model(const Frame&, const Material&, std::uint32_t mip);

}  // namespace strata::gbuffer
