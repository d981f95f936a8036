// G-buffer of 96 bits as shipped: two normal components with the third's sign, and view depth, as half floats.
#include "passes/frame_images.h"
#include "passes/gbuffer/fill.h"
#include "passes/graph/graph.h"
#include "passes/stage_input.h"
#include "passes/technique.h"

namespace strata::gbuffer {

ImageSet packed_model(const StageInput&, const Settings&);

namespace {

constexpr Format targets[] = {Format::rgba16f, Format::rgba8_unorm};

void declare(Graph& graph, FrameImages& frame, const Settings& settings) {
    add_fill(graph, frame, {.technique = "gbuffer/packed", .targets = targets}, settings);
}

/// Bits that the talk counts, docs/algorithms/deferred.md 2.1, beside those of the images that hold them here.
std::vector<PublishedTable> published_tables() {
    return {{.title = "layouts",
             .source = "Lobanchikov and Gruen's talk",
             .columns = {{.title = "bits per sample", .unit = "bits", .value = TableValue::bits_per_sample, .parts = {"gbuffer"}},
                         {.title = "stage"}},
             .rows = {{"position and normal in 16-bit floats", "wide", {{160.}, {}}},
                      {"packed", "packed", {{96.}, {}}},
                      {"octahedral, Strata's default", "octahedral", {{}, {}}},
                      {"compact, not of the talk", "compact", {{}, {}}}},
             .scenario = "materials",
             .note = "the talk prints no times"}};
}

}  // namespace

Technique packed() {
    return {.stage = Stage::gbuffer,
            .name = "gbuffer/packed",
            .title = "Clear Sky packing, 96 bits",
            .source = "Lobanchikov, Gruen: GSC Game World's S.T.A.L.K.E.R.: Clear Sky, a showcase for Direct3D 10.0/1, GDC 2009",
            .summary =
                "Stores x and y of the normal and the sign of z: cheap to pack, but normals seen edge-on are off by up to 2.1 "
                "degrees, and "
                "depth by 1/2048 of itself.",
            .params = fill_params(),
            .variants = {"attributes=sample"},
            .claims = {.tables = published_tables()},
            .declare = declare,
            .model = packed_model,
            .tolerance = {.rmse = 1.5e-3,
                          .worst = 0.045,
                          .because =
                              "a float on a rounding boundary takes the neighboring half: where z of the normal goes to 0 that "
                              "is up to 0.044 of it (sqrt(2 * 2^-10)); colors as in 8 bits sRGB, 0.0087 linear"}};
}

}  // namespace strata::gbuffer
