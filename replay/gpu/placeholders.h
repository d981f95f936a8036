// What stands in where a shader declares an image or a buffer and the frame has none: one texel of zero, a buffer of zeros.
// Every slot of a bound set is written: lavapipe 22.3.6 crashes on an unwritten sampler slot, even an unused one.
#pragma once

#include <map>
#include <optional>

#include "passes/graph/plan.h"
#include "replay/gpu/buffer.h"
#include "replay/gpu/image.h"

namespace strata {

class Placeholders {
public:
    explicit Placeholders(OpenedDevice&);

    /// In the general layout, as the shader declares it. What a shader stores goes into one that nobody reads.
    DeviceImage& image(const PlannedBinding&);
    DeviceBuffer& buffer(Access);

private:
    struct Kind {
        Format format;
        ImageDimension dimension;
        std::uint32_t samples;
        bool is_written;
        friend auto operator<=>(const Kind&, const Kind&) = default;
    };

    OpenedDevice* device_;
    std::map<Kind, DeviceImage> images_;
    std::map<bool, DeviceBuffer> buffers_;  // by whether it is written
};

}  // namespace strata
