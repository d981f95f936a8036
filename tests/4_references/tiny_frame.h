// Frames small enough to know every pixel of: a view, a few triangles placed by pixel, a material.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame.h"
#include "passes/reference/image.h"

namespace strata::tiny {

/// An empty frame: the eye at the origin looks along +z; square pixels; half the height is tan_half_height at z = 1.
Frame frame(std::uint32_t width, std::uint32_t height, std::uint32_t samples = 1, double tan_half_height = 1);

/// The point at view depth z under a position of the image in pixels.
glm::dvec3 under(const Frame&, double px, double py, double z);

/// Adds a mesh of these world-space triangles (three corners each) with a material of its own, double sided, unlit, and returns
/// the draw's index.
std::uint32_t add_triangles(Frame&, std::span<const glm::dvec3> corners, AlphaMode = AlphaMode::opaque);
/// The same with shared vertices.
std::uint32_t add_mesh(Frame&, Mesh, AlphaMode = AlphaMode::opaque);
/// A quad over the pixel rectangle at depth z (or sloping: one depth per corner, clockwise from left top).
struct PixelRect {
    double left = 0, top = 0, right = 0, bottom = 0;
};
std::uint32_t add_quad(Frame&, PixelRect, double z, AlphaMode = AlphaMode::opaque);
/// The material of a draw, to change.
Material& material(Frame&, std::uint32_t draw);

/// A depth buffer that nothing fails against.
ReferenceImage no_depth(const Frame&);

/// Seeded, uniform in 0..1, the same everywhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}
    double operator()();
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    glm::dvec3 inside(double low, double high);

private:
    std::uint64_t state_;
};

}  // namespace strata::tiny
