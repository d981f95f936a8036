#include "replay/session/loaded_frame.h"

#include <bit>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/view.h"
#include "passes/scene/pre_exposure.h"

namespace strata {

LoadedFrame::LoadedFrame(FrameVariant of, Frame recorded) : variant(std::move(of)), frame(std::move(recorded)) {}
LoadedFrame::~LoadedFrame() = default;

Result<std::unique_ptr<LoadedFrame>> load_frame(Frame recorded, const FrameVariant& variant) {
    View& view = recorded.view;
    if (variant.samples != 0 && variant.samples != 1 && variant.samples != 4)
        return fail(Fault::usage, "frame.sample_count", "samples are 1 or 4, not {samples}", variant.samples);
    if (variant.samples != 0) view.samples = variant.samples;
    if (variant.extent_divisor == 0 || view.width < variant.extent_divisor || view.height < variant.extent_divisor)
        return fail(Fault::usage, "frame.extent_divisor", "an extent of {width} x {height} cannot be divided by {divisor}",
                    view.width, view.height, variant.extent_divisor);
    view.width /= variant.extent_divisor;
    view.height /= variant.extent_divisor;
    for (const EyeAxis& axis : eye_axes())
        if (!std::isfinite(variant.eye.*axis.member))
            return fail(Fault::usage, "eye.not_a_number", "the eye's {axis} is not a number", axis.name);
    view = moved(view, variant.eye);
    pre_expose(recorded, pre_exposure(recorded));

    auto loaded = std::make_unique<LoadedFrame>(variant, std::move(recorded));
    loaded->features = loaded->facts.features();
    loaded->key = (variant.frame << 24) ^ (std::uint64_t(variant.extent_divisor) << 8) ^ loaded->frame.view.samples;
    for (const EyeAxis& axis : eye_axes())
        loaded->key = std::rotl(loaded->key, 1) ^ std::bit_cast<std::uint64_t>(variant.eye.*axis.member) * 0x9e3779b97f4a7c15ull;
    for (const Feature feature : variant.force) {
        loaded->features.set(feature, "forced");
        loaded->key ^= 1ull << (32 + static_cast<unsigned>(feature) % 32);
    }
    return loaded;
}

}  // namespace strata
