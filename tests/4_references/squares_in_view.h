// An eye at the origin, and squares before it.
#pragma once

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

/// An eye at the origin that looks along +z; its image is as wide as it is far.
Frame empty_view();
/// Lies flat.
void add_square(Frame&, const glm::dvec3& center, float half);

}  // namespace strata
