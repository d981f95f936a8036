// The wet surface under every sample: what the formulas give where rain is traced.
#pragma once

#include <span>

#include "passes/image_set.h"
#include "passes/reference/image.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

/// surface_color, surface_normal and surface_material. Rain arrives at a sample where no caster lies on the one ray that runs
/// from it against the rain's direction: 0 or 1, at any distance. Waves are as high however small they are on the screen.
ImageSet rain_truth(const StageInput&);
/// The same with wet_form=xray.
ImageSet xray_rain_truth(const StageInput&);
/// The same two in a wind that turns: the mean of 64 directions, tilted from the recorded one by rain::wind_spread.
ImageSet rain_in_wind_truth(const StageInput&);
ImageSet xray_rain_in_wind_truth(const StageInput&);

namespace rain {

/// Whether rain arrives at every sample, from 0 to 1; 0 where there is no surface. From several directions of the world their
/// mean.
ReferenceImage traced_rain(const StageInput&, std::span<const glm::dvec3> directions);

}  // namespace rain
}  // namespace strata
