#include "passes/transparency/function_draw.h"

#include <utility>

#include "passes/transparency/distortion.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/function_prepass.h"
#include "passes/transparency/lists.h"

namespace strata::transparency {
namespace {

constexpr std::string_view accumulations[] = {"half", "packed", "single"};

struct SumFormats {
    Format color, scalar, pair;
};

SumFormats formats_of(std::uint32_t accumulation) {
    if (accumulation == accumulation_packed) return {Format::r11g11b10f, Format::r16f, Format::rg16f};
    if (accumulation == accumulation_single) return {Format::rgba32f, Format::r32f, Format::rg32f};
    return {Format::rgba16f, Format::r16f, Format::rg16f};
}

bool emits(const FrameImages& images) {
    return images.features->has(Feature::additive) || images.features->has(Feature::emissive);
}

bool distorts(const FrameImages& images) { return images.features->has(Feature::distortion); }

std::uint32_t flag(bool set) { return set ? 1u : 0u; }

ResolutionSums cleared_sums(Graph& graph, const FrameImages& images, const SumFormats& formats, const std::string& prefix) {
    const Format weights = images.features->has(Feature::chromatic) ? formats.color : formats.scalar;
    const auto cleared = [&](const char* name, Format format) {
        Image sum = graph.create(prefix + name, Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(sum, {});
        return sum;
    };
    ResolutionSums sums{.color = cleared("color sum", formats.color),
                        .extinction = cleared("extinction", weights),
                        .normalizer = cleared("normalizer", weights)};
    // Targets are numbered: there is no offset without emission, though it be 0.
    if (emits(images) || distorts(images)) sums.emission = cleared("emission sum", formats.color);
    if (distorts(images)) sums.offset = cleared("offset sum", formats.pair);
    return sums;
}

void draw_at(Graph& graph, const std::string& shader, const FrameImages& images, Resolution resolution, ResolutionSums& sums,
             const std::function<void(DrawPass&, Resolution)>& chain) {
    for (const DrawList& list : drawn_at(images, resolution)) {
        DrawPass draw = draw_events(graph, shader, list, images);
        draw.adds_to(sums.color).adds_to(sums.extinction).adds_to(sums.normalizer);
        if (sums.emission) draw.adds_to(sums.emission);
        if (sums.offset) draw.adds_to(sums.offset);
        draw.drops_other_colors().fixes("drawn_width", images.extent.width).fixes("drawn_height", images.extent.height);
        chain(draw, resolution);
    }
}

ResolutionSums by_sample(Graph& graph, const ResolutionSums& sums) {
    return {by_sample(graph, sums.color), by_sample(graph, sums.extinction), by_sample(graph, sums.normalizer),
            by_sample(graph, sums.emission), by_sample(graph, sums.offset)};
}

/// X and N under the names function_sums.glsl reads them by.
ComputePass& reading_weights(ComputePass& pass, const FrameImages& images, const ResolutionSums& full,
                             const ResolutionSums& low) {
    return pass.samples("extinction", full.extinction)
        .samples("normalizer", full.normalizer)
        .samples("low_extinction", low.extinction)
        .samples("low_normalizer", low.normalizer)
        .fixes("chromatic", flag(images.features->has(Feature::chromatic)))
        .fixes("low_resolution", flag(bool(low.extinction)));
}

}  // namespace

const Param accumulation_row = {
    .name = "accumulation",
    .low = 0,
    .high = 2,
    .fallback = accumulation_half,
    .help = "formats of the sums: RGBA16F, R11G11B10F or RGBA32F for color, 16 or 32 bits for the rest",
    .choices = accumulations};

FunctionSums create_sums(Graph& graph, const FrameImages& images, std::uint32_t accumulation) {
    const SumFormats formats = formats_of(accumulation);
    FunctionSums sums{.full = cleared_sums(graph, images, formats, "")};
    if (!images.features->has(Feature::low_resolution)) return sums;
    sums.low_images = prepass_images(graph, images, 2);
    sums.low = cleared_sums(graph, sums.low_images, formats, "low ");
    return sums;
}

void draw_into(Graph& graph, const std::string& shader, const FrameImages& images, FunctionSums& sums,
               const std::function<void(DrawPass&, Resolution)>& chain) {
    draw_at(graph, shader, images, Resolution::full, sums.full, chain);
    if (sums.low.color) draw_at(graph, shader, sums.low_images, Resolution::low, sums.low, chain);
}

void resolve_sums(Graph& graph, FrameImages& images, const FunctionSums& sums) {
    const Image behind = undistorted(graph, images);
    const ResolutionSums full = by_sample(graph, sums.full);
    ComputePass pass = graph.compute("transparency/function_resolve.comp");
    reading_weights(pass, images, full, sums.low)
        .samples("color_sum", full.color)
        .samples("emission", full.emission)
        .samples("offset", full.offset)
        .samples("low_color_sum", sums.low.color)
        .samples("low_emission", sums.low.emission)
        .samples("low_offset", sums.low.offset)
        .samples("behind", behind)
        .updates("color", images.color)
        .fixes("emits", flag(emits(images)))
        .fixes("distorts", flag(bool(behind)))
        .over({images.extent.width, images.extent.height, images.samples});
}

std::vector<Counter> function_counters() {
    return {counter<&FunctionCounters::drawn>({.name = "drawn", .help = "visible transparent fragments weighted and added"}),
            counter<&FunctionCounters::scrubbed>({.name = "scrubbed", .help = "samples whose sums were no number: always 0"})};
}

std::vector<Counter> function_counters_with_lists() {
    std::vector<Counter> rows = list_counters(), own = function_counters();
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
}

Image normalization_view(Graph& graph, const FrameImages& images, const FunctionSums& sums) {
    Image picture = graph.create("normalization view", Shape{.extent = images.extent, .format = Format::rgba32f});
    const ResolutionSums full = by_sample(graph, sums.full);
    ComputePass pass = graph.compute("transparency/function_factor.comp");
    reading_weights(pass, images, full, sums.low).stores("picture", picture).over(images.extent);
    return picture;
}

DebugView normalization_row(Image (*add)(Graph&, FrameImages&, const Settings&)) {
    return {.name = "normalization",
            .help = "what the resolve multiplies the color by: 1 where T(z) is exact, below 1 where it lets too much through",
            .unit = "",
            .low = 0,
            .high = 2,
            .add = add};
}

}  // namespace strata::transparency
