// Rays through a frame's opaque and masked triangles, written apart from passes/reference: for tests of truths.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

struct Frame;     // capture_format/frame.h
struct Material;  // capture_format/frame/material.h
struct Texture;   // capture_format/frame/texture.h

/// A triangle in view space, with what its mask needs.
struct PlainTriangle {
    std::array<glm::dvec3, 3> corners;
    std::array<glm::dvec2, 3> uv{};
    const Material* material = nullptr;
    const Texture* mask = nullptr;  ///< null where alpha is the material's alone

    /// View depth of its plane along a ray with z = 1.
    double plane_z(const glm::dvec3& ray) const;
};

struct PlainHit {
    double z = 0, alpha = 1;  ///< bilinear in mip 0
    const PlainTriangle* triangle = nullptr;
};

/// Places are in pixels. Signed volumes; a triangle is looked for where its box on the screen is. Vertex colors, jitter and
/// textures of other formats than 8 bits are left out.
class PlainRays {
public:
    explicit PlainRays(const Frame&);
    glm::dvec3 ray(glm::dvec2 place) const;
    /// Every triangle under the place, in no order.
    std::vector<PlainHit> hits(glm::dvec2 place) const;
    /// The nearest triangle, masks taken for solid; null: the sky.
    const PlainTriangle* nearest(glm::dvec2 place) const;

private:
    void find_triangles();
    void add_to_pixels(std::size_t triangle);

    const Frame* frame_;
    std::vector<PlainTriangle> triangles_;
    std::vector<std::vector<std::uint32_t>> over_;  ///< by pixel
};

}  // namespace strata
