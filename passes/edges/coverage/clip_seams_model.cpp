#include "passes/edges/coverage/clip_seams_model.h"

#include <cmath>
#include <vector>

#include "capture_format/frame/frame.h"
#include "passes/reference/fragments.h"
#include "passes/reference/triangles.h"

namespace strata::edges {
namespace {

/// (x, y, w) of clip space.
using Polygon = std::vector<glm::dvec3>;

Polygon clipped(const Polygon& polygon, const glm::dvec4& plane) {
    const auto height = [&](const glm::dvec3& p) { return glm::dot(glm::dvec3(plane), p) + plane.w; };
    Polygon inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
        const double a = height(from), b = height(to);
        if (a >= 0) inside.push_back(from);
        if ((a >= 0) != (b >= 0)) inside.push_back(from + a / (a - b) * (to - from));
    }
    return inside;
}

/// Corners on the screen of what the view leaves of the triangle, in pixels; nothing where the view cuts nothing off.
std::vector<glm::dvec2> corners_if_cut(const View& view, const Corners& corners) {
    const glm::dmat4 m = view.projection;
    Polygon polygon;
    for (const glm::dvec3& p : corners)
        polygon.emplace_back(m[0][0] * p.x + (m[2][0] + double(view.jitter.x)) * p.z,
                             m[1][1] * p.y + (m[2][1] + double(view.jitter.y)) * p.z, p.z);
    const Polygon whole = polygon;
    for (const glm::dvec4 plane :
         {glm::dvec4(0, 0, 1, -double(view.near)), {1, 0, 1, 0}, {-1, 0, 1, 0}, {0, 1, 1, 0}, {0, -1, 1, 0}})
        polygon = clipped(polygon, plane);
    std::vector<glm::dvec2> places;
    if (polygon == whole) return places;
    for (const glm::dvec3& p : polygon) places.push_back((glm::dvec2(p) / p.z * 0.5 + 0.5) * glm::dvec2(view.width, view.height));
    return places;
}

/// A triangle of which seams are noted.
struct Noted {
    ClipSeams& seams;
    const View& view;
    std::uint32_t draw, triangle;

    void add(const glm::dvec2& at) const {
        if (at.x < 0 || at.y < 0 || at.x >= view.width || at.y >= view.height) return;
        seams.emplace(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.y), draw, triangle);
    }
    /// The pixels that the line comes nearer to than a third of a pixel: their samples may fall on either side of it.
    void add_line(const glm::dvec2& from, const glm::dvec2& to) const {
        const int steps = static_cast<int>(std::ceil(glm::length(to - from) * 4)) + 1;
        for (int i = 0; i <= steps; ++i)
            for (const glm::dvec2 aside : {glm::dvec2(-.3, -.3), {-.3, .3}, {.3, -.3}, {.3, .3}})
                add(glm::mix(from, to, double(i) / steps) + aside);
    }
};

}  // namespace

ClipSeams clip_seams(const Frame& frame) {
    ClipSeams seams;
    for (const std::uint32_t draw : opaque_draws(frame)) {
        const DrawSpace space = draw_space(frame, draw);
        for (std::uint32_t triangle = 0; triangle < triangle_count(frame, draw); ++triangle) {
            const auto corners = corners_if_cut(frame.view, view_corners(frame, space, draw, triangle));
            const Noted noted{seams, frame.view, draw, triangle};
            for (std::size_t i = 0; i < corners.size(); ++i)
                for (std::size_t j = i + 2; j < corners.size(); ++j) noted.add_line(corners[i], corners[j]);
        }
    }
    return seams;
}

}  // namespace strata::edges
