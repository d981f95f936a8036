// Parameters of moment-based transparency.
#pragma once

#include <cstdint>

namespace strata::transparency {

struct MomentsParams {
    std::uint32_t kind;
    std::uint32_t storage;
    float bias;            ///< multiplies the published bias of kind and storage
    float overestimation;  ///< share of the absorbance at z that counts as in front
    std::uint32_t compensation;
    std::uint32_t channels;
    std::uint32_t resolution;
    std::uint32_t accumulation;
    float pool;  ///< million fragments kept at a time, for storage_normalized
};

}  // namespace strata::transparency
