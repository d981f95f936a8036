// The consumer's values become Strata's.
#include "consumer/recording.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "consumer/rasterizer.h"

namespace consumer {
namespace {

strata::Mesh box(std::size_t shape) {
    const Vec3 half = half_size(shape);
    strata::Mesh mesh{.name = "box"};
    for (int corner = 0; corner < 8; ++corner)
        mesh.positions.push_back(
            {corner & 1 ? half[0] : -half[0], corner & 2 ? half[1] : -half[1], corner & 4 ? half[2] : -half[2]});
    for (const glm::vec3& position : mesh.positions) mesh.uv0.emplace_back(position.x, position.y);
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
}

strata::View view() {
    strata::View view{.width = picture_extent, .height = picture_extent};
    view.projection = strata::perspective(2 * std::atan(1 / zoom), 1, view.near);
    return view;
}

}  // namespace

strata::Texture texture_of(const std::vector<std::uint32_t>& screen) {
    strata::Texture texture{.name = "screen", .width = screen_extent, .height = screen_extent};
    texture.texels.resize(screen.size() * sizeof(std::uint32_t));
    std::memcpy(texture.texels.data(), screen.data(), texture.texels.size());
    return texture;
}

strata::Material material_of(std::size_t paint, double time) {
    const auto [red, green, blue] = paint_at(paint, time);
    strata::Material material{.name = "paint", .base_color = {red, green, blue, 1}};
    if (paint + 1 == paint_count) material.base_color_texture.texture = 0;
    return material;
}

glm::dmat4 matrix_of(const Placement& placement) {
    const auto column = [&](std::size_t i, double w) { return glm::dvec4(placement[i][0], placement[i][1], placement[i][2], w); };
    return {column(0, 0), column(1, 0), column(2, 0), column(3, 1)};
}

Recording::Recording(strata::Recorder recorder, const Crowd& crowd) : recorder_(std::move(recorder)) {
    recorder_.add_texture(texture_of(screen_at(0)));
    for (std::size_t i = 0; i < shape_count; ++i) recorder_.add_mesh(box(i));
    for (std::size_t i = 0; i < paint_count; ++i) recorder_.add_material(material_of(i, crowd.time));
    for (const Body& body : crowd.bodies)
        draws_.push_back({.mesh = static_cast<std::uint32_t>(body.shape),
                          .material = static_cast<std::uint32_t>(body.paint),
                          .to_world = matrix_of(placed(body)),
                          .mobility = strata::Mobility::moving});
}

strata::Result<void> Recording::frame(const Crowd& crowd, const std::vector<Placement>& placements, std::uint64_t index,
                                      const std::vector<std::uint32_t>& screen) {
    recorder_.begin_frame(view(), crowd.time, index, 0);
    recorder_.update_texture(0, texture_of(screen));
    for (std::size_t i = 1; i < paint_count; i += 2)
        recorder_.update_material(static_cast<std::uint32_t>(i), material_of(i, crowd.time));
    for (std::size_t i = 0; i < draws_.size(); ++i) {
        draws_[i].previous_to_world = draws_[i].to_world;
        draws_[i].to_world = matrix_of(placements[i]);
    }
    recorder_.draws(draws_);
    recorder_.environment({.direction = {0, -1, 0}, .irradiance = {3, 3, 3}}, {.sky = {.2f, .2f, .3f}}, {}, {.05f, .1f, .2f});
    return recorder_.end_frame();
}

}  // namespace consumer
