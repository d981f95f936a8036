// The truth of area lights: radiance times BRDF times cosine, integrated over the emitter's visible surface piece by piece. Every
// piece is a smooth map from the unit square; what is hidden behind the emitter's own curve is not on it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture_format/light_types.h"
#include "passes/reference/brdf.h"
#include "passes/reference/cubature.h"
#include "passes/reference/directions.h"
#include "passes/reference/placed_light.h"

namespace strata {
namespace {

using glm::dvec2, glm::dvec3;
using std::numbers::pi;
// Lobes wider than this need no search for their peak.
constexpr double wide_lobe = 0.25;

struct EmitterPoint {
    dvec3 to;           ///< from the surface, meters
    double weight = 0;  ///< solid angle per area of the unit square
    dvec2 place{0};     ///< on the picture, -1 to 1
};
using Piece = std::function<EmitterPoint(dvec2)>;

// Solid angle of a surface element of this area and normal.
double solid_angle(const dvec3& to, const dvec3& normal, double area) {
    const double squared = glm::dot(to, to);
    return std::max(0.0, -glm::dot(to, normal)) * area / (squared * std::sqrt(squared));
}

Piece emitting_rectangle(const PlacedLight& at) {
    const dvec3 u = at.axis_u * double(at.light->half_extent.x), v = at.axis_v * double(at.light->half_extent.y);
    return [=, offset = at.offset, normal = at.direction](dvec2 p) {
        const dvec2 place = 2.0 * p - 1.0;
        const dvec3 to = offset + u * place.x + v * place.y;
        return EmitterPoint{to, solid_angle(to, normal, 4 * glm::length(u) * glm::length(v)), place};
    };
}

Piece emitting_disc(const PlacedLight& at) {
    const double radius = double(at.light->source_radius);
    const auto [across, up] = perpendiculars(at.direction);
    return [=, x = across, y = up, offset = at.offset, normal = at.direction](dvec2 p) {
        const double angle = 2 * pi * p.y;
        const dvec3 to = offset + radius * p.x * (x * std::cos(angle) + y * std::sin(angle));
        return EmitterPoint{to, solid_angle(to, normal, 2 * pi * radius * radius * p.x)};
    };
}

// The cap of directions that a sphere covers.
Piece emitting_sphere(const PlacedLight& at, const dvec3& normal) {
    const double radius = double(at.light->source_radius), d = std::max(glm::length(at.offset), 1e-6);
    const dvec3 axis = d > 1e-6 ? at.offset / d : normal;
    const double share = std::min(1.0, radius * radius / (d * d)), cap = share / (1 + std::sqrt(1 - share));  // 1 - cos
    const auto [across, up] = perpendiculars(axis);
    return [=, x = across, y = up](dvec2 p) {
        const double angle = 2 * pi * p.y, cosine = 1 - cap * p.x, sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
        const double near = d * cosine - std::sqrt(std::max(0.0, radius * radius - d * d * sine * sine));
        const dvec3 direction = axis * cosine + (x * std::cos(angle) + y * std::sin(angle)) * sine;
        return EmitterPoint{direction * near, 2 * pi * cap};
    };
}

/// A tube's axes around itself: along it, towards the surface, and across.
struct TubeFrame {
    dvec3 along, towards, across;
    double radius, half_length;
    double away;  ///< of the surface from the axis
};

TubeFrame tube_frame(const PlacedLight& at) {
    TubeFrame frame{at.axis_u, {}, {}, double(at.light->source_radius), double(at.light->half_extent.x), 0};
    const dvec3 towards = frame.along * glm::dot(at.offset, frame.along) - at.offset;
    frame.away = glm::length(towards);
    frame.towards = frame.away > 1e-9 ? towards / frame.away : perpendiculars(frame.along)[0];
    frame.across = glm::cross(frame.along, frame.towards);
    return frame;
}

Piece tube_side(const PlacedLight& at, const TubeFrame& tube) {
    const double widest = std::acos(tube.radius / tube.away);
    return [=, offset = at.offset](dvec2 p) {
        const double angle = widest * (2 * p.y - 1);
        const dvec3 normal = tube.towards * std::cos(angle) + tube.across * std::sin(angle);
        const dvec3 to = offset + tube.along * (tube.half_length * (2 * p.x - 1)) + tube.radius * normal;
        return EmitterPoint{to, solid_angle(to, normal, 4 * tube.half_length * widest * tube.radius)};
    };
}

/// A part of the half sphere at an end: from one angle off the tube's axis to another.
struct CapPart {
    dvec3 center, axis;
    double begin, end;
};

Piece tube_cap(const TubeFrame& tube, const CapPart& part) {
    const double height = glm::dot(-part.center, part.axis), r = tube.radius;
    return [=](dvec2 p) {
        // Its width vanishes or closes like a square root at both ends: steps that vanish there, too, make it smooth.
        const double t = p.x * p.x * (3 - 2 * p.x), slope = 6 * p.x * (1 - p.x);
        const double polar = part.begin + (part.end - part.begin) * t, c = std::cos(polar), s = std::sin(polar);
        const double cosine = std::clamp((r - height * c) / std::max(tube.away * s, 1e-12), -1.0, 1.0);
        const double widest = std::acos(cosine), angle = widest * (2 * p.y - 1);
        const dvec3 normal = part.axis * c + (tube.towards * std::cos(angle) + tube.across * std::sin(angle)) * s;
        const dvec3 to = part.center + r * normal;
        return EmitterPoint{to, solid_angle(to, normal, r * r * s * 2 * widest * (part.end - part.begin) * slope)};
    };
}

// A normal at the angle b off the axis and turned towards the surface sees it where D cos(b - b0) > r; turned away, where
// D cos(b + b0) > r: up to there the whole ring does.
void add_cap(const TubeFrame& tube, const dvec3& center, const dvec3& axis, std::vector<Piece>& pieces) {
    const double height = glm::dot(-center, axis), d = std::hypot(height, tube.away);
    if (d <= tube.radius) return;
    const double tilt = std::atan2(tube.away, height), reach = std::acos(tube.radius / d);
    const double begin = std::clamp(tilt - reach, 0.0, pi / 2), end = std::clamp(tilt + reach, 0.0, pi / 2);
    const double whole = std::clamp(reach - tilt, begin, end);
    if (whole > begin) pieces.push_back(tube_cap(tube, {center, axis, begin, whole}));
    if (end > whole) pieces.push_back(tube_cap(tube, {center, axis, whole, end}));
}

std::vector<Piece> pieces_of(const PlacedLight& at, const dvec3& normal) {
    switch (facts_of(at.light->type).shape) {
        case LightShape::sphere:
            return {emitting_sphere(at, normal)};
        case LightShape::disc:
            return {emitting_disc(at)};
        case LightShape::rectangle:
            return {emitting_rectangle(at)};
        default:
            break;
    }
    std::vector<Piece> pieces;
    const TubeFrame tube = tube_frame(at);
    if (tube.away > tube.radius && tube.half_length > 0) pieces.push_back(tube_side(at, tube));
    for (const double side : {-1.0, 1.0})
        add_cap(tube, at.offset + side * tube.half_length * tube.along, side * tube.along, pieces);
    return pieces;
}

// Where the piece comes nearest to a direction: a coarse grid, then steps that halve.
dvec2 nearest_to(const Piece& piece, const dvec3& direction) {
    const auto score = [&](const dvec2& p) { return glm::dot(glm::normalize(piece(p).to), direction); };
    dvec2 best(0.5);
    for (int i = 0; i < 81; ++i) {
        const dvec2 p = dvec2(i % 9, i / 9) / 8.0;
        if (score(p) > score(best)) best = p;
    }
    for (double step = 1.0 / 16; step > 1e-4; step *= 0.5) {
        const dvec2 from = best;
        for (int i = 0; i < 9; ++i) {
            const dvec2 p = glm::clamp(from + step * dvec2(i % 3 - 1, i / 3 - 1), 0.0, 1.0);
            if (score(p) > score(best)) best = p;
        }
    }
    return best;
}

}  // namespace

glm::dvec3 exact_reflected_area(const SurfacePoint& surface, const PlacedLight& at, const ExactOptions& options) {
    const dvec3 v = glm::normalize(-surface.position), mirrored = glm::reflect(-v, surface.normal);
    const double lobe = std::max(surface.roughness * surface.roughness, smallest_lobe);
    const bool peaks = surface.model != LightingModel::lambert && lobe < wide_lobe;
    dvec3 sum(0);
    for (const Piece& piece : pieces_of(at, surface.normal)) {
        const auto reflected_from = [&](dvec2 p) {
            const EmitterPoint point = piece(p);
            const dvec3 l = glm::normalize(point.to);
            const double cosine = brdf_cosine(surface, l);
            if (cosine <= 0 || point.weight <= 0) return dvec3(0);
            const double seen = options.visible ? options.visible(glm::dvec4(surface.position + point.to, 1)) : 1;
            if (seen == 0) return dvec3(0);
            return brdf(surface, l, v) * emitted_color(at, point.place, 0) * (seen * cosine * point.weight);
        };
        // Down to cells as wide as the lobe on a piece that is a radian wide; at least to where the horizon may leave a corner.
        const int levels = peaks ? static_cast<int>(std::ceil(std::log2(1 / lobe))) : 2;
        sum += integral(reflected_from, {.tolerance = options.tolerance,
                                         .most = options.most,
                                         .peak = nearest_to(piece, peaks ? mirrored : surface.normal),
                                         .levels = std::max(levels, 2)});
    }
    return sum * dvec3(at.light->intensity);
}

}  // namespace strata
