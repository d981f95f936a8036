#include "replay/loaded_frame.h"

#include <bit>
#include <cmath>

namespace strata {

namespace {

void move_eye(View& view, const EyeMove& move) {
    view.origin += move.dolly * glm::transpose(view.to_view)[2];
    const double c = std::cos(move.pan), s = std::sin(move.pan);
    view.to_view = glm::dmat3({c, 0, s}, {0, 1, 0}, {-s, 0, c}) * view.to_view;  // columns: where x, y and z go
}

}  // namespace

FrameVariant variant_of(const Request& request) {
    return {request.frame, request.extent_divisor, request.samples, request.eye, request.force};
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
    move_eye(view, variant.eye);

    LoadedFrame loaded{.variant = variant, .frame = std::move(recorded)};
    loaded.features = frame_features(loaded.frame);
    loaded.key = (variant.frame << 24) ^ (std::uint64_t(variant.extent_divisor) << 8) ^ loaded.frame.view.samples;
    for (const double moved : {variant.eye.dolly, variant.eye.pan})
        loaded.key = std::rotl(loaded.key, 1) ^ std::bit_cast<std::uint64_t>(moved) * 0x9e3779b97f4a7c15ull;
    for (const Feature feature : variant.force) {
        loaded.features.set(feature, "forced");
        loaded.key ^= 1ull << (32 + static_cast<unsigned>(feature) % 32);
    }
    return loaded;
}

}  // namespace strata
