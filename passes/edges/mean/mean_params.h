// Parameters of the test of the mean.
#pragma once

#include <cstdint>

namespace strata::edges {

struct MeanParams {
    std::uint32_t compares;
};

}  // namespace strata::edges
