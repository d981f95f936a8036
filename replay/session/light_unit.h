// Between the unit in which a run stores radiance (passes/scene/pre_exposure.h) and the one that the frame is recorded in. A
// Session takes and gives recorded radiance; images that only a technique knows stay as it stores them.
#pragma once

#include <string_view>

#include "passes/image_set.h"
#include "replay/images/host_image.h"

namespace strata {

struct NumberTable;  // replay/session/session.h

/// Whether the image of a frame, or the debug view "stage/technique:view", holds radiance.
bool holds_radiance(std::string_view name);

/// The image with its colors times the factor, as floats, if it holds radiance; else the image itself.
HostImage scaled_light(std::string_view name, HostImage, double factor);
/// The columns of a table that are in watts.
void scale_light(NumberTable&, double factor);
/// The same of images in double, with their standard errors.
void scale_light(ImageSet&, double factor);
/// The images themselves where the factor is 1, else a scaled copy of them in `room`.
const ImageSet& in_unit(double factor, const ImageSet&, ImageSet& room);

}  // namespace strata
