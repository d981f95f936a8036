// Setup in homogeneous coordinates, coverage in integers of 1/256 pixel: the products below stay under 2^63 because the guard
// band bounds positions to 65 times the image.
#include "passes/reference/raster.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "passes/reference/shade.h"

namespace strata {
namespace {

// Farther out than this in NDC, positions are clipped away; devices do the same (their guard band), at their own place.
constexpr double guard_band = 64;
// Attributes extrapolated to a pixel's center more than this many triangles away are the device's rounding, not the scene's.
constexpr double farthest_extrapolation = 8;

// A clip-space corner (x, y, w = view z) with the kind of the side that leaves it.
struct ClipCorner {
    glm::dvec3 at;
    bool decides;
};

struct Polygon {
    std::array<ClipCorner, 10> corners;
    std::uint32_t count = 0;
    void add(const ClipCorner& corner) { corners[count++] = corner; }
};

// Sutherland and Hodgman, one plane: keeps dot(plane, (x, y, w, 1)) >= 0. Cuts run from the inner corner to the outer one, so
// that two triangles sharing a side cut it at the same bits.
Polygon clipped(const Polygon& polygon, const glm::dvec4& plane) {
    Polygon result;
    const auto height = [&](const ClipCorner& c) { return glm::dot(glm::dvec3(plane), c.at) + plane.w; };
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
        const ClipCorner& from = polygon.corners[i];
        const ClipCorner& to = polygon.corners[(i + 1) % polygon.count];
        const double a = height(from), b = height(to);
        if (a >= 0) result.add(from);
        if (a >= 0 && b < 0) result.add({from.at + a / (a - b) * (to.at - from.at), true});
        if (a < 0 && b >= 0) result.add({to.at + b / (b - a) * (from.at - to.at), from.decides});
    }
    return result;
}

glm::dvec3 to_clip(const View& view, const glm::dvec3& p) {
    const glm::dmat4 m = view.projection;
    return {m[0][0] * p.x + (m[2][0] + double(view.jitter.x)) * p.z, m[1][1] * p.y + (m[2][1] + double(view.jitter.y)) * p.z,
            p.z};
}

Polygon visible_part(const View& view, const Corners& corners, std::uint8_t seams) {
    Polygon polygon;
    for (std::size_t i = 0; i < 3; ++i) polygon.add({to_clip(view, corners[i]), (seams >> i & 1) == 0});
    const std::array<glm::dvec4, 5> planes = {{{0, 0, 1, -double(view.near)},
                                               {1, 0, guard_band, 0},
                                               {-1, 0, guard_band, 0},
                                               {0, 1, guard_band, 0},
                                               {0, -1, guard_band, 0}}};
    for (const glm::dvec4& plane : planes) {
        if (polygon.count > 0) polygon = clipped(polygon, plane);
    }
    return polygon;
}

// A snapped position, and the kind of the side that leaves it.
struct SnappedCorner {
    glm::i64vec2 at;
    bool decides;
};

std::vector<SnappedCorner> snapped(const View& view, const Polygon& polygon) {
    std::vector<SnappedCorner> result;
    for (std::uint32_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3& c = polygon.corners[i].at;
        const glm::dvec2 pixel = (glm::dvec2(c) / c.z * 0.5 + 0.5) * glm::dvec2(view.width, view.height);
        const glm::i64vec2 at(glm::floor(pixel * double(snap_steps) + 0.5));
        if (!result.empty() && result.back().at == at) {
            result.back().decides = polygon.corners[i].decides;
        } else {
            result.push_back({at, polygon.corners[i].decides});
        }
    }
    while (result.size() > 1 && result.back().at == result.front().at) result.pop_back();
    return result;
}

// Twice the area, positive where the corners run clockwise on screen (y down).
std::int64_t doubled_area(std::span<const SnappedCorner> corners) {
    std::int64_t sum = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const glm::i64vec2 a = corners[i].at - corners[0].at, b = corners[i + 1].at - corners[0].at;
        sum += a.x * b.y - a.y * b.x;
    }
    return sum;
}

RasterEdge edge_between(const glm::i64vec2& from, const glm::i64vec2& to, bool decides) {
    const glm::i64vec2 d = to - from;
    RasterEdge edge{.dx = d.x, .dy = d.y, .offset = d.y * from.x - d.x * from.y};
    edge.inverse_length = 1 / std::hypot(double(d.x), double(d.y));
    edge.top_left = d.y < 0 || (d.y == 0 && d.x > 0);
    edge.decides = decides;
    return edge;
}

void set_edges(RasterTriangle& triangle, std::span<const SnappedCorner> corners, std::int64_t area) {
    const std::size_t n = corners.size();
    triangle.low = triangle.high = corners[0].at;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = (i + 1) % n;
        triangle.edges[i] = area > 0 ? edge_between(corners[i].at, corners[next].at, corners[i].decides)
                                     : edge_between(corners[next].at, corners[i].at, corners[i].decides);
        triangle.low = glm::min(triangle.low, corners[i].at);
        triangle.high = glm::max(triangle.high, corners[i].at);
    }
    triangle.edge_count = static_cast<std::uint32_t>(n);
}

enum class Cover { outside, near_miss, covered };
struct Verdict {
    Cover cover = Cover::outside;
    std::uint32_t near_sides = 0;
};

/// What decides on a verdict beside the place.
struct Sides {
    double undecided_within;
    bool seams;  ///< decide, too
};

Verdict verdict_at(const RasterTriangle& triangle, const glm::i64vec2& p, const Sides& sides) {
    Verdict verdict{Cover::covered};
    for (std::uint32_t i = 0; i < triangle.edge_count; ++i) {
        const RasterEdge& edge = triangle.edges[i];
        const std::int64_t height = edge.dx * p.y - edge.dy * p.x + edge.offset;
        const double distance = double(height) * edge.inverse_length;
        if (distance < -sides.undecided_within) return {};
        const bool decides = edge.decides || sides.seams;
        const bool inside = height > 0 || (height == 0 && edge.top_left);
        if (!inside && !decides) return {};
        if (!inside) verdict.cover = Cover::near_miss;
        verdict.near_sides += decides && distance <= sides.undecided_within;
    }
    return verdict;
}

// Pixels of the row that the polygon can touch, [x, y).
glm::i64vec2 columns(const RasterTriangle& triangle, std::int64_t y, std::int64_t width, double undecided_within) {
    const double slack = undecided_within + 1;
    double left = double(triangle.low.x) - slack, right = double(triangle.high.x) + slack;
    const double top = double(y * snap_steps), bottom = top + double(snap_steps);
    for (std::uint32_t i = 0; i < triangle.edge_count; ++i) {
        const RasterEdge& edge = triangle.edges[i];
        if (edge.dy == 0) continue;
        const double best =
            std::max(double(edge.dx) * top, double(edge.dx) * bottom) + double(edge.offset) + slack / edge.inverse_length;
        const double crossing = best / double(edge.dy);
        if (edge.dy > 0) right = std::min(right, crossing);
        if (edge.dy < 0) left = std::max(left, crossing);
    }
    const double steps = double(snap_steps), end = double(width);
    const double first = std::clamp(std::floor(left / steps), 0.0, end),
                 last = std::clamp(std::floor(right / steps) + 1, first, end);
    return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
}

bool keeps_back_faces(const Frame& frame, std::uint32_t draw) {
    const Material* material = material_of(frame, draw);
    return material == nullptr || material->double_sided;
}

}  // namespace

double depth_tolerance(const RasterPoint& point) {
    return std::abs(point.depth) * 0x1p-22 + point.depth_slope / double(snap_steps);
}

bool share_a_side(const RasterPoint& a, const RasterPoint& b) {
    return a.x == b.x && a.sample == b.sample && a.covered != b.covered && a.near_sides == 1 && b.near_sides == 1 &&
           a.draw == b.draw && a.front_facing == b.front_facing &&
           std::abs(a.depth - b.depth) <= 2 * (depth_tolerance(a) + depth_tolerance(b));
}

Raster::Raster(const Frame& frame, std::span<const std::uint32_t> draws, double undecided_within)
    : frame_(&frame), undecided_within_(undecided_within) {
    std::uint32_t ordinal = 0;
    for (const std::uint32_t draw : draws) {
        add_draw(draw, ordinal);
        ordinal += triangle_count(frame, draw);
    }
    sort_into_rows();
}

void Raster::add_draw(std::uint32_t draw, std::uint32_t first_ordinal) {
    const DrawSpace space = draw_space(*frame_, draw);
    const bool is_mesh = draw < frame_->draws.size();
    const std::vector<std::uint8_t>* seams = nullptr;
    if (is_mesh) {
        const std::uint32_t mesh = frame_->draws[draw].mesh;
        const auto found = seams_.find(mesh);
        seams = found != seams_.end() ? &found->second : &seams_.emplace(mesh, seams_of_mesh(frame_->meshes[mesh])).first->second;
    }
    const std::uint32_t count = triangle_count(*frame_, draw);
    for (std::uint32_t i = 0; i < count; ++i) {
        RasterTriangle triangle(view_corners(*frame_, space, draw, i));
        triangle.draw = draw;
        triangle.triangle = i;
        triangle.ordinal = first_ordinal + i;
        // A particle's halves 0-1-2 and 0-2-3 meet on the last side of the first and the first side of the second.
        const std::uint8_t diagonal = i % 2 == 0 ? std::uint8_t{4} : std::uint8_t{1};
        add_triangle(std::move(triangle), space, seams == nullptr ? diagonal : (*seams)[i]);
    }
}

void Raster::add_triangle(RasterTriangle triangle, const DrawSpace& space, std::uint8_t seams) {
    if (triangle.rays.volume == 0) return;
    const View& view = frame_->view;
    const std::vector<SnappedCorner> corners = snapped(view, visible_part(view, triangle.corners, seams));
    if (corners.size() < 3) return;
    const std::int64_t area = doubled_area(corners);
    if (area == 0) return;
    const bool particle = triangle.draw >= frame_->draws.size();
    triangle.front_facing = particle || (area > 0) == (space.handedness > 0);
    if (!triangle.front_facing && !keeps_back_faces(*frame_, triangle.draw)) return;
    set_edges(triangle, corners, area);
    const glm::dvec2 ray_per_pixel(2 / (double(view.width) * double(view.projection[0][0])),
                                   2 / (double(view.height) * double(view.projection[1][1])));
    triangle.depth_slope = double(view.near) / triangle.rays.volume * glm::dvec2(triangle.rays.area) * ray_per_pixel;
    triangles_.push_back(triangle);
}

void Raster::sort_into_rows() {
    const std::int64_t rows = frame_->view.height, slack = static_cast<std::int64_t>(std::ceil(undecided_within_));
    const auto first_row = [&](const RasterTriangle& t) {
        return std::clamp<std::int64_t>((t.low.y - slack) / snap_steps, 0, rows);
    };
    const auto end_row = [&](const RasterTriangle& t) {
        return t.high.y + slack < 0 ? 0 : std::clamp<std::int64_t>((t.high.y + slack) / snap_steps + 1, 0, rows);
    };
    row_begin_.assign(static_cast<std::size_t>(rows) + 1, 0);
    for (const RasterTriangle& t : triangles_) {
        for (std::int64_t y = first_row(t); y < end_row(t); ++y) ++row_begin_[static_cast<std::size_t>(y) + 1];
    }
    for (std::size_t y = 1; y < row_begin_.size(); ++y) row_begin_[y] += row_begin_[y - 1];
    in_rows_.resize(row_begin_.back());
    std::vector<std::size_t> next(row_begin_.begin(), row_begin_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        const std::int64_t end = end_row(triangles_[i]);
        for (std::int64_t y = first_row(triangles_[i]); y < end; ++y) in_rows_[next[static_cast<std::size_t>(y)]++] = i;
    }
}

void Raster::row(std::uint32_t y, RasterOptions options, const Visit& visit) const {
    for (std::size_t i = row_begin_[y]; i < row_begin_[y + 1]; ++i) {
        const RasterTriangle& triangle = triangles_[in_rows_[i]];
        const glm::i64vec2 x = columns(triangle, y, frame_->view.width, undecided_within_);
        for (std::int64_t column = x.x; column < x.y; ++column) {
            visit_pixel(triangle, {static_cast<std::uint32_t>(column), y}, options, visit);
        }
    }
}

void Raster::visit_pixel(const RasterTriangle& triangle, glm::uvec2 pixel, RasterOptions options, const Visit& visit) const {
    const View& view = frame_->view;
    for (std::uint32_t sample = 0; sample < view.samples; ++sample) {
        const glm::dvec2 at = glm::dvec2(pixel) + sample_position(view.samples, sample);
        const Verdict verdict =
            verdict_at(triangle, glm::i64vec2(at * double(snap_steps)), {undecided_within_, options.near_seams});
        if (verdict.cover == Cover::outside || (verdict.cover == Cover::near_miss && !options.near_misses)) continue;
        const glm::dvec3 sample_ray = pixel_ray(*frame_, at.x, at.y);
        RasterPoint point{.x = pixel.x, .y = pixel.y, .sample = sample, .draw = triangle.draw, .triangle = triangle.triangle};
        point.depth = double(view.near) * triangle.rays.inverse_z(sample_ray);
        point.depth_slope = std::max(std::abs(triangle.depth_slope.x), std::abs(triangle.depth_slope.y));
        point.front_facing = triangle.front_facing;
        point.covered = verdict.cover == Cover::covered;
        point.undecided = verdict.near_sides > 0;
        point.near_sides = verdict.near_sides;
        point.barycentric = triangle.rays.barycentric(sample_ray);
        if (options.shade_at == ShadeAt::pixel_center && view.samples > 1) {
            const glm::dvec3 center_ray = pixel_ray(*frame_, pixel.x + 0.5, pixel.y + 0.5);
            point.barycentric = triangle.rays.barycentric(center_ray);
            const glm::dvec3 reach = glm::abs(point.barycentric);
            if (!(std::max({reach.x, reach.y, reach.z}) < farthest_extrapolation)) point.undecided = true;
        }
        visit(point, triangle);
    }
}

}  // namespace strata
