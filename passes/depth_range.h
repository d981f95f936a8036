// Nearest and farthest view depth of something: a plain value.
#pragma once

namespace strata {

/// In meters.
struct DepthRange {
    float nearest = 0, farthest = 0;
};

}  // namespace strata
