// Light that a run could not hold: texels that are no number, and half floats at their largest value, which cut off what is
// brighter.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/image.h"
#include "replay/images/host_image.h"

namespace strata {

struct LightFault {
    enum class Kind { not_finite, cut_off };
    Kind kind = Kind::not_finite;
    std::string pass;   ///< as PassImages::label
    std::string image;  ///< of frame_images.h
    std::size_t texels = 0;
    glm::uvec2 first{0};
    double limit = 0;  ///< of light that is cut off: the largest radiance that the image holds, in the frame's unit
};

/// Whether an image of the frame holds radiance or display light.
bool holds_light(std::string_view image);

/// At most one of each kind, in an image as the device stores it; none where it holds no light.
std::vector<LightFault> light_faults(std::string_view image, const HostImage&, double pre_exposure);
/// The same of an image that was read in double.
std::vector<LightFault> light_faults(std::string_view image, Format, const ReferenceImage&, double pre_exposure);

/// "69 pixels of 'display' are not finite after film, first at 12, 7"
std::string sentence(const LightFault&);

}  // namespace strata
