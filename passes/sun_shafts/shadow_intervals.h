// Where a ray through the air is in shadow, in double: exact intervals against every caster.
//
// The shadow of a triangle in the light of a point-like sun is the triangle, swept along the sun's direction. Seen along that
// direction the ray is a straight line over flat triangles: a triangle's sides cut it at two places, and between them the ray
// crosses the triangle's plane at most once, from before it to behind.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;  // capture_format/frame.h

}  // namespace strata

namespace strata::sun_shafts {

/// Meters along a ray.
struct Interval {
    double begin = 0, end = 0;
};

/// The triangles of a frame's opaque and masked draws that cast shadows. Keeps a reference to the frame.
class ShadowVolumes {
public:
    explicit ShadowVolumes(const Frame&);
    /// The shadowed parts of the ray from the eye along a unit direction of view space, up to a length: disjoint and ascending.
    /// Masked casters: their alpha at mip 0 is looked at 64 times along each part and the changes are halved down to rounding, so
    /// holes narrower than a 64th of the part may be missed.
    std::vector<Interval> shadows(const glm::dvec3& direction, double length) const;

private:
    /// A triangle as the sun sees it: x and y across its rays, z towards it.
    struct Caster {
        std::array<glm::dvec3, 3> corners;
        glm::dvec2 low, high;
        std::uint32_t draw = 0, triangle = 0;
        bool masked = false;
    };
    /// A ray in the same space: place = per_meter * t.
    struct Ray {
        glm::dvec3 per_meter;
        glm::dvec2 low, high;
        double length = 0;
    };
    static bool shadowed(const Caster&, const Ray&, Interval&);
    void add_masked(const Caster&, const Ray&, const Interval&, std::vector<Interval>&) const;

    const Frame* frame_;
    glm::dmat3 to_sun_space_{1};
    std::vector<Caster> casters_;
};

/// What is scattered along a ray of a length, in shares of what an endless ray without shadows scatters at this density.
double scattered_share(std::span<const Interval> shadows, double length, double density);

}  // namespace strata::sun_shafts
