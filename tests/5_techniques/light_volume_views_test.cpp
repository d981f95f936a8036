// What the views of light propagation volumes show, pixel by pixel, where the numbers in cells are known.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/indirect/lpv/grids_model.h"
#include "passes/indirect/lpv/model.h"
#include "passes/indirect/lpv/occlusion/occlusion_model.h"
#include "passes/reference/decoded.h"
#include "replay/images/host_image.h"
#include "tests/5_techniques/lit_patch.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using std::numbers::pi;

Request request_of_view(std::string_view view, const std::vector<std::string>& sets) {
    Request request{.choices = chosen({"indirect/lpv"}, sets)};
    request.outputs = {fmt::format("indirect/lpv:{}", view), "indirect/lpv:energy", "surface_normal"};
    return request;
}

HostImage view_picture(const Run& run, std::string_view view) { return run.images.at(fmt::format("indirect/lpv:{}", view)); }

/// A cell that holds light: the same coefficients in all channels.
struct LitCell {
    glm::dvec3 middle{0};
    glm::dvec4 light{0};
};

struct Pixel {
    glm::dvec3 eye{0}, ray{0};  ///< world; the ray is 1 deep
    double depth = 0;           ///< of the surface there; infinite without one
};
Pixel pixel_of(const Frame& frame, const HostImage& normals, std::uint32_t x, std::uint32_t y) {
    const double depth = texel(normals, x, y).w;
    const SurfacePoint at_1 = decoded_surface(frame, {{0, 0, 1, 1}, {}, {}}, x, y);
    return {frame.view.origin, glm::transpose(glm::dmat3(frame.view.to_view)) * at_1.position, depth > 0 ? depth : HUGE_VAL};
}

/// By the light of a cell a meter wide along a normal, or on a surface that faces there.
using Shading = double (*)(const glm::dvec4& light, const glm::dvec3& normal);

/// W/sr: SH of two bands.
double sent(const glm::dvec4& light, const glm::dvec3& n) {
    const double along = glm::dot(glm::dvec3(light.y, light.z, light.w), n);
    return std::max(0., .28209479177 * light.x + .48860251190 * along);
}

/// Irradiance / pi by irradiance=cell. Of a cell's light a lobe max(0, cosine) around the direction that arrives is
/// sqrt(pi) / 2 l0 - sqrt(pi / 3) l1 . n, in W; a cube of a meter shows 1.5 m^2 in the mean.
double received(const glm::dvec4& light, const glm::dvec3& n) {
    const double along = glm::dot(glm::dvec3(light.y, light.z, light.w), n);
    return std::max(0., (std::sqrt(pi) / 2 * light.x - std::sqrt(pi / 3) * along) / 1.5 / pi);
}

struct Hit {
    double depth = 0, shade = 0;
    double edge = 0;  ///< how far from the sphere's outline, of its radius
};
/// What of the spheres is seen: the nearest before the surface.
Hit seen(const Pixel& pixel, std::span<const LitCell> cells, Shading shading) {
    constexpr double radius = .2;
    Hit nearest{.depth = pixel.depth, .shade = -1, .edge = 1};
    for (const LitCell& cell : cells) {
        const glm::dvec3 middle = cell.middle - pixel.eye;
        const double squared = glm::dot(pixel.ray, pixel.ray), closest = glm::dot(pixel.ray, middle) / squared;
        const double aside = glm::length(middle - closest * pixel.ray);
        nearest.edge = std::min(nearest.edge, std::abs(aside - radius) / radius);
        if (aside >= radius) continue;
        const double depth = closest - std::sqrt((radius * radius - aside * aside) / squared);
        if (std::abs(depth - pixel.depth) < 1e-4) nearest.edge = 0;
        if (depth >= nearest.depth) continue;
        const glm::dvec3 n = (depth * pixel.ray - middle) / radius;
        nearest.depth = depth;
        nearest.shade = shading(cell.light, n);
    }
    return nearest;
}

/// Compares every pixel but those at the outlines of spheres.
void expect_spheres(const Frame& frame, const Run& run, std::string_view view, std::span<const LitCell> cells, Shading shading) {
    const HostImage shown = view_picture(run, view), &normals = run.images.at("surface_normal");
    std::size_t compared = 0;
    double brightest = 0;
    for (std::uint32_t y = 0; y < run.height; ++y)
        for (std::uint32_t x = 0; x < run.width; ++x) {
            const Hit hit = seen(pixel_of(frame, normals, x, y), cells, shading);
            const glm::dvec4 now = texel(shown, x, y);
            if (hit.edge < .02) continue;
            if (hit.shade < 0) {
                ASSERT_LE(now.x, .0301) << x << ", " << y << ": the surface, dim";
                continue;
            }
            ++compared;
            brightest = std::max(brightest, hit.shade);
            ASSERT_NEAR(now.x, hit.shade, 1e-4 * brightest + 1e-3 * hit.shade) << x << ", " << y;
            ASSERT_EQ(now.x, now.z);
        }
    EXPECT_GT(compared, 100u);
    EXPECT_GT(brightest, 1);
}

/// W of each channel that the patch reflects.
double injected_flux(const Run& run) { return run.tables.at("indirect/lpv:energy").rows.front()[1] / 3; }

Frame patch_from_the_front() {
    Frame frame = lit_patch(5, 160, 120);
    look(frame, {1.2, .9, 5}, {0, 0, 0}, .6);
    return frame;
}

TEST(LightVolumeViews, OfOneInjectedLobeShowItsCellAlone) {
    const Frame frame = patch_from_the_front();
    const auto session = session_of({frame});
    for (const char* iterations : {"1", "8"}) {
        const auto run = must(session->run(
            request_of_view("injected", {"injection=0", "map_density=0", fmt::format("iterations={}", iterations)})));
        const double flux = injected_flux(run);
        // 4000 W/sr into the solid angle of a square of .6 m at 1.5 m.
        EXPECT_NEAR(flux, 4000 * 4 * std::asin(.09 / (.09 + 2.25)), .03 * flux);
        // Of a watt towards the patch's normal: lobe / pi, whose coefficients are sqrt(pi) / 2 and sqrt(pi / 3).
        const LitCell cell{.light = flux / pi * glm::dvec4(std::sqrt(pi) / 2, 0, 0, std::sqrt(pi / 3))};
        expect_spheres(frame, run, "injected", std::array{cell}, sent);
    }
}

// docs/algorithms/lighting.md T5.5: what a lobe of a watt towards +z sends to its neighbors.
TEST(LightVolumeViews, OfCellsAfterOneStepShowWhatTheNeighborsHaveTakenBesides) {
    const Frame frame = patch_from_the_front();
    const auto session = session_of({frame});
    const auto run =
        must(session->run(request_of_view("cells", {"injection=0", "iterations=1", "propagation=linear", "lobes=face"})));
    const double flux = injected_flux(run);
    std::vector<LitCell> cells{{.light = {.2820948, 0, 0, .3257350}},
                               {{0, 0, 1}, {.13301934, 0, 0, .03115748}},
                               {{0, 0, -1}, {-.03898774, 0, 0, .01038583}}};
    for (const double side : {-1., 1.}) {
        cells.push_back({{side, 0, 0}, {.04701580, side * .01038583, 0, .01963417}});
        cells.push_back({{0, side, 0}, {.04701580, 0, side * .01038583, .01963417}});
    }
    for (LitCell& cell : cells) cell.light *= flux;
    expect_spheres(frame, run, "cells", cells, received);
}

/// Of the six faces of the cell that a place lies in, by axis; nothing outside of the grid and within a millimeter of a border of
/// cells.
std::optional<glm::dvec3> closed_faces(const indirect::in_double::Grid& grid, const indirect::in_double::Links& links,
                                       const glm::dvec3& place) {
    using namespace indirect::in_double;
    const glm::ivec3 cell = cell_at(grid, place);
    const glm::dvec3 off = glm::abs(in_cells(grid, place) - glm::round(in_cells(grid, place))) * grid.cell_size;
    if (!is_inside(grid, cell) || std::min({off.x, off.y, off.z}) < 1e-3) return {};
    glm::dvec3 closed(0);
    for (int axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 0}) {
            glm::ivec3 lower = cell, upper = cell;
            lower[axis] += step;
            upper[axis] = lower[axis] + 1;
            if (!is_inside(grid, lower) || !is_inside(grid, upper)) continue;
            closed[axis] = std::max(closed[axis], 1 - links.open[cell_index(grid.cells, glm::uvec3(lower))][axis]);
        }
    return closed;
}

TEST(LightVolumeViews, OfAxialOcclusionShowWhatBlockersTakeAtTheFacesOfASurfacesCell) {
    using namespace indirect::in_double;
    std::vector<Frame> frames = scenario_frames("two_rooms", 1, 2);
    // The portal's edge is on the way between the middles of two cells, where rounding decides.
    for (Frame& frame : frames) frame.portals.front().center.z -= .03;
    const auto session = session_of(frames);
    for (const std::size_t index : {0u, 1u}) {
        Request request = request_of_view("axial occlusion", {});
        request.variant.frame = index;
        const auto run = must(session->run(request));
        const Frame& frame = frames[index];
        const Grid grid = grids(frame).front();
        const std::vector<indirect::in_double::Barrier> all = barriers(frame);
        const Links links = indirect::in_double::links(grid, all);
        const HostImage shown = view_picture(run, "axial occlusion"), &normals = run.images.at("surface_normal");
        std::size_t open = 0, partly = 0, closed = 0;
        for (std::uint32_t y = 0; y < run.height; ++y)
            for (std::uint32_t x = 0; x < run.width; ++x) {
                const glm::dvec4 normal = texel(normals, x, y);
                if (normal.w <= 0) continue;
                const SurfacePoint p = decoded_surface(frame, {normal, {}, {}}, x, y);
                const glm::dvec3 place = p.position + .02 * p.normal;
                const auto expected =
                    closed_faces(grid, links, frame.view.origin + glm::transpose(glm::dmat3(frame.view.to_view)) * place);
                if (!expected) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_NEAR(texel(shown, x, y)[axis], (*expected)[axis], 1e-6) << x << ", " << y << ", axis " << axis;
                    ++((*expected)[axis] == 0 ? open : (*expected)[axis] == 1 ? closed : partly);
                }
            }
        EXPECT_GT(open, 500u);
        EXPECT_GT(closed, 500u);
        EXPECT_GT(partly, 0u);
    }
}

TEST(LightVolumeViews, OfAxialOcclusionAreBlackWithoutIt) {
    const auto session = session_of(scenario_frames("two_rooms"));
    const auto run = must(session->run(request_of_view("axial occlusion", {"occlusion=none"})));
    for (const glm::dvec4& texel : in_double(view_picture(run, "axial occlusion")).texels)
        EXPECT_EQ(glm::dvec3(texel), glm::dvec3(0));
}

}  // namespace
}  // namespace strata
