// Frames placed by pixel: positions come from the projection's own inverse, written out here a second time.
#include "tests/4_references/tiny_frame.h"

#include <numeric>
#include <utility>

namespace strata::tiny {

Frame frame(std::uint32_t width, std::uint32_t height, std::uint32_t samples, double tan_half_height) {
    Frame result;
    View& view = result.view;
    view.width = width;
    view.height = height;
    view.samples = samples;
    view.near = 0.125f;
    view.projection = glm::mat4(0);
    view.projection[0][0] = static_cast<float>(double(height) / (tan_half_height * double(width)));
    view.projection[1][1] = static_cast<float>(-1 / tan_half_height);
    view.projection[2][3] = 1;
    view.projection[3][2] = view.near;
    return result;
}

glm::dvec3 under(const Frame& f, double px, double py, double z) {
    const View& view = f.view;
    const double x = (2 * px / view.width - 1) / double(view.projection[0][0]);
    const double y = (2 * py / view.height - 1) / double(view.projection[1][1]);
    return {x * z, y * z, z};
}

std::uint32_t add_mesh(Frame& f, Mesh mesh, AlphaMode mode) {
    Material m;
    m.alpha_mode = mode;
    m.lighting_model = LightingModel::unlit;
    m.double_sided = true;
    f.materials.push_back(m);
    f.meshes.push_back(std::move(mesh));
    Draw draw;
    draw.mesh = static_cast<std::uint32_t>(f.meshes.size() - 1);
    draw.material = static_cast<std::uint32_t>(f.materials.size() - 1);
    f.draws.push_back(draw);
    return static_cast<std::uint32_t>(f.draws.size() - 1);
}

std::uint32_t add_triangles(Frame& f, std::span<const glm::dvec3> corners, AlphaMode mode) {
    Mesh mesh;
    for (const glm::dvec3& corner : corners) mesh.positions.emplace_back(corner);
    mesh.indices.resize(corners.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    return add_mesh(f, std::move(mesh), mode);
}

std::uint32_t add_quad(Frame& f, PixelRect r, double z, AlphaMode mode) {
    Mesh mesh;
    mesh.positions = {under(f, r.left, r.top, z), under(f, r.right, r.top, z), under(f, r.right, r.bottom, z),
                      under(f, r.left, r.bottom, z)};
    mesh.uv0 = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return add_mesh(f, std::move(mesh), mode);
}

Material& material(Frame& f, std::uint32_t draw) { return f.materials[f.draws[draw].material]; }

ReferenceImage no_depth(const Frame& f) { return ReferenceImage(f.view.width, f.view.height, f.view.samples); }

// SplitMix64 (Steele, Lea and Flood 2014).
double Random::operator()() {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

glm::dvec3 Random::inside(double low, double high) {
    const double x = between(low, high), y = between(low, high);
    return {x, y, between(low, high)};
}

}  // namespace strata::tiny
