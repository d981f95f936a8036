#include "passes/lens/bloom/glow.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/frame_features.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/lens/lens.shared.h"

namespace strata::lens {
namespace {

ComputeStep read_color(ComputeStep builder, const FrameImages& frame) {
    return builder.samples("color", frame.color)
        .samples("exposure", frame.exposure)
        .fixes("has_exposure", frame.exposure ? 1u : 0u);
}

Extent half_of(const Extent& extent) { return {(extent.width + 1) / 2, (extent.height + 1) / 2}; }

constexpr const char *first_level = "glow 1", *first_mean = "mean glow 1", *xray_blurred = "blurred glow";

Image level_of(Graph& graph, const std::string& name, const Extent& extent) {
    return graph.create(name, {.extent = extent, .format = Format::rgba16f});
}

std::vector<Image> make_levels(Graph& graph, const FrameImages& frame, std::uint32_t count) {
    Extent extent = half_of(frame.extent);
    std::vector<Image> levels{level_of(graph, first_level, extent)};
    read_color(graph.compute("lens/bloom/bright.comp"), frame)
        .stores("level", levels.front())
        .push(BrightPush{frame.recorded->lens.bloom_threshold})
        .over(extent);
    while (levels.size() < count) {
        extent = half_of(extent);
        const Image finer = levels.back();
        levels.push_back(level_of(graph, "glow " + std::to_string(levels.size() + 1), extent));
        graph.compute("lens/bloom/down.comp").samples("finer", finer).stores("level", levels.back()).over(extent);
    }
    return levels;
}

/// The mean of all levels, at the extent of the first.
Image mean_of(Graph& graph, const std::vector<Image>& levels) {
    Image mean = levels.back();
    for (std::size_t i = levels.size() - 1; i-- > 0;) {
        const Extent extent = graph.shape(levels[i]).extent;
        Image finer = level_of(graph, i == 0 ? first_mean : "mean glow " + std::to_string(i + 1), extent);
        graph.compute("lens/bloom/up.comp")
            .samples("coarser", mean)
            .samples("level", levels[i])
            .stores("mean_level", finer)
            .fixes("coarser_levels", static_cast<std::uint32_t>(levels.size() - 1 - i))
            .over(extent);
        mean = finer;
    }
    return mean;
}

/// w_k = .7 g(k, 3) + .7 g(k, 1), each g a Gaussian that sums to 1 over 15 taps.
XrayBlurPush xray_weights() {
    XrayBlurPush push{};
    for (const double deviation : {3., 1.}) {
        double sum = 0, gaussian[8] = {};
        for (int k = 0; k < 8; ++k) {
            gaussian[k] = std::exp(-k * k / (2 * deviation * deviation));
            sum += k == 0 ? 1 : 2 * gaussian[k];
        }
        for (int k = 0; k < 8; ++k) push.weights[k] += float(.7 * gaussian[k] / sum);
    }
    return push;
}

Image xray_glow(Graph& graph, const FrameImages& frame) {
    constexpr Extent extent{xray_extent, xray_extent};
    Image glow = level_of(graph, "glow", extent);
    read_color(graph.compute("lens/bloom/xray_bright.comp"), frame).stores("glow", glow).over(extent);
    for (const std::uint32_t along_y : {0u, 1u}) {
        Image blurred = level_of(graph, along_y != 0 ? xray_blurred : "glow blurred along x", extent);
        graph.compute("lens/bloom/xray_blur.comp")
            .samples("glow", glow)
            .stores("blurred", blurred)
            .fixes("along_y", along_y)
            .push(xray_weights())
            .over(extent);
        glow = blurred;
    }
    return glow;
}

/// For shaders that include passes/lens/bloom/added.glsl.
ComputeStep read_glow(ComputeStep builder, const FrameImages& frame, const LensParams& params, const Image& glow) {
    return builder.samples("glow", glow)
        .samples("exposure", frame.exposure)
        .fixes("form", params.bloom)
        .fixes("has_exposure", frame.exposure ? 1u : 0u)
        .push(GlowPush{frame.recorded->lens.bloom});
}

}  // namespace

std::uint32_t glow_levels(double reach, std::uint32_t height) {
    // Level l has a variance of (4^l - 1) / 2 squared pixels.
    const double pixels = reach * height, levels = .5 * std::log2(2 * pixels * pixels + 1);
    return static_cast<std::uint32_t>(std::clamp(std::round(levels), 1., 12.));
}

bool glows(const FrameImages& frame, const LensParams& params) {
    return frame.features->has(Feature::bloom) && params.bloom != bloom_off;
}

void add_bloom(Graph& graph, FrameImages& frame, const LensParams& params) {
    const bool is_pyramid = params.bloom == bloom_pyramid;
    const std::uint32_t levels = glow_levels(double(params.bloom_reach), frame.extent.height);
    const Image glow = is_pyramid ? mean_of(graph, make_levels(graph, frame, levels)) : xray_glow(graph, frame);
    read_glow(graph.compute("lens/bloom/add.comp"), frame, params, glow).updates("color", frame.color).over(frame.extent);
}

Image show_glow(Graph& graph, const FrameImages& frame, const LensParams& params) {
    Image picture = graph.create("shown glow", {.extent = frame.extent, .format = Format::rgba32f});
    if (!glows(frame, params)) {
        graph.clear(picture, {});
        return picture;
    }
    const bool has_mean = glow_levels(double(params.bloom_reach), frame.extent.height) > 1;
    const char* name = params.bloom == bloom_xray ? xray_blurred : has_mean ? first_mean : first_level;
    read_glow(graph.compute("lens/bloom/show.comp"), frame, params, graph.find_image(name))
        .stores("shown", picture)
        .over(frame.extent);
    return picture;
}

}  // namespace strata::lens
