// What stands in where a shader declares an image and the frame has none: one texel of zero. (A plan has no absent buffers.)
// Every slot of a bound set is written: lavapipe 22.3.6 crashes on an unwritten sampler slot, even an unused one.
#pragma once

#include <map>
#include <optional>

#include "passes/graph/plan.h"
#include "replay/gpu/image.h"

namespace strata {

class Placeholders {
public:
    explicit Placeholders(OpenedDevice&);

    /// In the general layout, of the kind the shader declares. What a shader stores goes into one that nobody reads.
    DeviceImage& image(const PlannedBinding&);

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
};

}  // namespace strata
