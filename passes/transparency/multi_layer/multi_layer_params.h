// Parameters of multi-layer alpha blending.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct MultiLayerParams {
    std::uint32_t layers;   ///< nodes per sample and bucket
    std::uint32_t buckets;  ///< depth ranges with nodes of their own
    float pool;             ///< million fragments kept at a time
};

}  // namespace strata::transparency
