#include "passes/lens/exposure/adaptation.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {
namespace {

constexpr const char *state_name = "exposure state", *held_name = "held exposure", *tiles_name = "luminance of tiles";

/// Ticks of 2^-20 s: differences between frames are right after hours, where a float of seconds has steps of milliseconds (H18).
uvec2 ticks_of(const Frame& frame) {
    constexpr double longest = 1e12;
    const double seconds = std::clamp(frame.time, -longest, longest);
    const auto ticks = static_cast<std::uint64_t>(std::llround(seconds * double(ticks_per_second)));
    return {static_cast<uint>(ticks), static_cast<uint>(ticks >> 32)};
}

Image one_texel(Graph& graph, const char* name, Format format) { return graph.create(name, {.extent = {}, .format = format}); }

/// Groups of pixels that are measured.
Extent tiles_of(const FrameImages& frame) {
    return {(frame.extent.width + meter_tile - 1) / meter_tile, (frame.extent.height + meter_tile - 1) / meter_tile};
}

AdaptPush push_of(const FrameImages& frame, const LensParams& params) {
    const Extent tiles = tiles_of(frame);
    return {.ticks = ticks_of(*frame.recorded),
            .tiles = tiles.width * tiles.height,
            .speed = frame.recorded->lens.exposure_speed,
            .amount = params.exposure_amount,
            .gray = params.exposure_grey};
}

}  // namespace

void recall_exposure(Graph& graph, FrameImages& frame) {
    const Buffer state = graph.remember(state_name, sizeof(ExposureState));
    frame.exposure = one_texel(graph, held_name, Format::rgba32f);
    graph.compute("lens/exposure/held.comp")
        .stores("held", frame.exposure)
        .loads("State", state)
        .push(HeldPush{ticks_of(*frame.recorded)})
        .groups({1, 1, 1});
}

void adapt_exposure(Graph& graph, FrameImages& frame, const LensParams& params) {
    const Extent tiles = tiles_of(frame);
    const Image held = frame.exposure;
    Buffer measured = graph.create(tiles_name, tiles.width * tiles.height * sizeof(MeterRecord));
    Buffer state = graph.find_buffer(state_name);
    frame.exposure = one_texel(graph, "exposure", Format::r32f);
    graph.compute("lens/exposure/meter.comp")
        .samples("color", frame.color)
        .samples("held", held)
        .stores("Tiles", measured)
        .fixes("form", params.exposure)
        .groups(tiles);
    graph.compute("lens/exposure/adapt.comp")
        .stores("exposure", frame.exposure)
        .loads("Tiles", measured)
        .samples("held", held)
        .stores("State", state)
        .fixes("form", params.exposure)
        .push(push_of(frame, params))
        .groups({1, 1, 1});
}

void keep_exposure(Graph& graph, FrameImages& frame) {
    frame.exposure = one_texel(graph, "exposure", Format::r32f);
    graph.clear(frame.exposure, {{1, 0, 0, 0}});
}

Image list_exposure(Graph& graph, const FrameImages& frame, const LensParams& params) {
    Image numbers = one_texel(graph, "exposure, row", Format::rgba32f);
    const Buffer measured = graph.find_buffer(tiles_name);
    if (!measured) {
        graph.clear(numbers, {{0, 1, 1, 0}});
        return numbers;
    }
    graph.compute("lens/exposure/table.comp")
        .stores("numbers", numbers)
        .loads("Tiles", measured)
        .samples("held", graph.find_image(held_name))
        .samples("exposure", frame.exposure)
        .push(push_of(frame, params))
        .groups({1, 1, 1});
    return numbers;
}

}  // namespace strata::lens
