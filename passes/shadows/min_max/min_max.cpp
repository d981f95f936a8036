// Min-max shadow maps: bounds of blocks of the maps answer the lookups whose texels all agree, and only the others are compared.
#include <algorithm>
#include <cstddef>

#include "passes/choice_names.h"
#include "passes/frame_images.h"
#include "passes/scene/scene_facts.h"
#include "passes/shadows/cast.h"
#include "passes/shadows/filter.h"
#include "passes/shadows/min_max/min_max.h"
#include "passes/shadows/shadows.shared.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::shadows {

ImageSet min_max_model(const StageInput&, const Settings&);

namespace {

static_assert(offsetof(MinMaxParams, filter) == offsetof(ShadowMapParams, filter));
static_assert(offsetof(MinMaxParams, caster_mask) == offsetof(ShadowMapParams, caster_mask));

constexpr auto forms = choice_names({{form_hierarchical, "hierarchical"},
                                     {form_block, "block"},
                                     {form_overlapping, "overlapping"},
                                     {form_plane, "plane"},
                                     {form_slab, "slab"}});
constexpr std::string_view blocks[] = {"2", "4", "8"};

const std::vector<ShadowView>& views_of(const FrameImages& frame) {
    return frame.facts->shadow_views(static_cast<Allocation>(frame.shadow_filter.allocation));
}

void draw_maps(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto params = settings.as<MinMaxParams>();
    make_shadow_maps(graph, frame, {.filter = params.filter, .caster_mask = params.caster_mask});
}

ComputeStep asking(ComputeStep builder, const FrameImages& frame, const MinMaxParams& params) {
    return fix_shadow_bounds(builder, params.bounds())
        .samples("shadow_bounds", frame.shadow_bounds)
        .fixes("bounds_form", params.form);
}

void filter_maps(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (!frame.shadow_maps) return;
    const auto params = settings.as<MinMaxParams>();
    std::vector<ShadowView> drawn;
    std::ranges::transform(drawn_maps(frame, static_cast<Allocation>(frame.shadow_filter.allocation)), std::back_inserter(drawn),
                           &DrawnMap::view);
    frame.shadow_bounds = add_shadow_bounds(graph, frame.shadow_maps, drawn, params.bounds());
    asking(filter_step(graph, frame, "shadows/min_max/filter.comp", frame.visibility), frame, params)
        .fixes("verifies", params.verify);
}

/// The light of the frame that is the n-th one with a map, or the last one.
std::uint32_t shown_light(const FrameImages& frame, std::uint32_t n) {
    const std::vector<std::uint32_t> lights = shadowed_lights(views_of(frame));
    return lights[std::min<std::size_t>(n, lights.size() - 1)];
}

struct Classes {
    Image picture;
    Buffer by_map;
};

Classes classes_of(Graph& graph, const FrameImages& frame, const MinMaxParams& params) {
    Classes made{.picture = graph.create("classes", {.extent = frame.extent, .format = Format::rgba32f}),
                 .by_map = graph.create("classes by map", views_of(frame).size() * 4 * sizeof(std::uint32_t))};
    graph.clear(made.by_map, 0);
    Image visibility;
    asking(filter_step(graph, frame, "shadows/min_max/classes.comp", visibility), frame, params)
        .fixes("shown_light", shown_light(frame, params.class_light))
        .stores("picture", made.picture)
        .updates("MapClasses", made.by_map);
    return made;
}

Image class_view(Graph& graph, FrameImages& frame, const Settings& settings) {
    if (frame.shadow_bounds) return classes_of(graph, frame, settings.as<MinMaxParams>()).picture;
    Image black = graph.create("classes", {.extent = frame.extent, .format = Format::rgba32f});
    graph.clear(black, {});
    return black;
}

Image class_table(Graph& graph, FrameImages& frame, const Settings& settings) {
    const auto slots = static_cast<std::uint32_t>(views_of(frame).size());
    Image numbers = graph.create("rows of classes", {.extent = {1, std::max(slots, 1u)}, .format = Format::rgba32f});
    graph.clear(numbers, {});
    if (!frame.shadow_bounds) return numbers;
    const Classes classes = classes_of(graph, frame, settings.as<MinMaxParams>());
    graph.compute("shadows/min_max/class_rows.comp")
        .stores("numbers", numbers)
        .loads("MapClasses", classes.by_map)
        .push(ClassRowsPush{.slots = slots})
        .over({1, slots});
    return numbers;
}

std::vector<Param> params() {
    std::vector<Param> rows = shadow_map_params();
    rows.push_back(param<&MinMaxParams::form>({.name = "form",
                                               .fallback = form_overlapping,
                                               .help = "bounds: of nested or separate blocks, of overlapping windows, or planes "
                                                       "(plane moves receivers along them) and slabs of such windows",
                                               .choices = forms}));
    rows.push_back(param<&MinMaxParams::block>({.name = "block",
                                                .fallback = 1,
                                                .help = "texels per edge of a block; larger: less memory, fewer early answers",
                                                .choices = blocks}));
    rows.push_back(param<&MinMaxParams::verify>(
        {.name = "verify", .help = "on: filter every lookup in full as well and count mismatches", .choices = switches}));
    rows.push_back(param<&MinMaxParams::class_light>({.name = "class_light",
                                                      .low = 0,
                                                      .high = 63,
                                                      .help = "number, among lights with a shadow map, of the light whose "
                                                              "lookups the view class shows; 0: the sun if it has a map, "
                                                              "else the first of the others, which follow as recorded"}));
    return rows;
}

std::vector<Counter> counters() {
    std::vector<Counter> rows = shadow_map_counters();
    rows.push_back(counter<&ShadowCounters::lit>({.name = "lit", .help = "lookups that bounds answer: every texel is lit"}));
    rows.push_back(
        counter<&ShadowCounters::shadowed>({.name = "shadowed", .help = "lookups that bounds answer: every texel is shadowed"}));
    rows.push_back(counter<&ShadowCounters::expensive>({.name = "expensive", .help = "lookups whose texels are compared"}));
    rows.push_back(counter<&ShadowCounters::outside>({.name = "outside", .help = "lookups that reach no texel of their map"}));
    rows.push_back(counter<&ShadowCounters::mismatches>(
        {.name = "mismatches", .help = "lookups that full filtering answers otherwise (verify=on)", .is_fatal = true}));
    return rows;
}

std::vector<DebugView> views() {
    std::vector<DebugView> rows = shadow_map_views();
    rows.push_back({.name = "class",
                    .help = "how the shadow lookups of light `class_light` are answered: 0 is the sun, then the lights with a "
                            "shadow map as recorded; of two blended cascades the more expensive answer",
                    .unit = "",
                    .declare = class_view,
                    .colors = {{{1, 0.9f, 0.4f}, "lit: answered by bounds"},
                               {{0, 0.1f, 0.4f}, "shadowed: answered by bounds"},
                               {{1, 0, 0}, "expensive: texels are compared"},
                               {{0.3f, 0.3f, 0.3f}, "outside: beyond the map, lit"},
                               {{0, 0, 0}, "no lookup"}}});
    return rows;
}

std::vector<DebugTable> tables() {
    std::vector<DebugTable> rows = shadow_map_tables();
    rows.push_back({.name = "classes_by_map",
                    .help = "lookups by slot of the map, a row per cascade, spot or face: what answers them, and the share of "
                            "early answers",
                    .columns = {{"lit", ""}, {"shadowed", ""}, {"expensive", ""}, {"rejection", "%"}},
                    .declare = class_table});
    return rows;
}

/// Against full filtering, the bounds with and without what it costs to build them. The talk gives no times.
std::vector<TimeRatio> ratios() {
    using Names = std::vector<std::string_view>;
    const Names all = {"/filter", "/bounds"}, lookups = {"/filter"};
    struct Row {
        std::string_view name, of, against;
        const Names& steps;
    };
    const Row rows[] = {
        {"overlapping bounds and lookups of 2x2 texels, against full filtering", "kernel=2x2", "pcf kernel=2x2", all},
        {"overlapping bounds and lookups of 4x4 texels, against full filtering", "kernel=4x4", "pcf kernel=4x4", all},
        {"overlapping bounds and lookups of 8x8 texels, against full filtering", "kernel=8x8", "pcf kernel=8x8", all},
        {"lookups of 8x8 texels alone, with overlapping bounds", "kernel=8x8", "pcf kernel=8x8", lookups},
        {"slabs and lookups of 2x2 texels, against full filtering", "kernel=2x2 form=slab", "pcf kernel=2x2", all},
        {"slabs and lookups of 4x4 texels, against full filtering", "kernel=4x4 form=slab", "pcf kernel=4x4", all},
        {"slabs and lookups of 8x8 texels, against full filtering", "kernel=8x8 form=slab", "pcf kernel=8x8", all},
        {"lookups of 8x8 texels alone, with slabs", "kernel=8x8 form=slab", "pcf kernel=8x8", lookups},
    };
    std::vector<TimeRatio> ratios;
    for (const Row& row : rows)
        ratios.push_back({.name = row.name,
                          .of = row.of,
                          .against = row.against,
                          .steps = row.steps,
                          .scenario = "sun_and_boxes",
                          .counters = {"lit", "shadowed", "expensive"}});
    return ratios;
}

/// Look-ups that the talk counts, docs/algorithms/deferred.md 5.2 and 5.4. It prints no times.
std::vector<PublishedTable> published_tables() {
    const std::vector<TableValueColumn> columns = {{.title = "look-ups", .unit = "", .value = TableValue::nothing},
                                                   {.title = "bounds", .parts = {"/bounds"}}};
    return {{.title = "bounds of 4x4 texels",
             .source = "Lobanchikov and Gruen's talk",
             .columns = columns,
             .rows = {{"point samples", {}, {{16.}, {}}}, {"Gather()", "form=block", {{4.}, {}}}},
             .scenario = "sun_and_boxes"},
            {.title = "filter of 4x4 texels",
             .source = "Lobanchikov and Gruen's talk",
             .columns = {columns.front()},
             .rows = {{"bilinear comparisons", {}, {{9.}}}, {"Gather()", {}, {{4.}}}},
             .scenario = "sun_and_boxes",
             .note = "Strata's filter reads its 16 texels one by one"}};
}

}  // namespace

Technique min_max() {
    return {
        .stage = Stage::shadows,
        .name = "shadows/min_max",
        .title = "Min-max shadow maps",
        .source =
            "Dmitriev, Uralsky: Soft Shadows Using Hierarchical Min-Max Shadow Maps, GDC 2005; Lobanchikov, Gruen: Clear "
            "Sky, GDC 2009; Gruen: Hybrid Min/Max Plane-Based Shadow Maps, GPU Pro 2010",
        .summary =
            "Answers lookups whose texels all agree from bounds of blocks, with the bits of full filtering; foliage and "
            "sloped ground leave most lookups to full filtering, sloped ground only without slabs.",
        .params = params(),
        .counters = counters(),
        .counter_bytes = sizeof(ShadowCounters),
        .views = views(),
        .tables = tables(),
        .claims = {.ratios = ratios(), .tables = published_tables()},
        .declare = draw_maps,
        .at_other_stages = {{.at = Stage::occlusion, .declare = filter_maps}},
        .model = min_max_model,
        .tolerance = {.rmse = 3e-4,
                      .worst = 0.014,
                      .because = "fractions of a texel are cut to 1/256 after float arithmetic, which moves both by one step at "
                                 "most, and 16-bit floats round by 2^-11; comparisons that float may turn are undecided, as is "
                                 "what is within a 500th texel of a block's edge where receivers follow planes"}};
}

}  // namespace strata::shadows
