// The name of the voxel technique, which the tests of its volume repeat most.
#pragma once

#include <string>

namespace strata {

inline const std::string voxel = "transparency/voxel";

}  // namespace strata
