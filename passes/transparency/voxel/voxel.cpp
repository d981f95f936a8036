// Voxel transparency: optical depth added up in slices of a low-resolution volume along the view, by integer atomics.
#include <array>
#include <cmath>

#include "passes/choice_names.h"
#include "passes/technique.h"
#include "passes/transparency/event_draw.h"
#include "passes/transparency/functions/draw.h"
#include "passes/transparency/functions/motion.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/ratios.h"
#include "passes/transparency/voxel/views/views.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "passes/transparency/voxel/volume/volume.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/zero_depth/zero_depth.h"

namespace strata::transparency {

ImageSet voxel_model(const StageInput&, const Settings&);  // model.cpp

namespace {

constexpr auto splats = choice_names({{splat_words, "words"},
                                      {splat_wrapping, "wrapping"},
                                      {splat_saturating, "saturating"},
                                      {splat_overflow_minimum, "overflow_minimum"},
                                      {splat_multiply, "multiply"}});
constexpr auto bits_choices = choice_names({{bits_8, "8"}, {bits_10, "10"}, {bits_16, "16"}, {bits_32, "32"}});
constexpr auto packings = choice_names({{packing_planes, "planes"}, {packing_rgb10, "rgb10"}});
constexpr auto splattings = choice_names({{splatting_point, "point"}, {splatting_linear, "linear"}});
constexpr auto samplings = choice_names({{sampling_point, "point"}, {sampling_linear, "linear"}, {sampling_bicubic, "bicubic"}});
constexpr auto roundings = choice_names({{rounding_nearest, "nearest"}, {rounding_stochastic, "stochastic"}});
constexpr auto thicknesses = choice_names({{thickness_point, "point"}, {thickness_segment, "segment"}});
constexpr auto curves = choice_names({{curve_slices, "slices"}, {curve_thickness, "thickness"}, {curve_linear, "linear"}});
constexpr auto volumes = choice_names({{volume_dense, "dense"}, {volume_adaptive, "adaptive"}, {volume_sparse, "sparse"}});
constexpr std::string_view skippings[] = {"off", "on"};
constexpr auto ranges = choice_names({{range_frame, "frame"}, {range_fixed, "fixed"}});
constexpr std::string_view resolutions[] = {"full", "half", "quarter", "eighth", "sixteenth"};
constexpr auto preparations = choice_names({{prepared_after_opaque, "after_opaque"}, {prepared_before_opaque, "before_opaque"}});
constexpr auto cullings = choice_names(
    {{culling_off, "off"}, {culling_quads_16, "quads_16"}, {culling_quads_32, "quads_32"}, {culling_full_screen, "full_screen"}});

FunctionSums sums(Graph& graph, FrameImages& images, const Settings& settings, Offsets offsets) {
    const auto params = voxel_params(settings, *images.facts);
    const bool earlier = is_made_before_opaque(params, *images.features);
    Volume volume = earlier ? earlier_volume(graph, images, params) : integrated_volume(graph, images, params);
    FrameImages drawn_before = images;
    drawn_before.transparent = drawn_triangles(images, params);
    drawn_before.depth = earlier ? earlier_culled_depth(graph) : culled_depth(graph, images, volume, params);
    FunctionSums drawn = create_sums(graph, images, {params.accumulation, voxel_tint(params, *images.features), offsets});
    drawn.low_images.transparent = drawn_before.transparent;
    draw_into(graph, "transparency/voxel/accumulate", drawn_before, drawn,
              [&](DrawPass& draw, Resolution resolution) { read_volume(draw, volume, params, resolution); });
    return drawn;
}

/// Before the opaque draws: from which depth on nothing is seen of them, either.
void prepare(Graph& graph, FrameImages& images, const Settings& settings) {
    const auto params = voxel_params(settings, *images.facts);
    if (!is_made_before_opaque(params, *images.features)) return;
    images.depth = depth_to_draw_opaque_into(graph, images, integrated_volume(graph, images, params), params);
}

std::optional<std::string> beyond_device(const FrameImages& images, const Settings& settings) {
    const Capabilities& device = images.capabilities;
    if (voxel_params(settings, *images.facts).splat != splat_multiply || has(device, Capability::shader_output_layer) ||
        has(device, Capability::geometry_shaders))
        return std::nullopt;
    return "transparency/voxel needs shader_output_layer or geometry_shaders for splat=multiply; this device has neither";
}

std::vector<Param> code_params() {
    return {
        param<&VoxelParams::slices>({.name = "slices",
                                     .group = "the volume",
                                     .low = 32,
                                     .high = most_slices,
                                     .fallback = 128,
                                     .help = "of the volume in depth; within one nothing hides anything",
                                     .scale = Scale::logarithmic}),
        param<&VoxelParams::volume>({.name = "volume",
                                     .low = 0,
                                     .high = 2,
                                     .fallback = volume_adaptive,
                                     .help = "dense: slices cut all of the range of depth; adaptive: only where something is, as "
                                             "finely as their number allows; sparse: tile by tile, as finely as the pool allows",
                                     .choices = volumes}),
        param<&VoxelParams::thinnest>(
            {.name = "thinnest",
             .low = 1e-5,
             .high = 10,
             .fallback = 0.001,
             .help = "metres of the nearest slice, with volume=adaptive and sparse; of 8192 at most over the range",
             .scale = Scale::logarithmic}),
        param<&VoxelParams::pool>({.name = "pool",
                                   .low = 1,
                                   .high = 256,
                                   .fallback = 16,
                                   .help = "MiB of blocks, with volume=sparse: 8 x 8 columns by a word, for what each tile "
                                           "holds; slices are as thin as fit",
                                   .scale = Scale::logarithmic}),
        param<&VoxelParams::skipping>(
            {.name = "skipping",
             .low = 0,
             .high = 1,
             .fallback = 1,
             .help = "of slices that a tile of 8 x 8 columns does not use, when clearing and integrating",
             .choices = skippings}),
        param<&VoxelParams::splat>(
            {.name = "splat",
             .group = "its words",
             .low = 0,
             .high = 4,
             .fallback = splat_overflow_minimum,
             .help = "a word per slice, or as many in a word as fit: wrapping, saturating by compare-and-swap, or wrapping "
                     "with a note of the nearest overflow; multiply: no atomics, triangles blended into one slice each",
             .choices = splats}),
        param<&VoxelParams::bits>({.name = "bits",
                                   .low = 0,
                                   .high = 3,
                                   .fallback = bits_8,
                                   .help = "of a slice: steps of optical depth of .0217, .0068, .00017 or .000013",
                                   .choices = bits_choices}),
        param<&VoxelParams::packing>(
            {.name = "packing",
             .low = 0,
             .high = 1,
             .fallback = packing_planes,
             .help = "of three channels: planes, a volume for each; rgb10, 8 bits of each in a word per slice, added to at once, "
                     "and a volume for what is grey",
             .choices = packings}),
        param<&VoxelParams::rounding>({.name = "rounding",
                                       .low = 0,
                                       .high = 1,
                                       .fallback = rounding_nearest,
                                       .help = "of optical depth to steps; stochastic: right on average, with noise",
                                       .choices = roundings}),
    };
}

std::vector<Param> params() {
    Param resolution = resolution_row;
    resolution.high = 4;
    resolution.choices = resolutions;
    Param channels = channels_row;
    channels.group = "functions and sums";
    std::vector<Param> rows = code_params();
    const std::vector<Param> places = {
        param<&VoxelParams::splatting>({.name = "splatting",
                                        .group = "fragments in slices",
                                        .low = 0,
                                        .high = 1,
                                        .fallback = splatting_linear,
                                        .help = "into the slice a fragment is in, or shared with the nearer neighbour",
                                        .choices = splattings}),
        param<&VoxelParams::thickness>(
            {.name = "thickness",
             .low = 0,
             .high = 1,
             .fallback = thickness_point,
             .help = "of soft particles: none; or as deep as they fade before opaque surfaces, in every slice they cross",
             .choices = thicknesses}),
        param<&VoxelParams::sampling>({.name = "sampling",
                                       .low = 0,
                                       .high = 2,
                                       .fallback = sampling_linear,
                                       .help = "of the integral in depth: 1, 2 or 2.5 slices in front of a fragment",
                                       .choices = samplings}),
        param<&VoxelParams::shift>({.name = "shift",
                                    .low = -2,
                                    .high = 2,
                                    .fallback = 0,
                                    .help = "slices by which that is farther: above 0 fragments hide themselves"}),
        param<&VoxelParams::curve>(
            {.name = "curve",
             .group = "where slices lie",
             .low = 0,
             .high = 2,
             .fallback = curve_slices,
             .help = "depth is divided evenly for as many inches as there are slices, or so that the nearest of them is "
                     "near_thickness thick, or for `linear` metres; logarithmically beyond",
             .choices = curves}),
        param<&VoxelParams::near_thickness>({.name = "near_thickness",
                                             .low = 0.001,
                                             .high = 1,
                                             .fallback = 0.0508,
                                             .help = "metres, with curve=thickness",
                                             .scale = Scale::logarithmic}),
        param<&VoxelParams::linear>({.name = "linear",
                                     .low = 0.001,
                                     .high = 1e5,
                                     .fallback = 3.25,
                                     .help = "metres, with curve=linear",
                                     .scale = Scale::logarithmic}),
        param<&VoxelParams::range>({.name = "range",
                                    .low = 0,
                                    .high = 1,
                                    .fallback = range_frame,
                                    .help = "of depth: that of the frame's transparent geometry, or from the eye to `farthest`",
                                    .choices = ranges}),
        param<&VoxelParams::farthest>({.name = "farthest",
                                       .low = 1,
                                       .high = 1e5,
                                       .fallback = 800,
                                       .help = "metres at which the last slice ends, with range=fixed; what is beyond is in it",
                                       .scale = Scale::logarithmic}),
        param<&VoxelParams::channels>(channels),
        param<&VoxelParams::tint>(tint_row),
        param<&VoxelParams::resolution>(resolution),
        param<&VoxelParams::accumulation>(accumulation_row),
        param<&VoxelParams::culling>(
            {.name = "culling",
             .group = "culling",
             .low = 0,
             .high = 3,
             .fallback = culling_quads_16,
             .help = "of fragments of which nothing is seen: the depth test is against quads of 16 or 32 pixels, or a depth "
                     "written in every pixel; the picture is the same to the last bit",
             .choices = cullings}),
        param<&VoxelParams::prepared>(
            {.name = "prepared",
             .low = 0,
             .high = 1,
             .fallback = prepared_after_opaque,
             .help =
                 "when the volume is made; before opaque draws they are culled, too, unless soft particles or distortion need "
                 "what is behind",
             .choices = preparations}),
        param<&VoxelParams::hysteresis>(
            {.name = "hysteresis",
             .group = "from frame to frame",
             .low = 0,
             .high = 100,
             .fallback = 0,
             .help = "frames for which thicker slices are held, with volume=adaptive: thinner ones must have fitted so long"}),
        param<&VoxelParams::shown_slice>({.name = "shown_slice",
                                          .group = "views",
                                          .low = 0,
                                          .high = 1023,
                                          .fallback = 0,
                                          .help = "physical slice of the views 'slice' and 'slice integral'"}),
    };
    rows.insert(rows.end(), places.begin(), places.end());
    return rows;
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = function_counters();
    const std::vector<Counter> own = {
        counter<&VoxelCounters::columns>({.name = "columns", .help = "of the volume, of all channels"}),
        counter<&VoxelCounters::atomics>({.name = "atomics", .help = "additions to the volume's words"}),
        counter<&VoxelCounters::border_atomics>(
            {.name = "border atomics", .help = "of these, second ones of a fragment whose two slices are in two words"}),
        counter<&VoxelCounters::uncovered>(
            {.name = "uncovered", .help = "fragments in slices that coverage does not know of", .is_fatal = true}),
        counter<&VoxelCounters::overflowed>({.name = "overflowed", .help = "columns in which a slice overflowed"}),
        counter<&VoxelCounters::saturated>({.name = "saturated", .help = "columns behind which nothing is seen"}),
        counter<&VoxelCounters::voxels>({.name = "voxels", .help = "there is memory for"}),
        counter<&VoxelCounters::cleared>({.name = "cleared", .help = "voxels emptied: in tiles and slices that are used"}),
        counter<&VoxelCounters::integrated>({.name = "integrated", .help = "voxels of these read up to saturation"}),
        counter<&VoxelCounters::slices_used>({.name = "slices used", .help = "of an adaptive volume: with something in them"}),
        counter<&VoxelCounters::virtual_slices>(
            {.name = "virtual slices", .help = "that cut all of the range where slices are adaptive or sparse"}),
        counter<&VoxelCounters::zero_tiles>({.name = "zero tiles", .help = "tiles of pixels behind which nothing is seen"}),
        counter<&VoxelCounters::unseen>({.name = "unseen", .help = "fragments shaded of which nothing is seen"}),
        counter<&VoxelCounters::halvings>({.name = "halvings", .help = "of the finest slices' number, to that of virtual ones"}),
        counter<&VoxelCounters::halvings_held>(
            {.name = "halvings held", .help = "of these, such as only frames before this one needed: hysteresis"}),
        counter<&VoxelCounters::blocks>(
            {.name = "blocks", .help = "of a sparse volume's pool that something is in: 8 x 8 columns by a word, 256 bytes"}),
    };
    rows.insert(rows.end(), own.begin(), own.end());
    return rows;
}

template <std::uint32_t shown>
Image picture(Graph& graph, FrameImages& images, const Settings& settings) {
    return volume_view(graph, images, voxel_params(settings, *images.facts), shown);
}

template <Image (*view)(Graph&, const FrameImages&, const VoxelParams&)>
Image voxel_picture(Graph& graph, FrameImages& images, const Settings& settings) {
    return view(graph, images, voxel_params(settings, *images.facts));
}

std::vector<DebugView> views() {
    return {
        {"zero depth",
         "depth from which nothing is seen in the whole tile; 0 where something always is",
         "m",
         0,
         50,
         voxel_picture<zero_depth_view>,
         {},
         {},
         "something always shows"},
        {"culled",
         "red: fragments per pixel that culling keeps from being shaded; green: samples of whose opaque surface or background "
         "nothing is seen",
         "fragments",
         0,
         50,
         voxel_picture<culled_view>,
         {"fragments that are not shaded", "samples of an opaque surface or background that is not seen"},
         {},
         "nothing is culled"},
        {"saturation depth", "depth from which nothing is seen in the column, in every filtered read", "m", 0, 50,
         picture<view_saturation_depth>},
        {"occupancy", "slices that the tile of 8 x 8 columns uses: what is cleared and integrated", "slices", 0, 128,
         picture<view_occupancy>},
        {"warp",
         "across: depth in virtual slices; upwards: physical slices up to there; light where one is used, a run begins at a "
         "green line and ends at a red one; how much coarser than the finest they are is in the table divider",
         "",
         0,
         1,
         voxel_picture<warp_view>,
         {},
         {{glm::vec3(.7f), "slices that are used"},
          {glm::vec3(.2f), "slices without anything in them"},
          {{0, .6f, .1f}, "a run of slices begins"},
          {{.7f, .1f, 0}, "a run of slices ends"}}},
        {"overflow",
         "the nearest slice that overflowed in each channel, or all slices if none did",
         "slices",
         0,
         128,
         picture<view_overflow>,
         {"red", "green", "blue"}},
        {"thickness", "of the nearest slice that holds something in any channel: at the depth under the pixel; 0 where none does",
         "m", 0, 1, picture<view_thickness>},
        {"slice",
         "what the physical slice shown_slice holds, by channel",
         "optical depth",
         0,
         1,
         picture<view_slice>,
         {"red", "green", "blue"}},
        {"slice integral",
         "what is in front of the end of the physical slice shown_slice, by channel; ln M where nothing is seen",
         "optical depth",
         0,
         6,
         picture<view_slice_integral>,
         {"red", "green", "blue"}},
        {"self-occlusion",
         "what the pixel's nearest fragment reads in front of itself, where nothing is: its own, and that of what is beside it "
         "in "
         "the column; 0 without fragments",
         "optical depth", 0, 1, voxel_picture<self_occlusion_view>},
        normalization_row<sums>(),
        motion_row<sums>(),
    };
}

// A code of 8 bits where a texel lets a third through.
constexpr std::array exceptions = {
    ToleranceException{"splat=multiply bits=8", "explosion", 5e-4, 1.6e-2,
                       "the device rounds 24 of the 65536 products of 8 bits to the code below: .013 measured on llvmpipe"}};

}  // namespace

Technique voxel() {
    return {
        .stage = Stage::transparency,
        .name = "transparency/voxel",
        .title = "Voxel-based",
        .source = "Drobot, Adaptive Voxel-Based Order-Independent Transparency, SIGGRAPH Advances in Real-Time Rendering",
        .summary =
            "Adds optical depth to slices of a low-resolution volume by integer atomics and sums them up along the view: order "
            "independent, bit by bit; within a slice nothing hides anything, and layers below 8 bits are lost.",
        .params = params(),
        .points = {"slices=64",
                   "slices=256",
                   "slices=512",
                   "volume=dense",
                   "volume=dense range=fixed",
                   "volume=sparse",
                   "volume=sparse resolution=half",
                   "splat=saturating",
                   "splat=words bits=32",
                   "splat=multiply",
                   "splatting=point sampling=point",
                   "sampling=bicubic",
                   "bits=10",
                   "bits=16",
                   "bits=16 slices=512",
                   "packing=rgb10",
                   "packing=rgb10 bits=16",
                   "channels=mono tint=skew",
                   "channels=mono tint=corrected",
                   "curve=thickness",
                   "rounding=stochastic",
                   "thickness=segment",
                   "resolution=half",
                   "resolution=quarter",
                   "resolution=eighth",
                   "resolution=sixteenth"},
        .counters = counters(),
        .counter_bytes = sizeof(VoxelCounters),
        .views = views(),
        .tables = voxel_tables(),
        .abilities = {.slices_table = "slices"},
        .beyond_device = beyond_device,
        .claims = {.failures = {{"H4", 0.125, "the panes share a slice: the value of a tie"},
                                {"H5", 0.129, "8 bits lose layers below .0108 altogether"}},
                   .ratios = voxel_ratios()},

        .declare = add_function<sums>,
        .at_other_stages = {{.at = Stage::extinction, .declare = prepare}},
        .model = voxel_model,
        .model_is = ModelKind::mirror,
        .tolerance = {.rmse = 5e-4,
                      .worst = 1e-2,
                      .because = "codes are the model's to the last bit on every scenario; what is left is a step of the formats "
                                 "that the sums are rounded to: .008 of R11G11B10F, .001 of half floats",
                      .exceptions = exceptions},
    };
}

}  // namespace strata::transparency
