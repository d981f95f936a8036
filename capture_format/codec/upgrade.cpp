// The changelog of the frame format. A step changes meaning; a field that was only added needs none but the function that
// does nothing, and its line here. Add the function, its row, and raise format_version.
//
//   1    the first: a section is a flatbuffer
//   2    a section is what changed since the frames before it (frame_delta.cpp)
#include "capture_format/codec/upgrade.h"

#include <array>

#include "capture_format/frame/frame.h"

namespace strata {
namespace {

constexpr std::array<UpgradeStep, format_version - 1> steps = {{
    {"a frame's section tells what changed since the frames before it; the frame means what it meant",
     [](Frame frame) { return frame; }},
}};

}  // namespace

std::span<const UpgradeStep> upgrade_steps() { return steps; }

Result<void> check_format_version(std::uint32_t version) {
    if (version >= 1 && version <= format_version) return {};
    return fail(Fault::bad_input, "capture.frame.version",
                "the frame has format version {version}; this program reads 1 to {newest}: {advice}", version, format_version,
                version > format_version ? "open it with a newer strata" : "it was not written by strata");
}

Frame upgrade(Frame frame, std::uint32_t version, std::span<const UpgradeStep> table) {
    for (const UpgradeStep& step : table.subspan(version - 1)) frame = step.apply(std::move(frame));
    return frame;
}

}  // namespace strata
