// How exact an image of estimates by random numbers is.
#pragma once

#include <optional>

#include "passes/reference/image.h"

namespace strata {

/// How far the image is expected to be from what it estimates, as Difference has it.
struct StandardError {
    double rmse = 0, relative = 0;
};

/// Over every decided texel. Nothing where the image is no estimate.
std::optional<StandardError> standard_error(const ReferenceImage&);

}  // namespace strata
