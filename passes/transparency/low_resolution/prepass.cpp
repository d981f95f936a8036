#include "passes/transparency/low_resolution/prepass.h"

#include "capture_format/frame_features.h"
#include "passes/graph/graph.h"

namespace strata::transparency {
namespace {

constexpr std::string_view channel_choices[] = {"automatic", "mono", "rgb"};
constexpr std::string_view resolutions[] = {"full", "half", "quarter", "eighth"};

}  // namespace

Extent prepass_extent(Extent extent, std::uint32_t divisor) {
    return {(extent.width + divisor - 1) / divisor, (extent.height + divisor - 1) / divisor, 1};
}

FrameImages prepass_images(Graph& graph, const FrameImages& images, std::uint32_t divisor) {
    if (divisor == 1 && images.samples == 1) return images;
    FrameImages low = images;
    low.extent = prepass_extent(images.extent, divisor);
    low.samples = 1;
    low.depth = graph.create("prepass depth", Shape{.extent = low.extent, .format = Format::d32f});
    low.depth_layers = graph.create("prepass depth to read", Shape{.extent = low.extent, .format = Format::r32f});
    graph.clear(low.depth, {});
    graph.fullscreen("transparency/low_resolution/farthest_depth")
        .samples("depth_layers", images.depth_layers)
        .fixes("divisor", static_cast<std::int32_t>(divisor))
        .covers(low.depth_layers)
        .writes_depth(low.depth);
    return low;
}

const Param resolution_row = {.name = "resolution",
                              .low = 0,
                              .high = 3,
                              .fallback = 0,
                              .help =
                                  "resolution of the pass that gathers optical depth, relative to the frame; lower: less time "
                                  "and memory, leaks at silhouettes",
                              .choices = resolutions};

const Param channels_row = {.name = "channels",
                            .low = 0,
                            .high = 2,
                            .fallback = 0,
                            .help =
                                "transmittance functions per texel; mono: one; rgb: one per color channel; automatic: rgb if the "
                                "frame has colored transmittance",
                            .choices = channel_choices};

std::uint32_t channel_count(std::uint32_t channels, const Features& features) {
    if (channels == 0) return features.has(Feature::chromatic) ? 3 : 1;
    return channels == 1 ? 1 : 3;
}

std::uint32_t divisor_of(std::uint32_t resolution) { return 1u << resolution; }

PrepassRead prepass_read(const FrameImages& images, std::uint32_t resolution, Resolution drawn_at) {
    if (resolution == 0 && drawn_at == Resolution::full) return {Filter::nearest, 0};
    if (has(images.capabilities, Capability::filtered_floats)) return {Filter::linear, 0};
    return {Filter::nearest, 1};
}

}  // namespace strata::transparency
