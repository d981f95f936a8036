#include "passes/lens/depth_of_field/focus.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "capture_format/frame_features.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {
namespace {

constexpr std::uint32_t taps_of_choice[] = {16, 64, 128, 256};  // focus_taps_* of lens.shared.h
constexpr const char* spread_name = "blur that reaches tiles";

BlurPush push_of(const FrameImages& frame, const LensParams& params) {
    const View& view = frame.recorded->view;
    // The lens cannot focus on what is nearer than the picture begins. What is in focus beyond 1e30 m is infinitely far, and
    // focus * depth in the shader stays a float.
    const float focus = std::clamp(frame.recorded->lens.focus_distance, view.near, std::max(view.near, 1e30f));
    if (params.focus == focus_xray) return {.scale = 0, .focus = std::min(focus, 0.5f * xray_far), .most = 0};
    const float pixels = std::abs(view.projection[1][1]) * float(view.height) / 2;  // of a length of 1 at a depth of 1
    return {.scale = frame.recorded->lens.aperture / 2 / focus * pixels,
            .focus = focus,
            .most = params.focus_reach * float(view.height)};
}

ComputeStep read_samples(ComputeStep builder, const FrameImages& frame) {
    return builder.samples("color", frame.color)
        .samples("depth_layers", frame.depth_layers)
        .fixes("has_depth", frame.depth_layers ? 1u : 0u);
}

Image tiles_of(Graph& graph, const char* name, const FrameImages& frame) {
    const auto tiles = [](std::uint32_t pixels) { return (pixels + blur_tile - 1) / blur_tile; };
    return graph.create(name, {.extent = {tiles(frame.extent.width), tiles(frame.extent.height)}, .format = Format::r32f});
}

Image reach_of(Graph& graph, const FrameImages& frame, const BlurPush& push) {
    Image reach = tiles_of(graph, "blur of tiles", frame), spread = tiles_of(graph, spread_name, frame);
    const Extent tiles = graph.shape(reach).extent;
    read_samples(graph.compute("lens/depth_of_field/reach.comp"), frame).stores("reach", reach).push(push).groups(tiles);
    graph.compute("lens/depth_of_field/spread.comp").samples("reach", reach).stores("spread", spread).push(push).over(tiles);
    return spread;
}

Image shown(Graph& graph, const FrameImages& frame, const char* name) {
    return graph.create(name, {.extent = frame.extent, .format = Format::rgba32f});
}

}  // namespace

bool blurs(const FrameImages& frame, const LensParams& params) {
    return frame.features->has(Feature::depth_of_field) && params.focus != focus_off;
}

void blur_by_depth(Graph& graph, FrameImages& frame, const LensParams& params) {
    const BlurPush push = push_of(frame, params);
    const Extent threads{frame.extent.width, frame.extent.height, frame.samples};
    Image blurred = graph.create("color", graph.shape(frame.color));
    if (params.focus == focus_gather) {
        const Image spread = reach_of(graph, frame, push);
        read_samples(graph.compute("lens/depth_of_field/gather.comp"), frame)
            .samples("spread", spread)
            .stores("blurred", blurred)
            .fixes("taps", taps_of_choice[params.focus_taps])
            .push(push)
            .over(threads);
    } else {
        read_samples(graph.compute("lens/depth_of_field/xray.comp"), frame).stores("blurred", blurred).push(push).over(threads);
    }
    frame.color = blurred;
}

Image show_blur(Graph& graph, const FrameImages& frame, const LensParams& params) {
    Image picture = shown(graph, frame, "shown circle of confusion");
    if (!blurs(frame, params)) graph.clear(picture, {});
    else
        read_samples(graph.compute("lens/depth_of_field/show_blur.comp"), frame)
            .stores("shown", picture)
            .fixes("form", params.focus)
            .push(push_of(frame, params))
            .over(frame.extent);
    return picture;
}

Image show_taps(Graph& graph, const FrameImages& frame, const LensParams& params) {
    Image picture = shown(graph, frame, "shown taps");
    if (!blurs(frame, params)) {
        graph.clear(picture, {});
        return picture;
    }
    const bool gathers = params.focus == focus_gather;
    ComputeStep count = read_samples(
        graph.compute(gathers ? "lens/depth_of_field/show_taps.comp" : "lens/depth_of_field/show_xray_taps.comp"), frame);
    count.stores("shown", picture).push(push_of(frame, params)).over(frame.extent);
    if (gathers) count.samples("spread", graph.find_image(spread_name)).fixes("taps", taps_of_choice[params.focus_taps]);
    return picture;
}

}  // namespace strata::lens
