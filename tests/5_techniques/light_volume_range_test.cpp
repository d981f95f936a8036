// How bright light propagation volumes make a surface, as a multiple of what it should be, by its distance from a source in a
// vacuum: the table of docs/algorithms/lighting.md 5.8, on the device. A lit patch is injected into the middle cell of a grid; on
// its axis stand small squares that face it, each half a cell behind the middle of a cell, so that it reads that cell alone.
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/reference/decoded.h"
#include "replay/images/host_image.h"
#include "tests/5_techniques/lit_patch.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using std::numbers::pi;

constexpr std::array<int, 7> cells_away{1, 2, 3, 4, 5, 6, 8};

enum class Source { lobe, isotropic };

struct RangeRow {
    Source source;
    std::uint32_t iterations;
    std::string_view irradiance;
    std::uint32_t cells;           ///< each way
    std::array<double, 7> ratios;  ///< published
};

std::string range_row_text(const RangeRow& row) {
    return fmt::format("{}_{}_{}_in_{}", row.source == Source::lobe ? "lobe" : "isotropic", row.iterations, row.irradiance,
                       row.cells);
}
void PrintTo(const RangeRow& row, std::ostream* out) { *out << range_row_text(row); }

Frame squares_before(const RangeRow& row) {
    Frame frame = lit_patch(row.cells, 640, 360);
    if (row.source == Source::isotropic) light_from_behind(frame);
    for (const int r : cells_away) add_square(frame, {0, 0, r + .5}, .08);
    look(frame, {4, 0, .5}, {2.583, 0, 1.637}, .75);
    return frame;
}

/// Irradiance / pi at the pixel that is nearest to the axis on the square so far away.
double light_at(const Frame& frame, const Run& run, int r) {
    double nearest = .08, light = 0;
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) {
            const glm::dvec4 normal = texel(run.images.at("surface_normal"), x, y);
            if (normal.w <= 0) continue;
            const SurfacePoint p = decoded_surface(frame, {normal, {}, {}}, x, y);
            const glm::dvec3 at = frame.view.origin + glm::transpose(glm::dmat3(frame.view.to_view)) * p.position;
            const double aside = std::hypot(at.x, at.y);
            if (std::abs(at.z - r - .5) > .05 || aside >= nearest) continue;
            nearest = aside;
            light = texel(run.images.at("indirect"), x, y).x;
        }
    EXPECT_LT(nearest, .03) << "no pixel near the axis at " << r;
    return light;
}

class LightVolumeRange : public testing::TestWithParam<RangeRow> {};

TEST_P(LightVolumeRange, IsAsPublished) {
    const RangeRow& row = GetParam();
    const Frame frame = squares_before(row);
    const auto session = session_of({frame});
    Request request{.choices = chosen({"indirect/lpv"}, {"injection=0", "propagation=clamped", "lobes=face", "self_light=kept",
                                                         fmt::format("iterations={}", row.iterations),
                                                         fmt::format("irradiance={}", row.irradiance)})};
    request.outputs = {"indirect", "surface_normal"};
    const auto run = must(session->run(request));
    request.outputs = {"indirect/lpv:energy"};
    set(request, "iterations=1");
    const double flux = must(session->run(request)).tables.at("indirect/lpv:energy").rows.front()[1] / 3;
    const double intensity = row.source == Source::lobe ? flux / pi : flux / (4 * pi);
    for (std::size_t i = 0; i < cells_away.size(); ++i) {
        const int r = cells_away[i];
        const double ratio = pi * light_at(frame, run, r) * r * r / intensity;
        RecordProperty(fmt::format("at_{}", r), fmt::format("{:.4f}", ratio));
        EXPECT_NEAR(ratio, row.ratios[i], .02 * row.ratios[i] + 1e-3) << r << " cells away";
    }
}

// Of the published 65 cells, those that light can come back from within the iterations.
constexpr RangeRow small_row{Source::lobe, 16, "face", 25, {.884, 1.146, .917, .651, .367, .214, .041}};
constexpr std::array all_rows{RangeRow{Source::lobe, 8, "face", 65, {.837, .994, .624, .345, .103, .041, .001}},
                              RangeRow{Source::lobe, 16, "face", 65, {.884, 1.146, .917, .651, .367, .214, .041}},
                              RangeRow{Source::lobe, 32, "face", 65, {.918, 1.266, 1.165, .980, .750, .567, .253}},
                              RangeRow{Source::lobe, 64, "face", 65, {.942, 1.357, 1.360, 1.277, 1.151, 1.020, .708}},
                              RangeRow{Source::lobe, 32, "cell", 65, {.445, .623, .579, .490, .376, .285, .127}},
                              RangeRow{Source::isotropic, 32, "face", 65, {1.610, 2.489, 2.490, 2.210, 1.718, 1.309, .571}},
                              RangeRow{Source::isotropic, 32, "cell", 65, {.788, 1.232, 1.242, 1.108, .862, .657, .286}}};

std::string range_row_name(const testing::TestParamInfo<RangeRow>& info) { return range_row_text(info.param); }

INSTANTIATE_TEST_SUITE_P(Small, LightVolumeRange, testing::Values(small_row), range_row_name);
INSTANTIATE_TEST_SUITE_P(Exhaustive, LightVolumeRange, testing::ValuesIn(all_rows), range_row_name);

}  // namespace
}  // namespace strata
