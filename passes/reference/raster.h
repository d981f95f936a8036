// Coverage in double and exact integers: triangles set up once, then asked row by row which samples they cover.
// fragments.h is built on it; use that.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "passes/reference/fragments.h"
#include "passes/reference/triangles.h"

namespace strata {

struct Mesh;  // capture_format/frame/mesh.h

/// Steps per pixel that positions are snapped to here, as devices with 8 bits below the pixel do (subPixelPrecisionBits).
inline constexpr std::int64_t snap_steps = 256;
/// A sample this near to a side may fall on either of its sides on the device: both ends of the side can snap to the next step in
/// x and y, which moves it by sqrt(2) steps.
inline constexpr double undecided_steps = 1.5;

/// A side of a convex polygon on snapped positions: dx y - dy x + offset is 0 on it, positive inside.
struct RasterEdge {
    std::int64_t dx = 0, dy = 0, offset = 0;
    double inverse_length = 0;
    bool top_left = false;  ///< a sample exactly on it is covered
    bool decides = true;    ///< false: the neighbor behind it continues this triangle, so either may cover the sample
};

/// A triangle clipped to the near plane (3 to 4 sides) and to a guard band far outside the image (up to 8).
struct RasterTriangle {
    explicit RasterTriangle(const Corners& c) : corners(c), rays(c) {}

    std::uint32_t draw = 0, triangle = 0;
    std::uint32_t ordinal = 0;  ///< place among all triangles of the raster, culled ones counted
    bool front_facing = true;
    Corners corners;
    TriangleRays rays;
    glm::dvec2 depth_slope{0};  ///< change of device depth per pixel in x and y
    std::uint32_t edge_count = 0;
    std::array<RasterEdge, 8> edges;
    glm::i64vec2 low{0}, high{0};  ///< bounds in snap steps
};

/// All triangles of some draws of a frame.
class Raster {
public:
    /// Samples within so many steps of a side are undecided.
    Raster(const Frame&, std::span<const std::uint32_t> draws, double undecided_within = undecided_steps);

    using Visit = std::function<void(const RasterPoint&, const RasterTriangle&)>;
    /// The covered samples of one pixel row, triangle by triangle in submission order.
    void row(std::uint32_t y, RasterOptions, const Visit&) const;

private:
    void add_draw(std::uint32_t draw, std::uint32_t first_ordinal);
    void add_triangle(RasterTriangle, const DrawSpace&, std::uint8_t seams);
    void sort_into_rows();
    void visit_pixel(const RasterTriangle&, glm::uvec2 pixel, RasterOptions, const Visit&) const;

    const Frame* frame_;
    double undecided_within_;
    std::vector<RasterTriangle> triangles_;
    std::vector<std::size_t> row_begin_;  ///< of in_rows_, one more than there are rows
    std::vector<std::uint32_t> in_rows_;
    std::map<std::uint32_t, std::vector<std::uint8_t>> seams_;  ///< by mesh: seams_of_mesh
};

/// How far the device's depth at a sample may be from ours: two ulps of a float, and what a snap step makes of the slope.
double depth_tolerance(const RasterPoint&);

/// Whether the triangles of two points of one sample continue each other across a side near the sample: one of them surely has
/// it.
bool share_a_side(const RasterPoint&, const RasterPoint&);

/// Per triangle of a mesh a bit per side (0: from corner 0 to 1): set where exactly one other triangle has the same side, lies
/// in the same plane and continues every attribute linearly. Which of the two covers a sample there makes no difference.
std::vector<std::uint8_t> seams_of_mesh(const Mesh&);

}  // namespace strata
