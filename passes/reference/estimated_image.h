// Truths that are estimates: at every surface that a G-buffer gave, the mean of batches of random directions.
#pragma once

#include <cstdint>
#include <functional>

#include "passes/reference/directions.h"
#include "passes/reference/image.h"
#include "passes/reference/shade.h"

namespace strata {

/// The decoded images of a G-buffer that an estimate starts from: surface_normal and surface_material.
struct GivenSurfaces {
    const ReferenceImage &normal, &material;
};

/// An estimate from one set of directions, whose numbers no other set is drawn from.
using EstimateBatch = std::function<glm::dvec3(const SurfacePoint&, DrawnNumbers)>;

/// The mean of `batches` estimates in x, y and z, with its standard error by how much they differ (0 of a single one); a is 1 on
/// a surface, and where there is none the texel is `nothing`. Samples of one surface are estimated once. Rows run in parallel;
/// equal for equal inputs, whatever the number of threads.
ReferenceImage estimated_image(const Frame&, const GivenSurfaces&, std::uint32_t batches, const glm::dvec4& nothing,
                               const EstimateBatch&);

}  // namespace strata
