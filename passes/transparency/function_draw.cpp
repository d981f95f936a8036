#include "passes/transparency/function_draw.h"

#include <utility>

#include "passes/transparency/event_draw.h"
#include "passes/transparency/lists.h"

namespace strata::transparency {
namespace {

constexpr std::string_view accumulations[] = {"half", "packed", "single"};

struct SumFormats {
    Format color, scalar;
};

SumFormats formats_of(std::uint32_t accumulation) {
    if (accumulation == accumulation_packed) return {Format::r11g11b10f, Format::r16f};
    if (accumulation == accumulation_single) return {Format::rgba32f, Format::r32f};
    return {Format::rgba16f, Format::r16f};
}

bool emits(const FrameImages& images) {
    return images.features->has(Feature::additive) || images.features->has(Feature::emissive);
}

std::uint32_t flag(bool set) { return set ? 1u : 0u; }

/// The sums by sample, under the names function_sums.glsl reads them by.
ComputePass reading_sums(Graph& graph, std::string shader, const FrameImages& images, const FunctionSums& sums) {
    const Image color = spread(graph, sums.color, "color sum by sample");
    const Image extinction = spread(graph, sums.extinction, "extinction by sample");
    const Image normalizer = spread(graph, sums.normalizer, "normalizer by sample");
    const Image emission = sums.emission ? spread(graph, sums.emission, "emission by sample") : Image{};
    ComputePass pass = graph.compute(std::move(shader));
    pass.samples("color_sum", color)
        .samples("extinction", extinction)
        .samples("normalizer", normalizer)
        .samples("emission", emission)
        .fixes("chromatic", flag(images.features->has(Feature::chromatic)))
        .fixes("emits", flag(emits(images)));
    return pass;
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
    const Format weights = images.features->has(Feature::chromatic) ? formats.color : formats.scalar;
    const auto cleared = [&](const char* name, Format format) {
        Image sum = graph.create(name, Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(sum, {});
        return sum;
    };
    return {.color = cleared("color sum", formats.color),
            .extinction = cleared("extinction", weights),
            .normalizer = cleared("normalizer", weights),
            .emission = emits(images) ? cleared("emission sum", formats.color) : Image{}};
}

DrawPass draw_into(Graph& graph, std::string shader, const FrameImages& images, FunctionSums& sums) {
    DrawPass draw = draw_events(graph, std::move(shader), images.transparent, images);
    draw.adds_to(sums.color).adds_to(sums.extinction).adds_to(sums.normalizer);
    if (sums.emission) draw.adds_to(sums.emission);
    draw.drops_other_colors();
    return draw;
}

void resolve_sums(Graph& graph, FrameImages& images, const FunctionSums& sums) {
    reading_sums(graph, "transparency/function_resolve.comp", images, sums)
        .updates("color", images.color)
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
    reading_sums(graph, "transparency/function_factor.comp", images, sums).stores("picture", picture).over(images.extent);
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
