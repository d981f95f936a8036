#include "tests/support/plain_rays.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/texture.h"
#include "capture_format/view.h"

namespace strata {
namespace {

/// Alpha of mip 0 between its four nearest texels.
double alpha_of(const Texture& texture, glm::dvec2 uv) {
    const auto texel = [&](double column, double row) {
        const auto wrapped = [&](double at, double size) {
            return texture.address == AddressMode::clamp ? std::clamp(at, 0.0, size - 1) : at - size * std::floor(at / size);
        };
        const double i = wrapped(row, texture.height) * texture.width + wrapped(column, texture.width);
        return std::to_integer<int>(texture.texels[4 * std::size_t(i) + 3]) / 255.0;
    };
    const double u = uv.x * texture.width - .5, v = uv.y * texture.height - .5, x = std::floor(u), y = std::floor(v);
    return (1 - (v - y)) * ((1 - (u - x)) * texel(x, y) + (u - x) * texel(x + 1, y)) +
           (v - y) * ((1 - (u - x)) * texel(x, y + 1) + (u - x) * texel(x + 1, y + 1));
}

bool is_mask(const PlainTriangle& triangle) { return triangle.material->alpha_mode == AlphaMode::mask; }

PlainTriangle placed(const Frame& frame, const Draw& draw, std::size_t first_index) {
    const Mesh& mesh = frame.meshes[draw.mesh];
    PlainTriangle triangle{.material = &frame.materials[draw.material]};
    const TextureUse& use = triangle.material->base_color_texture;
    if (is_mask(triangle) && use.texture != no_index) triangle.mask = &frame.textures[use.texture];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t vertex = mesh.indices[first_index + k];
        const glm::dvec3 world(draw.to_world * glm::dvec4(mesh.positions[vertex], 1));
        triangle.corners[k] = frame.view.to_view * (world - frame.view.origin);
        if (!triangle.mask) continue;
        const glm::dvec2 uv = use.uv_set == 0 ? mesh.uv0[vertex] : mesh.uv1[vertex];
        const auto& t = use.transform;
        triangle.uv[k] = {t[0] * uv.x + t[1] * uv.y + t[2], t[3] * uv.x + t[4] * uv.y + t[5]};
    }
    return triangle;
}

/// Where a ray meets the triangle: weights of its corners, all 0 where it does not.
glm::dvec3 weights(const PlainTriangle& triangle, const glm::dvec3& ray) {
    const auto& [a, b, c] = triangle.corners;
    const glm::dvec3 volumes(glm::dot(ray, glm::cross(b, c)), glm::dot(ray, glm::cross(c, a)), glm::dot(ray, glm::cross(a, b)));
    const double sum = volumes.x + volumes.y + volumes.z;
    const glm::dvec3 shares = volumes / sum;
    return sum != 0 && shares.x >= 0 && shares.y >= 0 && shares.z >= 0 ? shares : glm::dvec3(0);
}

}  // namespace

double PlainTriangle::plane_z(const glm::dvec3& ray) const {
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    return glm::dot(normal, corners[0]) / glm::dot(normal, ray);
}

PlainRays::PlainRays(const Frame& frame) : frame_(&frame), over_(std::size_t(frame.view.width) * frame.view.height) {
    find_triangles();
    for (std::size_t i = 0; i < triangles_.size(); ++i) add_to_pixels(i);
}

/// Those that face the eye or are double sided.
void PlainRays::find_triangles() {
    for (const Draw& draw : frame_->draws) {
        const Material& material = frame_->materials[draw.material];
        if (material.alpha_mode == AlphaMode::blend) continue;
        const bool mirrors = glm::determinant(frame_->view.to_view) * glm::determinant(glm::dmat3(draw.to_world)) < 0;
        for (std::size_t i = 0; i < frame_->meshes[draw.mesh].indices.size(); i += 3) {
            PlainTriangle triangle = placed(*frame_, draw, i);
            const auto& [a, b, c] = triangle.corners;
            const bool faces = (glm::dot(glm::cross(b - a, c - a), a) < 0) != mirrors;
            if (faces || material.double_sided) triangles_.push_back(triangle);
        }
    }
}

/// To those that its box on the screen touches; to all where it reaches behind the eye.
void PlainRays::add_to_pixels(std::size_t triangle) {
    const View& view = frame_->view;
    const glm::mat4& p = view.projection;
    glm::dvec2 low(0), high(view.width - 1, view.height - 1);
    const auto& corners = triangles_[triangle].corners;
    if (std::ranges::all_of(corners, [&](const glm::dvec3& c) { return c.z > double(view.near); })) {
        glm::dvec2 first(HUGE_VAL), last(-HUGE_VAL);
        for (const glm::dvec3& c : corners) {
            const glm::dvec2 ndc(c.x / c.z * double(p[0][0]) + double(p[2][0]), c.y / c.z * double(p[1][1]) + double(p[2][1]));
            const glm::dvec2 pixel = glm::floor((ndc * .5 + .5) * glm::dvec2(view.width, view.height));
            first = glm::min(first, pixel);
            last = glm::max(last, pixel);
        }
        low = glm::max(low, first);
        high = glm::min(high, last);
    }
    for (double y = low.y; y <= high.y; ++y)
        for (double x = low.x; x <= high.x; ++x)
            over_[std::size_t(y) * view.width + std::size_t(x)].push_back(static_cast<std::uint32_t>(triangle));
}

glm::dvec3 PlainRays::ray(glm::dvec2 place) const {
    const View& view = frame_->view;
    const glm::mat4& p = view.projection;
    return {(2 * place.x / view.width - 1 - double(p[2][0])) / double(p[0][0]),
            (2 * place.y / view.height - 1 - double(p[2][1])) / double(p[1][1]), 1};
}

std::vector<PlainHit> PlainRays::hits(glm::dvec2 place) const {
    std::vector<PlainHit> found;
    const glm::dvec3 along = ray(place);
    for (const std::uint32_t i : over_[std::size_t(place.y) * frame_->view.width + std::size_t(place.x)]) {
        const PlainTriangle& triangle = triangles_[i];
        const glm::dvec3 w = weights(triangle, along);
        if (w == glm::dvec3(0)) continue;
        const double z = w.x * triangle.corners[0].z + w.y * triangle.corners[1].z + w.z * triangle.corners[2].z;
        if (z < double(frame_->view.near)) continue;
        PlainHit& hit = found.emplace_back(PlainHit{.z = z, .triangle = &triangle});
        if (is_mask(triangle)) hit.alpha = double(triangle.material->base_color.w);
        if (triangle.mask)
            hit.alpha *= alpha_of(*triangle.mask, w.x * triangle.uv[0] + w.y * triangle.uv[1] + w.z * triangle.uv[2]);
    }
    return found;
}

const PlainTriangle* PlainRays::nearest(glm::dvec2 place) const {
    const std::vector<PlainHit> found = hits(place);
    const auto first = std::ranges::min_element(found, {}, &PlainHit::z);
    return first == found.end() ? nullptr : first->triangle;
}

}  // namespace strata
