// Stochastic transparency: every fragment covers a random subset of subsamples, and an ordinary depth test does the rest.
#include <algorithm>

#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/distortion/bent_background.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/stochastic/stochastic.shared.h"

namespace strata::transparency {

ImageSet stochastic_model(const StageInput&, const Settings&);  // model.cpp

namespace {

// Subsamples are 4 << choice.
constexpr std::string_view sample_counts[] = {"4", "8", "16", "32", "64"};
constexpr auto subsets = choice_names({{subset_bernoulli, "bernoulli"}, {subset_stratified, "stratified"}});
constexpr auto corrections = choice_names({{correction_none, "none"}, {correction_alpha, "alpha"}});
constexpr auto modes = choice_names({{mode_layered, "layered"}, {mode_depth_based, "depth_based"}, {mode_hashed, "hashed"}});

/// Sums of the whole frame, and the depths of a band's subsamples.
struct Targets {
    Image sum, emitted, reveal;
    Buffer depths;
};

/// The rows as few bands whose subsample depths fit `memory`; always two rows at least, so that no 2x2 quad straddles two bands.
std::vector<StochasticBand> bands(const FrameImages& images, const StochasticParams& params) {
    const std::uint32_t subsamples = params.mode == mode_hashed ? 1 : 4u << params.samples;
    const std::uint64_t row_bytes = std::uint64_t{images.extent.width} * images.samples * subsamples * sizeof(std::uint32_t);
    const auto fitting = static_cast<std::uint64_t>(double(params.memory) * 1024 * 1024) / row_bytes / 2 * 2;
    const auto rows = static_cast<std::uint32_t>(std::clamp<std::uint64_t>(fitting, 2, std::max(2u, images.extent.height)));
    std::vector<StochasticBand> listed;
    for (std::uint32_t first = 0; first < images.extent.height; first += rows)
        listed.push_back({.params = params,
                          .first_row = first,
                          .rows = std::min(rows, images.extent.height - first),
                          .width = images.extent.width,
                          .samples = images.samples,
                          .subsamples = subsamples});
    return listed;
}

Targets create_targets(Graph& graph, const FrameImages& images, const StochasticBand& largest) {
    const auto create = [&](std::string name, Format format, double value) {
        Image image = graph.create(std::move(name), Shape{.extent = images.extent, .format = format, .samples = images.samples});
        graph.clear(image, {{value, value, value, value}});
        return image;
    };
    const bool chromatic = images.features->has(Feature::chromatic);
    const std::uint64_t words = std::uint64_t{largest.rows} * largest.width * largest.samples * largest.subsamples;
    return {.sum = create("stochastic sum", Format::rgba16f, 0),
            .emitted = create("stochastic emitted", Format::rgba16f, 0),
            .reveal = create("stochastic reveal", chromatic ? Format::rgba16f : Format::r16f, 1),
            .depths = graph.create("stochastic depths", words * sizeof(std::uint32_t))};
}

void draw(Graph& graph, const FrameImages& images, Targets& targets, const StochasticBand& band) {
    graph.clear(targets.depths, uncovered_depth);
    const Rows rows{band.first_row, band.rows};
    draw_fragments(graph, "transparency/stochastic/cover", images.numbered, images)
        .in_rows(rows)
        .multiplies(targets.reveal)
        .updates("Depths", targets.depths)
        .push(band);
    draw_fragments(graph, "transparency/stochastic/shade", images.numbered, images)
        .in_rows(rows)
        .adds_to(targets.sum)
        .adds_to(targets.emitted)
        .loads("Depths", targets.depths)
        .push(band);
}

void resolve(Graph& graph, FrameImages& images, const Targets& targets, const StochasticBand& band) {
    const Image sum = by_sample(graph, targets.sum);
    const Image emitted = by_sample(graph, targets.emitted);
    const Image reveal = by_sample(graph, targets.reveal);
    graph.compute("transparency/stochastic/resolve.comp")
        .updates("color", images.color)
        .loads("Depths", targets.depths)
        .samples("sum", sum)
        .samples("emitted", emitted)
        .samples("reveal", reveal)
        .fixes("chromatic", images.features->has(Feature::chromatic) ? 1u : 0u)
        .push(band)
        .over({band.width, band.rows, band.samples});
}

void declare(Graph& graph, FrameImages& images, const Settings& settings) {
    distort_background(graph, images);
    const std::vector<StochasticBand> listed = bands(images, settings.as<StochasticParams>());
    Targets targets = create_targets(graph, images, listed.front());
    for (const StochasticBand& band : listed) {
        draw(graph, images, targets, band);
        resolve(graph, images, targets, band);
    }
}

std::vector<Param> params() {
    return {
        param<&StochasticParams::samples>(
            {.name = "samples",
             .low = 0,
             .high = 4,
             .fallback = 1,
             .help = "subsamples per sample; noise falls with the square root of their number, memory and time grow with it",
             .choices = sample_counts}),
        param<&StochasticParams::subset>(
            {.name = "subset",
             .low = 0,
             .high = 1,
             .fallback = subset_stratified,
             .help =
                 "bernoulli: each subsample is covered by chance; stratified: the number covered is fixed by alpha, less noise",
             .choices = subsets}),
        param<&StochasticParams::correction>({.name = "correction",
                                              .low = 0,
                                              .high = 1,
                                              .fallback = correction_alpha,
                                              .help = "alpha: weights the background by the exact product of transmittances, "
                                                      "without noise; has no effect with mode=hashed",
                                              .choices = corrections}),
        param<&StochasticParams::mode>({.name = "mode",
                                        .low = 0,
                                        .high = 2,
                                        .fallback = mode_layered,
                                        .help = "layered: nearest fragment of each subsample; depth_based: T(z) from subsample "
                                                "depths; hashed: alpha test with one subsample",
                                        .choices = modes}),
        param<&StochasticParams::seed>({.name = "seed", .low = 0, .high = 65535, .fallback = 0, .help = "seed of the noise"}),
        param<&StochasticParams::memory>(
            {.name = "memory",
             .low = 0.01,
             .high = 4095,
             .fallback = 128,
             .help = "memory for subsample depths in MiB; a frame that needs more is rendered in bands of rows",
             .scale = Scale::logarithmic}),
    };
}

}  // namespace

Technique stochastic() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/stochastic",
        .title = "Stochastic",
        .source =
            "Enderton, Sintorn, Shirley and Luebke 2010, I3D; hashed: Wyman and McGuire 2017, I3D; hash: Jarzynski and Olano "
            "2020, JCGT 9(3)",
        .summary =
            "Fragments cover random subsamples, which an ordinary depth test resolves: right on average, noisy in every frame.",
        .params = params(),
        .variants = {"mode=depth_based", "samples=64", "samples=64 mode=depth_based", "mode=hashed"},
        .counters = {counter<&StochasticCounters::fragments>(
                         {.name = "fragments", .help = "visible transparent fragments shaded"}),
                     counter<&StochasticCounters::atomics>(
                         {.name = "atomics", .help = "subsamples covered by fragments: one atomic minimum each"})},
        .counter_bytes = sizeof(StochasticCounters),
        .claims = {.failures = {{"H2", 0.0999, "eight subsamples hold T in eighths"},
                                {"H4", 0.125, "eight subsamples: in the worst pixel an eighth is off"},
                                {"H5", 0.1685, "most layers of .01 cover no subsample, so their order is chance"},
                                {"H9", 0.1875, "eight subsamples hold T in eighths"},
                                {"H10b", 0.104, "equal depths share their subsamples by chance"},
                                {"H12b", 0.8,
                                 "colored glass covers by the mean of its channels: five panes cover every subsample"},
                                {"H13", 0.231, "eight subsamples hold T in eighths"},
                                {"H14a", 0.1, "in some pixels a layer of .1 covers no subsample"},
                                {"H14b", 0.1, "in some pixels a layer of .1 covers no subsample"}}},
        .declare = declare,
        .model = stochastic_model,
        .model_is = ModelKind::mirror,
        .tolerance =
            {.rmse = 3e-4,
             .worst = 2e-3,
             .because =
                 "which subsamples are covered is the same to the bit; sums and products are rounded to half floats at every "
                 "blend, in the model, too, but a last float bit of a term can turn the rounding of each: 1.3e-4 and 9.3e-4 "
                 "measured on lavapipe"},
    };
}

}  // namespace strata::transparency
