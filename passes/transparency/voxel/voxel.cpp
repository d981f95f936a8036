// Voxel transparency: optical depth added up in slices of a low-resolution volume along the view, by integer atomics.
#include <array>
#include <cmath>

#include "passes/choice_names.h"
#include "passes/stage_input.h"
#include "passes/technique.h"
#include "passes/transparency/fragment_draw.h"
#include "passes/transparency/functions/draw.h"
#include "passes/transparency/functions/motion.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/voxel/ratios.h"
#include "passes/transparency/voxel/tables.h"
#include "passes/transparency/voxel/views/views.h"
#include "passes/transparency/voxel/volume/dimensions.h"
#include "passes/transparency/voxel/volume/volume.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"
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
              [&](DrawStep& draw, Resolution resolution) { read_volume(draw, volume, params, resolution); });
    return drawn;
}

/// Before the opaque draws: from which depth on nothing is seen of them, either.
void prepare(Graph& graph, FrameImages& images, const Settings& settings) {
    const auto params = voxel_params(settings, *images.facts);
    if (!is_made_before_opaque(params, *images.features)) return;
    images.depth = depth_to_draw_opaque_into(graph, images, integrated_volume(graph, images, params), params);
}

std::optional<Error> beyond_device(const FrameImages& images, const Settings& settings) {
    const Capabilities& device = images.capabilities;
    if (voxel_params(settings, *images.facts).splat != splat_multiply || has(device, Capability::shader_output_layer) ||
        has(device, Capability::geometry_shaders))
        return std::nullopt;
    return fail(Fault::device_lacks, "device.lacks_feature",
                "{technique} needs {feature} for {setting}, which this device does not have", "transparency/voxel",
                "shader_output_layer or geometry_shaders", "splat=multiply");
}

std::vector<Param> code_params() {
    return {
        param<&VoxelParams::slices>(
            {.name = "slices",
             .group = "the volume",
             .low = 32,
             .high = most_slices,
             .fallback = 128,
             .help = "slices of the volume in depth; fragments within one do not hide each other; more: more memory and time",
             .scale = Scale::logarithmic}),
        param<&VoxelParams::volume>({.name = "volume",
                                     .low = 0,
                                     .high = 2,
                                     .fallback = volume_adaptive,
                                     .help = "depths that slices divide; dense: the whole range; adaptive: occupied depths; "
                                             "sparse: occupied depths of each tile, as finely as `pool` allows",
                                     .choices = volumes}),
        param<&VoxelParams::thinnest>(
            {.name = "thinnest",
             .low = 1e-5,
             .high = 10,
             .fallback = 0.001,
             .help =
                 "smallest thickness of the nearest slice in meters (volume=adaptive, sparse); the range has at most 8192 slices",
             .scale = Scale::logarithmic}),
        param<&VoxelParams::pool>({.name = "pool",
                                   .low = 1,
                                   .high = 256,
                                   .fallback = 16,
                                   .help = "memory of the block pool in MiB (volume=sparse); larger: thinner slices",
                                   .scale = Scale::logarithmic}),
        param<&VoxelParams::skipping>(
            {.name = "skipping",
             .low = 0,
             .high = 1,
             .fallback = 1,
             .help = "on: skips slices that a tile of 8x8 columns does not use when clearing and integrating",
             .choices = switches}),
        param<&VoxelParams::splat>(
            {.name = "splat",
             .group = "format of the volume",
             .low = 0,
             .high = 4,
             .fallback = splat_overflow_minimum,
             .help = "words: one word per slice; others pack several, which wrap, saturate by compare-and-swap, or note the "
                     "nearest overflow; multiply: blends whole triangles without atomics",
             .choices = splats}),
        param<&VoxelParams::bits>({.name = "bits",
                                   .low = 0,
                                   .high = 3,
                                   .fallback = bits_8,
                                   .help = "bits per slice; the steps of optical depth are 0.0217, 0.0068, 0.00017 and 0.000013",
                                   .choices = bits_choices}),
        param<&VoxelParams::packing>({.name = "packing",
                                      .low = 0,
                                      .high = 1,
                                      .fallback = packing_planes,
                                      .help = "layout of three channels; planes: a volume for each; rgb10: 8 bits of each in one "
                                              "word, plus a volume for gray fragments",
                                      .choices = packings}),
        param<&VoxelParams::rounding>({.name = "rounding",
                                       .low = 0,
                                       .high = 1,
                                       .fallback = rounding_nearest,
                                       .help = "how optical depth is quantized; stochastic is unbiased but noisy",
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
        param<&VoxelParams::splatting>(
            {.name = "splatting",
             .group = "fragments in slices",
             .low = 0,
             .high = 1,
             .fallback = splatting_linear,
             .help = "point: adds a fragment to the slice that contains it; linear: shares it with the nearer neighboring slice",
             .choices = splattings}),
        param<&VoxelParams::thickness>(
            {.name = "thickness",
             .low = 0,
             .high = 1,
             .fallback = thickness_point,
             .help = "thickness of soft particles; point: none; segment: their fade distance, spread over every slice they cross",
             .choices = thicknesses}),
        param<&VoxelParams::sampling>({.name = "sampling",
                                       .low = 0,
                                       .high = 2,
                                       .fallback = sampling_linear,
                                       .help = "filter of the integral in depth; it is read 1 (point), 2 (linear) or 2.5 "
                                               "(bicubic) slices in front of a fragment",
                                       .choices = samplings}),
        param<&VoxelParams::shift>(
            {.name = "shift",
             .low = -2,
             .high = 2,
             .fallback = 0,
             .help = "offset of the read position in slices, away from the eye; above 0, fragments occlude themselves"}),
        param<&VoxelParams::curve>({.name = "curve",
                                    .group = "where slices lie",
                                    .low = 0,
                                    .high = 2,
                                    .fallback = curve_slices,
                                    .help = "extent of evenly spaced slices, logarithmic beyond; slices: an inch per slice; "
                                            "thickness: so that the nearest has near_thickness; linear: `linear` meters",
                                    .choices = curves}),
        param<&VoxelParams::near_thickness>({.name = "near_thickness",
                                             .low = 0.001,
                                             .high = 1,
                                             .fallback = 0.0508,
                                             .help = "thickness of the nearest slice in meters (curve=thickness)",
                                             .scale = Scale::logarithmic}),
        param<&VoxelParams::linear>({.name = "linear",
                                     .low = 0.001,
                                     .high = 1e5,
                                     .fallback = 3.25,
                                     .help = "extent of evenly spaced slices in meters (curve=linear)",
                                     .scale = Scale::logarithmic}),
        param<&VoxelParams::range>(
            {.name = "range",
             .low = 0,
             .high = 1,
             .fallback = range_frame,
             .help =
                 "depth range of the volume; frame: that of the frame's transparent geometry; fixed: from the eye to `farthest`",
             .choices = ranges}),
        param<&VoxelParams::farthest>(
            {.name = "farthest",
             .low = 1,
             .high = 1e5,
             .fallback = 800,
             .help = "far end of the volume in meters (range=fixed); anything beyond goes into the last slice",
             .scale = Scale::logarithmic}),
        param<&VoxelParams::channels>(channels),
        param<&VoxelParams::tint>(tint_row),
        param<&VoxelParams::resolution>(resolution),
        param<&VoxelParams::accumulation>(accumulation_row),
        param<&VoxelParams::culling>({.name = "culling",
                                      .group = "culling",
                                      .low = 0,
                                      .high = 3,
                                      .fallback = culling_quads_16,
                                      .help = "depth test that culls invisible fragments, against quads of 16 or 32 pixels or a "
                                              "depth per pixel; the picture is the same",
                                      .choices = cullings}),
        param<&VoxelParams::prepared>({.name = "prepared",
                                       .low = 0,
                                       .high = 1,
                                       .fallback = prepared_after_opaque,
                                       .help = "when the volume is built; before_opaque: also culls opaque draws, unless soft "
                                               "particles or distortion need what is behind",
                                       .choices = preparations}),
        param<&VoxelParams::hysteresis>({.name = "hysteresis",
                                         .group = "from frame to frame",
                                         .low = 0,
                                         .high = 100,
                                         .fallback = 0,
                                         .help = "frames for which thinner slices must have fitted before they are used "
                                                 "(volume=adaptive); 0: at once, slices may pop"}),
        param<&VoxelParams::shown_slice>({.name = "shown_slice",
                                          .group = "views",
                                          .low = 0,
                                          .high = 1023,
                                          .fallback = 0,
                                          .help = "physical slice shown by the views 'slice' and 'slice integral'"}),
    };
    rows.insert(rows.end(), places.begin(), places.end());
    return rows;
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = function_counters();
    rows.push_back(counter<&ListCounters::unfinished>(unfinished_row));  // of swaps
    const std::vector<Counter> own = {
        counter<&VoxelCounters::columns>({.name = "columns", .help = "columns of the volume, summed over channels"}),
        counter<&VoxelCounters::atomics>({.name = "atomics", .help = "atomic additions to the volume's words"}),
        counter<&VoxelCounters::border_atomics>(
            {.name = "border atomics", .help = "second additions of fragments whose two slices lie in different words"}),
        counter<&VoxelCounters::uncovered>({.name = "uncovered",
                                            .help = "fragments in slices that the coverage pass did not mark; expected: 0",
                                            .is_fatal = true}),
        counter<&VoxelCounters::overflowed>({.name = "overflowed", .help = "columns in which a slice overflowed"}),
        counter<&VoxelCounters::saturated>({.name = "saturated", .help = "columns that become opaque in some slice"}),
        counter<&VoxelCounters::voxels>({.name = "voxels", .help = "voxels allocated"}),
        counter<&VoxelCounters::cleared>({.name = "cleared", .help = "voxels cleared, in the slices that each tile uses"}),
        counter<&VoxelCounters::integrated>(
            {.name = "integrated", .help = "voxels integrated, in each column up to the slice where it becomes opaque"}),
        counter<&VoxelCounters::slices_used>({.name = "slices used", .help = "occupied slices (volume=adaptive)"}),
        counter<&VoxelCounters::virtual_slices>(
            {.name = "virtual slices",
             .help = "slices that divide the whole depth range, empty ones included (volume=adaptive, sparse)"}),
        counter<&VoxelCounters::zero_tiles>({.name = "zero tiles", .help = "screen tiles that become opaque at some depth"}),
        counter<&VoxelCounters::unseen>({.name = "unseen", .help = "fragments shaded although opaque layers hide them"}),
        counter<&VoxelCounters::halvings>(
            {.name = "halvings", .help = "how often the finest number of slices was halved to fit"}),
        counter<&VoxelCounters::halvings_held>(
            {.name = "halvings held", .help = "halvings kept only because earlier frames needed them (hysteresis)"}),
        counter<&VoxelCounters::blocks>(
            {.name = "blocks", .help = "blocks in use (volume=sparse): 8x8 columns by one word, 256 bytes each"}),
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
         "depth behind which nothing is visible in the whole tile; 0: something always is",
         "m",
         0,
         50,
         voxel_picture<zero_depth_view>,
         {},
         {},
         "something always shows"},
        {"culled",
         "red: fragments per pixel that culling saves from being shaded; green: samples whose opaque surface or background is "
         "invisible",
         "fragments",
         0,
         50,
         voxel_picture<culled_view>,
         {"fragments that are not shaded", "samples of an opaque surface or background that is not seen"},
         {},
         "nothing is culled"},
        {"saturation depth",
         "depth behind which nothing is visible in the column, wherever a filtered read samples it; 0: something always is",
         "m",
         0,
         50,
         picture<view_saturation_depth>,
         {},
         {},
         "no column becomes opaque"},
        {"occupancy", "slices that a tile of 8x8 columns uses; only these are cleared and integrated", "slices", 0, 128,
         picture<view_occupancy>},
        {"warp",
         "plot of the depth warp; x: virtual slices; y: physical slices up to there; light: occupied; green and red lines: a run "
         "begins and ends",
         "",
         0,
         1,
         voxel_picture<warp_view>,
         {},
         {{glm::vec3(.7f), "occupied slices"},
          {glm::vec3(.2f), "empty slices"},
          {{0, .6f, .1f}, "a run of slices begins"},
          {{.7f, .1f, 0}, "a run of slices ends"}}},
        {"overflow",
         "slices from the nearest one that overflowed to the last, per channel; 0: none overflowed",
         "slices",
         0,
         128,
         picture<view_overflow>,
         {"red", "green", "blue"},
         {},
         "no slice overflows"},
        {"thickness",
         "thickness of the nearest occupied slice under the pixel, in any channel; 0: none is occupied",
         "m",
         0,
         1,
         picture<view_thickness>,
         {},
         {},
         "no slice is occupied"},
        {"slice",
         "optical depth in the physical slice `shown_slice`, per channel",
         "optical depth",
         0,
         1,
         picture<view_slice>,
         {"red", "green", "blue"}},
        {"slice integral",
         "optical depth from the eye to the end of the physical slice `shown_slice`, per channel; ln M: opaque",
         "optical depth",
         0,
         6,
         picture<view_slice_integral>,
         {"red", "green", "blue"}},
        {"self-occlusion",
         "optical depth that the nearest fragment wrongly reads in front of itself: its own and its column's; 0: no fragment",
         "optical depth",
         0,
         1,
         voxel_picture<self_occlusion_view>,
         {},
         {},
         "no fragment occludes itself"},
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
        .aliases = {"avboit", "vboit"},
        .title = "Voxel-based",
        .source = "Drobot, Adaptive Voxel-Based Order-Independent Transparency, SIGGRAPH Advances in Real-Time Rendering",
        .summary =
            "Adds optical depth to slices of a low-resolution volume with integer atomics: order independent to the bit. "
            "Fragments within a slice do not hide each other; layers too thin for 8 bits are lost.",
        .params = params(),
        .variants = {"slices=64",
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
                   .ratios = voxel_ratios(),
                   .tables = voxel_published_tables()},

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
