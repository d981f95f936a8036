#include "passes/transparency/functions/draw.h"

#include <utility>

#include "capture_format/frame_features.h"
#include "passes/choice_names.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/lists/pixel_lists.h"
#include "passes/transparency/low_resolution/prepass.h"

namespace strata::transparency {
namespace {

constexpr auto accumulations =
    choice_names({{accumulation_half, "half"}, {accumulation_packed, "packed"}, {accumulation_single, "single"}});
constexpr auto tints = choice_names({{tint_total, "total"}, {tint_skew, "skew"}, {tint_corrected, "corrected"}});

struct SumFormats {
    Format color, scalar, pair, four;
};

SumFormats formats_of(std::uint32_t accumulation) {
    if (accumulation == accumulation_packed) return {Format::r11g11b10f, Format::r16f, Format::rg16f, Format::rgba16f};
    if (accumulation == accumulation_single) return {Format::rgba32f, Format::r32f, Format::rg32f, Format::rgba32f};
    return {Format::rgba16f, Format::r16f, Format::rg16f, Format::rgba16f};
}

bool emits(const FrameImages& images) {
    return images.features->has(Feature::additive) || images.features->has(Feature::emissive);
}

bool distorts(const FrameImages& images) { return images.features->has(Feature::distortion); }

std::uint32_t flag(bool set) { return set ? 1u : 0u; }

ResolutionSums cleared_sums(Graph& graph, const FrameImages& images, const SumOptions& options, const std::string& prefix) {
    const SumFormats formats = formats_of(options.accumulation);
    const Format weights = images.features->has(Feature::chromatic) ? formats.color : formats.scalar;
    const auto cleared = [&](const char* name, Format format) {
        Image sum = graph.create(prefix + name, Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(sum, {});
        return sum;
    };
    ResolutionSums sums{.color = cleared("color sum", formats.color),
                        .extinction = cleared("extinction", weights),
                        .normalizer = cleared("normalizer", options.tint != tint_total ? formats.four : weights)};
    const bool moves = options.offsets == Offsets::motion;
    // Targets are numbered: there is no offset without emission, though it be 0.
    if (emits(images) || distorts(images) || moves) sums.emission = cleared("emission sum", formats.color);
    if (moves) sums.offset = cleared("motion sum", Format::rg32f);
    else if (distorts(images)) sums.offset = cleared("offset sum", formats.pair);
    return sums;
}

void draw_at(Graph& graph, const std::string& shader, const FrameImages& images, Resolution resolution, FunctionSums& all,
             const std::function<void(DrawStep&, Resolution)>& chain) {
    ResolutionSums& sums = resolution == Resolution::low ? all.low : all.full;
    for (const DrawList& list : drawn_at(images, resolution)) {
        DrawStep draw = draw_fragments(graph, shader, list, images);
        draw.adds_to(sums.color).adds_to(sums.extinction).adds_to(sums.normalizer);
        if (sums.emission) draw.adds_to(sums.emission);
        if (sums.offset) draw.adds_to(sums.offset);
        draw.drops_other_colors()
            .fixes("drawn_divisor", resolution == Resolution::low ? 2u : 1u)
            .fixes("tint", all.options.tint)
            .fixes("moves", flag(all.options.offsets == Offsets::motion));
        chain(draw, resolution);
    }
}

ResolutionSums by_sample(Graph& graph, const ResolutionSums& sums) {
    return {by_sample(graph, sums.color), by_sample(graph, sums.extinction), by_sample(graph, sums.normalizer),
            by_sample(graph, sums.emission), by_sample(graph, sums.offset)};
}

}  // namespace

const Param accumulation_row = {
    .name = "accumulation",
    .low = 0,
    .high = 2,
    .fallback = accumulation_half,
    .help = "formats of the sums: RGBA16F, R11G11B10F or RGBA32F for color, 16 or 32 bits for the rest",
    .choices = accumulations};

const Param tint_row = {.name = "tint",
                        .low = 0,
                        .high = 2,
                        .fallback = tint_total,
                        .help =
                            "what colored layers tint with channels=mono; total: only the background; skew: also all layers; "
                            "corrected: all layers but themselves",
                        .choices = tints};

FunctionSums create_sums(Graph& graph, const FrameImages& images, const SumOptions& wanted) {
    SumOptions options = wanted;
    if (!images.features->has(Feature::chromatic)) options.tint = tint_total;
    FunctionSums sums{.full = cleared_sums(graph, images, options, ""), .options = options};
    if (!images.features->has(Feature::low_resolution)) return sums;
    sums.low_images = prepass_images(graph, images, 2);
    sums.low = cleared_sums(graph, sums.low_images, options, "low ");
    return sums;
}

void draw_into(Graph& graph, const std::string& shader, const FrameImages& images, FunctionSums& sums,
               const std::function<void(DrawStep&, Resolution)>& chain) {
    draw_at(graph, shader, images, Resolution::full, sums, chain);
    if (sums.low.color) draw_at(graph, shader, sums.low_images, Resolution::low, sums, chain);
}

FunctionSums by_sample(Graph& graph, const FunctionSums& sums) {
    FunctionSums read = sums;
    read.full = by_sample(graph, sums.full);
    return read;
}

ComputeStep over_sums(Graph& graph, const std::string& shader, const FrameImages& images, const FunctionSums& sums) {
    ComputeStep builder = graph.compute(shader);
    return builder.samples("extinction", sums.full.extinction)
        .samples("normalizer", sums.full.normalizer)
        .samples("low_extinction", sums.low.extinction)
        .samples("low_normalizer", sums.low.normalizer)
        .fixes("chromatic", flag(images.features->has(Feature::chromatic)))
        .fixes("low_resolution", flag(bool(sums.low.extinction)))
        .fixes("tint", sums.options.tint);
}

void resolve_sums(Graph& graph, FrameImages& images, const FunctionSums& sums) {
    const Image behind = undistorted(graph, images);
    const FunctionSums read = by_sample(graph, sums);
    over_sums(graph, "transparency/functions/resolve.comp", images, read)
        .samples("color_sum", read.full.color)
        .samples("emission", read.full.emission)
        .samples("offset", read.full.offset)
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
            counter<&FunctionCounters::scrubbed>(
                {.name = "scrubbed", .help = "samples whose sums were NaN or infinite; expected: 0"}),
            counter<&FunctionCounters::clamped>(
                {.name = "clamped",
                 .help = "fragments brighter than 10,000 times white, whose light is cut off there; expected: 0"})};
}

std::vector<Counter> function_counters_with_lists() {
    std::vector<Counter> rows = list_counters(), own = function_counters();
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
}

Image normalization_view(Graph& graph, const FrameImages& images, const FunctionSums& sums) {
    Image picture = graph.create("normalization view", Shape{.extent = images.extent, .format = Format::rgba32f});
    const FunctionSums read = by_sample(graph, sums);
    over_sums(graph, "transparency/functions/factor.comp", images, read).stores("picture", picture).over(images.extent);
    return picture;
}

DebugView normalization_row(Image (*declare)(Graph&, FrameImages&, const Settings&)) {
    return {
        .name = "normalization",
        .help =
            "factor that the resolve applies to the color: 1 where T(z) is exact, below 1 where T(z) lets too much light through",
        .unit = "x",
        .low = 0,
        .high = 2,
        .declare = declare};
}

}  // namespace strata::transparency
