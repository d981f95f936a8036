#include "replay/loaded_frame.h"

namespace strata {

FrameVariant variant_of(const Request& request) {
    return {request.frame, request.extent_divisor, request.samples, request.force};
}

Result<LoadedFrame> load_frame(Frame recorded, const FrameVariant& variant) {
    View& view = recorded.view;
    if (variant.samples != 0 && variant.samples != 1 && variant.samples != 4)
        return fail(Fault::usage, "samples are 1 or 4, not {}", variant.samples);
    if (variant.samples != 0) view.samples = variant.samples;
    if (variant.extent_divisor == 0 || view.width < variant.extent_divisor || view.height < variant.extent_divisor)
        return fail(Fault::usage, "an extent of {} x {} cannot be divided by {}", view.width, view.height,
                    variant.extent_divisor);
    view.width /= variant.extent_divisor;
    view.height /= variant.extent_divisor;

    LoadedFrame loaded{.variant = variant, .frame = std::move(recorded)};
    loaded.features = frame_features(loaded.frame);
    loaded.key = (variant.frame << 24) ^ (std::uint64_t(variant.extent_divisor) << 8) ^ loaded.frame.view.samples;
    for (const Feature feature : variant.force) {
        loaded.features.set(feature, "forced");
        loaded.key ^= 1ull << (32 + static_cast<unsigned>(feature) % 32);
    }
    return loaded;
}

}  // namespace strata
