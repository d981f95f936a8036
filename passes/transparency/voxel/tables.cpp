// Every number in `published` is one of docs/algorithms/transparency.md 6.16, where doubts about the talk's own numbers stand.
#include "passes/transparency/voxel/tables.h"

#include <iterator>
#include <utility>

namespace strata::transparency {
namespace {

using TableParts = std::vector<std::string_view>;
using TableRows = std::vector<TableRow>;

// Strata's steps by the talk's names.
constexpr std::string_view splat_steps[] = {"/splat"};
constexpr std::string_view clear_steps[] = {"/clear.comp",   "clear voxel",  "clear depth warp",
                                            "clear factors", "clear moment", "clear coefficients"};
constexpr std::string_view integration_steps[] = {"/integrate"};
constexpr std::string_view prepass_steps[] = {"/farthest_depth", "clear prepass", "/project", "/coverage.comp",
                                              "/warp.comp",      "/tiles.comp",   "/splat",   "/factors_to_codes"};
constexpr std::string_view spawn_steps[] = {"/zero_depth.comp", "clear zero draw"};
constexpr std::string_view depth_steps[] = {"depth that culls", "/quads", "/full_screen"};
constexpr std::string_view draw_steps[] = {"/accumulate", "/composite"};
constexpr std::string_view resolve_steps[] = {"/resolve.comp"};
constexpr std::string_view volume_memory[] = {"voxels", "nearest overflow", "factors"};

template <typename... Parts>
TableParts steps_named(const Parts&... parts) {
    TableParts all;
    (all.insert(all.end(), std::begin(parts), std::end(parts)), ...);
    return all;
}

PublishedTable splat_types() {
    return {.title = "splat types",
            .source = "Drobot's talk: 17 million pixels at 1080p, PS5",
            .columns = {{.title = "splat", .parts = steps_named(splat_steps)}},
            .rows = {{"MRT, multiplied", "splat=multiply channels=mono", {{.75}}},
                     {"a word per slice", "splat=words channels=mono", {{.91}}},
                     {"bytes that wrap", "splat=wrapping channels=mono", {{.89}}},
                     {"bytes, spinlock", "splat=saturating channels=mono", {{1.95}}},
                     {"bytes, overflow noted", "splat=overflow_minimum channels=mono", {{.91}}}},
            .scenario = "ash_storm",
            .counters = {"atomics", "border atomics", "overflowed"},
            .witness = {"overflowed", "no slice overflows in this frame: bytes that wrap hold what the others hold"},
            .note = "MRT: without the step that turns its factors into codes, which the talk does not have"};
}

PublishedTable splat_formats() {
    return {.title = "splat formats",
            .source = "Drobot's talk: 17 million pixels at 1080p, PS5",
            .columns = {{.title = "splat", .parts = steps_named(splat_steps)}},
            .rows = {{"MRT 8 UNORM, multiplied", "splat=multiply channels=mono", {{.75}}},
                     {"MRT 10:10:10, multiplied", {}, {{.81}}},
                     {"bytes, overflow noted", "splat=overflow_minimum channels=mono", {{.91}}},
                     {"10:10:10, overflow noted", "splat=overflow_minimum packing=rgb10 channels=rgb", {{.95}}}},
            .scenario = "glass_and_smoke",
            .counters = {"atomics", "border atomics", "overflowed"},
            .note = "10:10:10: channels of 8 bits with 2 of carry; gray fragments go to a volume of bytes beside it"};
}

PublishedTable point_and_linear() {
    return {.title = "point and linear splats",
            .source = "Drobot's talk; the slide prints the numbers of its formats once more",
            .columns = {{.title = "splat", .parts = steps_named(splat_steps)}},
            .rows = {{"mono, point", "splatting=point channels=mono", {{.75}}},
                     {"mono, linear", "splatting=linear channels=mono", {{.81}}},
                     {"RGB, point", "splatting=point channels=rgb packing=rgb10", {{.91}}},
                     {"RGB, linear", "splatting=linear channels=rgb packing=rgb10", {{.95}}}},
            .scenario = "glass_and_smoke",
            .counters = {"atomics", "border atomics"}};
}

PublishedTable clear_and_integrate() {
    constexpr std::string_view everywhere = "resolution=eighth channels=rgb packing=rgb10 volume=dense range=fixed skipping=off",
                               in_use = "resolution=eighth channels=rgb packing=rgb10 volume=dense range=fixed";
    constexpr double megabytes = 320 * 180 * 128 * (1 + 4 + 4) / 1e6;
    return {.title = "clear and integrate",
            .source = "Drobot's talk: RGB at 1440p",
            .columns = {{.title = "clear", .parts = steps_named(clear_steps)},
                        {.title = "integrate", .parts = steps_named(integration_steps)},
                        {.title = "total", .parts = steps_named(clear_steps, integration_steps)},
                        {.title = "memory", .unit = "MB", .value = TableValue::megabytes, .parts = steps_named(volume_memory)}},
            .rows = {{"every voxel", everywhere, {{.153}, {.2}, {.353}, {.published = 66.5, .derived = megabytes}}},
                     {"voxels of occupied slices", in_use, {{.01}, {.04}, {.05}, {.derived = megabytes}}}},
            .scenario = "glass_and_smoke",
            .counters = {"voxels", "cleared", "integrated"},
            .derivation = "320x180 columns of 128 slices: a byte for gray, a word for color, a word for the integral",
            .note = "Strata integrates in place: memory is the extinction alone"};
}

PublishedTable quads_or_depth_export() {
    return {.title = "quads against depth export",
            .source = "Drobot's talk: 4K, from 480x270 columns",
            .columns = {{.title = "spawn", .parts = steps_named(spawn_steps)},
                        {.title = "draw", .parts = steps_named(depth_steps)},
                        {.title = "total", .parts = steps_named(spawn_steps, depth_steps)}},
            .rows = {{"quads of 16x16 pixels", "resolution=eighth culling=quads_16", {{.004}, {.01}, {.014}}},
                     {"full-screen depth export", "resolution=eighth culling=full_screen", {{}, {}, {.2}}}},
            .scenario = "smoke_core",
            .counters = {"saturated", "zero tiles"},
            .witness = {"zero tiles", "no tile becomes opaque in this frame: no quad is drawn"},
            .note = "draw includes the copy of the depth that is culled against; depth export spawns, too: its draw is skipped"};
}

PublishedTable early_out() {
    return {
        .title = "early-out at zero transmittance",
        .source = "Drobot's talk",
        .columns = {{.title = "spawn", .parts = steps_named(spawn_steps)},
                    {.title = "depth", .parts = steps_named(depth_steps)},
                    {.title = "raster", .parts = steps_named(draw_steps)},
                    {.title = "total", .parts = steps_named(spawn_steps, depth_steps, draw_steps)},
                    {.title = "transparent fragments", .unit = "", .value = TableValue::counter, .parts = {"drawn", "fragments"}},
                    {.title = "opaque invocations", .unit = "", .value = TableValue::invocations, .parts = {"gbuffer"}}},
        .rows = {{"VBOIT",
                  "resolution=eighth culling=off",
                  {{}, {}, {2.035}, {.published = 1.98, .derived = 2.035}, {21276176.}, {2759432.}}},
                 {"VBOIT, zero transmittance",
                  "resolution=eighth culling=quads_16 prepared=before_opaque",
                  {{}, {}, {1.78}, {.published = 1.742, .derived = .014 + 1.78}, {18922855.}, {1867980.}}},
                 {"alpha blending", "alpha_blend", {{}, {}, {1.73}, {.published = 1.73, .derived = 1.73}, {}, {}}}},
        .scenario = "smoke_core",
        .counters = {"drawn", "unseen", "zero tiles", "fragments"},
        .witness = {"zero tiles", "no tile becomes opaque in this frame: nothing is culled"},
        .derivation = "sum of the printed steps, with .014 of the table of quads: the printed totals are below their parts"};
}

/// Bytes read and look-ups are the talk's alone: no device counts either by image.
PublishedTable memory_of_functions(std::string_view title, TableRows rows) {
    return {.title = title,
            .source = "Drobot's talk: 4K, from 480x270 columns; called sparse for AVBOIT",
            .columns = {{.title = "memory", .unit = "MB", .value = TableValue::megabytes, .parts = {"moment", "coeff", "voxels"}},
                        {.title = "read per pixel", .unit = "bytes", .value = TableValue::nothing},
                        {.title = "look-ups per pixel", .unit = "", .value = TableValue::nothing}},
            .rows = std::move(rows),
            .scenario = "glass_and_smoke",
            .derivation =
                "480x270 columns: MBOIT 5 half floats, WOIT 8, AVBOIT 128 slices of a byte, or a word for RGB; "
                "of the former three times as many for RGB",
            .note = "look-ups are of 2D images, of AVBOIT of one 3D image"};
}

PublishedTable memory_of_mono() {
    constexpr double columns = 480 * 270 / 1e6;
    return memory_of_functions(
        "memory of mono functions",
        {{"MBOIT",
          "moments kind=power4 storage=half resolution=eighth channels=mono",
          {{.published = 1.3, .derived = columns * 10}, {10.}, {2.}}},
         {"WOIT",
          "wavelet storage=half resolution=eighth channels=mono",
          {{.published = 2., .derived = columns * 16}, {8.}, {3.}}},
         {"AVBOIT", "resolution=eighth channels=mono", {{.published = 16.8, .derived = columns * 128}, {1.}, {1.}}}});
}

PublishedTable memory_of_rgb() {
    constexpr double columns = 480 * 270 / 1e6;
    return memory_of_functions("memory of RGB functions",
                               {{"MBOIT",
                                 "moments kind=power4 storage=half resolution=eighth channels=rgb",
                                 {{.published = 4., .derived = columns * 30}, {30.}, {4.}}},
                                {"WOIT",
                                 "wavelet storage=half resolution=eighth channels=rgb",
                                 {{.published = 6., .derived = columns * 48}, {24.}, {3.}}},
                                {"AVBOIT",
                                 "resolution=eighth channels=rgb packing=rgb10",
                                 {{.published = 66.3, .derived = columns * 512}, {.printed = "1-4"}, {1.}}}});
}

PublishedTable rgb_multipliers() {
    const auto times = [](std::string_view title, TableParts parts) {
        return TableValueColumn{.title = title, .unit = "x mono", .parts = std::move(parts)};
    };
    return {.title = "RGB multipliers",
            .source = "Drobot's talk",
            .columns = {times("clear", steps_named(clear_steps)), times("prepass", steps_named(prepass_steps)),
                        times("integrate", steps_named(integration_steps)), times("draws", steps_named(draw_steps)),
                        times("resolve", steps_named(resolve_steps)), times("average", {})},
            .rows = {{.label = "MBOIT",
                      .variant = "moments kind=power4 storage=half resolution=eighth channels=rgb",
                      .cells = {{3.}, {1.9}, {}, {1.4}, {1.1}, {.printed = "> 1.5"}},
                      .against = "moments kind=power4 storage=half resolution=eighth channels=mono"},
                     {.label = "WOIT",
                      .variant = "wavelet storage=half resolution=eighth channels=rgb",
                      .cells = {{3.}, {1.7}, {}, {1.3}, {1.1}, {.printed = "> 1.3"}},
                      .against = "wavelet storage=half resolution=eighth channels=mono"},
                     {.label = "AVBOIT",
                      .variant = "resolution=eighth channels=rgb packing=rgb10",
                      .cells = {{3.}, {1.04}, {3.}, {1.05}, {1.1}, {.printed = "~ 1.05"}},
                      .against = "resolution=eighth channels=mono"}},
            .scenario = "glass_and_smoke",
            .counters = {"drawn", "atomics"},
            .note = "average is the whole stage, with clears of the sums and of counters"};
}

PublishedTable techniques_by_step() {
    return {
        .title = "techniques by step",
        .source = "Drobot's talk",
        .columns = {{.title = "clear", .parts = steps_named(clear_steps)},
                    {.title = "prepass", .parts = steps_named(prepass_steps)},
                    {.title = "cull", .parts = steps_named(spawn_steps, depth_steps)},
                    {.title = "integration", .parts = steps_named(integration_steps)},
                    {.title = "draws", .parts = steps_named(draw_steps)},
                    {.title = "resolve", .parts = steps_named(resolve_steps)},
                    {.title = "total"}},
        .rows = {{"MBOIT",
                  "moments kind=power4 storage=half resolution=eighth",
                  {{.001}, {.196}, {}, {}, {5.4}, {.108}, {.published = 5.705, .derived = .001 + .196 + 5.4 + .108}}},
                 {"WOIT",
                  "wavelet storage=half resolution=eighth",
                  {{.001}, {.199}, {}, {}, {5.6}, {.108}, {.published = 5.908, .derived = .001 + .199 + 5.6 + .108}}},
                 {"AVBOIT",
                  "resolution=eighth culling=off",
                  {{.013}, {.204}, {}, {.025}, {5.2}, {.108}, {.published = 5.667, .derived = .013 + .204 + .025 + 5.2 + .108}}},
                 {"AVBOIT, culled",
                  "resolution=eighth culling=quads_16",
                  {{.013},
                   {.204},
                   {.006},
                   {.025},
                   {4.5},
                   {.108},
                   {.published = 4.967, .derived = .013 + .204 + .006 + .025 + 4.5 + .108}}},
                 {"no OIT", "alpha_blend", {{}, {}, {}, {}, {4.4}, {}, {.published = 4.4, .derived = 4.4}}}},
        .scenario = "smoke_core",
        .counters = {"drawn", "fragments", "atomics", "zero tiles"},
        .witness = {"zero tiles", "no tile becomes opaque in this frame: culling saves nothing"},
        .derivation = "sum of the printed steps: AVBOIT's printed totals are others",
        .note = "total has every step of the stage, with clears of the sums and of counters"};
}

PublishedTable rgb_in_practice() {
    return {.title = "RGB in practice",
            .source = "Drobot's talk",
            .columns = {{.title = "total"}},
            .rows = {{"no OIT", "alpha_blend", {{2.8}}},
                     {.label = "mono", .variant = {}, .cells = {{2.95}}},
                     {"total extinction only in RGB", "resolution=eighth channels=mono tint=total", {{3.02}}},
                     {"RGB", "resolution=eighth channels=rgb packing=rgb10", {{3.11}}}},
            .scenario = "glass_and_smoke",
            .counters = {"drawn", "fragments", "atomics"},
            .note = "mono would dim the background in gray, too: channels=mono keeps the color of its total extinction"};
}

PublishedTable playstation_4() {
    const auto row = [](std::string_view label, TableCell transparency, TableCell effects, TableCell total) {
        return TableRow{.label = label,
                        .variant = {},
                        .cells = {transparency, effects, total},
                        .not_measured = "published only: on a PS4 in a frame of the game"};
    };
    return {.title = "PS4",
            .source = "Drobot's talk: PS4 at 1080p",
            .columns = {{.title = "transparency"}, {.title = "effects"}, {.title = "total"}},
            .rows = {row("MBOIT", {3.31}, {3.34}, {.published = 6.65, .derived = 3.31 + 3.34}),
                     row("WOIT", {3.04}, {3.12}, {.published = 6.16, .derived = 3.04 + 3.12}),
                     row("AVBOIT", {2.11}, {2.91}, {.published = 5.03, .derived = 2.11 + 2.91}),
                     row("no OIT", {1.8}, {2.72}, {.published = 4.5, .derived = 1.8 + 2.72})},
            .derivation = "transparency and effects"};
}

PublishedTable geforce_1060() {
    constexpr std::string_view elsewhere = "published only: on a GTX 1060 in a scene of the game",
                               illegible = "published only, and not legible on the slide";
    return {.title = "GTX 1060",
            .source = "Drobot's talk: GTX 1060 at 1080p, a cinematic",
            .columns = {{.title = "transparency"}},
            .rows = {{"AVBOIT, RGB", {}, {{2.22}}, elsewhere}, {"no OIT", {}, {{}}, illegible}}};
}

}  // namespace

std::vector<PublishedTable> voxel_published_tables() {
    return {splat_types(),     splat_formats(),  point_and_linear(), clear_and_integrate(), quads_or_depth_export(),
            early_out(),       memory_of_mono(), memory_of_rgb(),    rgb_multipliers(),     techniques_by_step(),
            rgb_in_practice(), playstation_4(),  geforce_1060()};
}

}  // namespace strata::transparency
