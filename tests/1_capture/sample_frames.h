// Small frames for the tests of captures.
#pragma once

#include "capture_format/frame/frame.h"

namespace strata {

/// One lit triangle; everything else is default.
Frame triangle_frame();
/// Something of everything: textures, every kind of draw and light, particles with NaN, blockers, volumes, settings.
Frame rich_frame();

}  // namespace strata
