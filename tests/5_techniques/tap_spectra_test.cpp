// Which tiles need tap visibility (docs/algorithms/lighting.md 3.2 and 5.8): those in which a surface reads the cells of a light
// volume near a blocker. Found again in double: a macro-cell's blockers are those of which a part is left when their rectangles
// are clipped to its box.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/indirect/lpv/grids_model.h"
#include "passes/lighting/mode_costs.h"
#include "passes/reference/decoded.h"
#include "passes/shaders/light_features.shared.h"
#include "passes/technique.h"
#include "replay/images/host_image.h"
#include "replay/spectra/spectra.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using indirect::in_double::Grid;

constexpr std::uint32_t tile = 16;     // pixels
constexpr double slack = 1e-3;         // meters, and cells: nearer than this to a border, rounding may decide
constexpr glm::dvec3 macro_cell(4.0);  // cells

struct Box {
    glm::dvec3 low{0}, high{0};
};

/// What is left of a polygon on one side of a plane across an axis.
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3>& polygon, glm::length_t axis, double sign, double end) {
    std::vector<glm::dvec3> left;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double inside_a = sign * (end - a[axis]), inside_b = sign * (end - b[axis]);
        if (inside_a >= 0) left.push_back(a);
        if (inside_a * inside_b < 0) left.push_back(glm::mix(a, b, inside_a / (inside_a - inside_b)));
    }
    return left;
}

bool meets(const Blocker& blocker, const Box& box) {
    const glm::dvec3 u = double(blocker.half_u) * glm::dvec3(blocker.u), v = double(blocker.half_v) * glm::dvec3(blocker.v);
    std::vector<glm::dvec3> left{blocker.center - u - v, blocker.center + u - v, blocker.center + u + v, blocker.center - u + v};
    for (glm::length_t axis = 0; axis < 3; ++axis)
        left = clipped(clipped(left, axis, 1, box.high[axis]), axis, -1, box.low[axis]);
    return !left.empty();
}

/// Of the macro-cell of a place, in cells: grown by what ways to cells may reach, and at the grid's border by a cell more.
Box box_of(const Grid& grid, const glm::dvec3& place, double more) {
    const glm::dvec3 cells(grid.cells), last = glm::ceil(cells / macro_cell) - 1.0;
    const glm::dvec3 macro = glm::floor(glm::clamp(glm::floor(place), glm::dvec3(0), cells - 1.0) / macro_cell);
    const glm::dvec3 low = macro * macro_cell - glm::dvec3(glm::equal(macro, glm::dvec3(0)));
    const glm::dvec3 high = glm::min((macro + 1.0) * macro_cell, cells) + glm::dvec3(glm::equal(macro, last));
    const double grown = 17. / 16 * grid.cell_size + .02 + more;
    return {grid.origin + grid.cell_size * low - grown, grid.origin + grid.cell_size * high + grown};
}

enum class Need { no, undecided, yes };

Need need_of(const Frame& frame, const Grid& grid, const glm::dvec3& position, const glm::dvec3& normal) {
    const glm::dvec3 at = (position - grid.origin) / grid.cell_size, depth = glm::min(at, glm::dvec3(grid.cells) - at);
    const double inside = std::min({depth.x, depth.y, depth.z});
    if (inside < -slack) return Need::no;
    bool always = inside > slack, ever = false;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 off(corner & 1 ? slack : -slack, corner & 2 ? slack : -slack, corner & 4 ? slack : -slack);
        const glm::dvec3 place = at + .5 * normal + off;
        const auto near = [&](double more) {
            return std::ranges::any_of(frame.blockers, [&](const Blocker& b) { return meets(b, box_of(grid, place, more)); });
        };
        always &= near(-slack);
        ever |= near(slack);
    }
    return always ? Need::yes : ever ? Need::undecided : Need::no;
}

/// By tile, row by row.
std::vector<Need> needs_of_tiles(const Frame& frame, const HostImage& normals) {
    const std::uint32_t width = frame.view.width, height = frame.view.height, across = (width + tile - 1) / tile;
    std::vector<Need> needs(std::size_t{across} * ((height + tile - 1) / tile), Need::no);
    const std::vector<Grid> grids = indirect::in_double::grids(frame);
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(frame.view.to_view));
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const glm::dvec4 normal = texel(normals, x, y);
            Need& need = needs[y / tile * across + x / tile];
            if (normal.w <= 0 || need == Need::yes) continue;
            const SurfacePoint p = decoded_surface(frame, {normal, glm::dvec4(0), glm::dvec4(0)}, x, y);
            const glm::dvec3 place = frame.view.origin + to_world * p.position, n = to_world * p.normal;
            for (const Grid& grid : grids) need = std::max(need, need_of(frame, grid, place, n));
        }
    return needs;
}

Frame scenario_frame(std::string_view name) { return must(find_scenario(name))->build(0, {.width = 96, .height = 64}); }

Run run_of(Session& session, const std::vector<std::string>& uses, const std::vector<std::string>& sets) {
    Request request{.choices = chosen(uses, sets)};
    request.outputs = {"lighting/tiled:spectrum", "lighting/tiled:spectra", "surface_normal"};
    return must(session.run(request));
}

bool needs_taps(double spectrum) { return (static_cast<std::uint32_t>(spectrum) & feature_gi_tap_visibility) != 0; }

std::uint64_t tiles_with_taps(const Run& run) {
    double tiles = 0;
    for (const std::vector<double>& row : run.tables.at("lighting/tiled:spectra").rows)
        if (needs_taps(row[0])) tiles += row[1];
    return static_cast<std::uint64_t>(tiles);
}

struct Scene {
    std::string_view name;
    std::vector<std::string> sets;
    bool has_far_tiles;
};

TEST(TapSpectra, HaveTheBitInTilesWhoseSurfacesReadLightNearABlocker) {
    for (const Scene& scene : {Scene{"two_rooms", {}, false}, Scene{"cornell_box", {"occlusion=axial"}, true}}) {
        const Frame frame = scenario_frame(scene.name);
        const auto session = session_of({frame});
        const auto run = run_of(*session, {"indirect/lpv", "lighting/tiled"}, scene.sets);
        const HostImage& shown = run.images.at("lighting/tiled:spectrum");
        const std::vector<Need> needs = needs_of_tiles(frame, run.images.at("surface_normal"));
        std::array<std::size_t, 3> count{};
        std::uint64_t with_taps = 0;
        for (std::size_t i = 0; i < needs.size(); ++i) {
            const auto across = frame.view.width / tile;
            const double spectrum =
                texel(shown, tile * static_cast<std::uint32_t>(i % across), tile * static_cast<std::uint32_t>(i / across)).x;
            if (spectrum < 0) continue;
            ++count[static_cast<std::size_t>(needs[i])];
            with_taps += needs_taps(spectrum);
            if (needs[i] == Need::undecided) continue;
            EXPECT_EQ(needs_taps(spectrum), needs[i] == Need::yes) << scene.name << ", tile " << i;
        }
        EXPECT_GT(count[std::size_t(Need::yes)], 5u) << scene.name;
        EXPECT_EQ(count[std::size_t(Need::no)] > 5, scene.has_far_tiles) << scene.name;
        EXPECT_LE(count[std::size_t(Need::undecided)], 4u) << scene.name;
        EXPECT_EQ(tiles_with_taps(run), with_taps) << "in the table as in the view";
    }
}

TEST(TapSpectra, LackTheBitWhereNoTapIsAsked) {
    const auto session = session_of({scenario_frame("two_rooms")});
    EXPECT_GT(tiles_with_taps(run_of(*session, {"indirect/lpv", "lighting/tiled"}, {"iterations=1"})), 0u);
    EXPECT_EQ(tiles_with_taps(run_of(*session, {"indirect/lpv", "lighting/tiled"}, {"iterations=1", "taps=all"})), 0u);
    EXPECT_EQ(tiles_with_taps(run_of(*session, {"indirect/lpv", "lighting/tiled"}, {"iterations=1", "occlusion=none"})), 0u);
    EXPECT_EQ(tiles_with_taps(run_of(*session, {"indirect/ambient", "lighting/tiled"}, {})), 0u);
}

TEST(TapSpectra, ArePricedAndServedByModes) {
    const auto session = session_of({scenario_frame("cornell_box")});
    const Technique& technique = *must(technique_of_spectra({}));
    const Request base{.choices = chosen({"indirect/lpv"}, {"occlusion=axial"})};
    const GatheredFrames gathered = must(gather_spectra(*session, technique, base, std::array{std::size_t{0}}));
    const lighting::Histogram& tiles = gathered.frames.front().tiles;
    double ideal = 0;
    for (const auto& [spectrum, count] : tiles) ideal += double(count) * lighting::weighted_cost(spectrum);
    const SpectraReport report = find_modes(gathered.frames, {.cost = lighting::weighted_cost, .unit = "weights"},
                                            {.modes = std::min<std::size_t>(16, tiles.size() + 1)});
    EXPECT_NEAR(report.ideal, ideal, 1e-9);
    EXPECT_NEAR(report.by_modes, ideal, 1e-9);
    for (const bool with : {false, true})
        EXPECT_TRUE(std::ranges::any_of(tiles, [&](const auto& row) { return needs_taps(row.first) == with; })) << with;
    // The mode that a tile is shaded by needs not have the bit: volumes are read by another stage. Its cost is counted all the
    // same.
    for (const lighting::SpectrumRow& row : gathered.frames.front().rows)
        EXPECT_TRUE(lighting::serves(row.features, row.spectrum));
}

}  // namespace
}  // namespace strata
