// The truth of ambient occlusion: the share of a uniform hemisphere's light that reaches each sample, traced in double from the
// surfaces that earlier stages gave, so that this stage is judged alone.
//
//     V = (1 / pi) * integral over the hemisphere of the sample's normal n of (1 - occluded(w)) (n.w) dw
//
// occluded(w) is 1 where a ray from the sample along w hits a surface nearer than the radius, and 0 elsewhere. Both faces of
// every opaque or masked triangle occlude, masked ones where their alpha at mip 0 reaches the cutoff (passes/reference/rays.h).
// There is no falloff: a technique that fades occluders over distance is judged by what that changes.
#pragma once

#include <vector>

#include "passes/metric.h"
#include "passes/occlusion/radii.h"
#include "passes/reference/image.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// Directions over a sample: `batches` independent sets of side x side, each with one direction in every part of the hemisphere.
struct TracedDirections {
    std::uint32_t side = 12, batches = 4;
};

/// V in x, with its standard error by how much the batches differ (0 of a single one); 1 where there is no surface. Equal for
/// equal inputs, whatever the number of threads.
ReferenceImage traced_visibility(const StageInput&, double radius, const TracedDirections& = {});

/// The image that combine multiplies ambient light by, for visibility V: docs/algorithms/deferred.md 8.3.
double occlusion_of(double visibility, double material, occlusion::MaterialRule);

/// Of the default radius.
ImageSet occlusion_truth(const StageInput&);
/// For people: what it is, with how many directions.
std::string_view occlusion_truth_is();
/// Of the other radii, and of all radii with MaterialRule::darker.
std::vector<TruthRow> other_occlusion_truths();

}  // namespace strata
