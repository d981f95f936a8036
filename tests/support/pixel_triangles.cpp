#include "tests/support/pixel_triangles.h"

namespace strata {
namespace {

/// The point at a view depth under a place of the picture, of an eye at the origin that looks along +z.
glm::vec3 under(const View& view, const glm::dvec3& corner) {
    const double x = (2 * corner.x / view.width - 1) / double(view.projection[0][0]);
    const double y = (1 - 2 * corner.y / view.height) / -double(view.projection[1][1]);
    return {corner.z * x, corner.z * y, corner.z};
}

}  // namespace

PixelTriangle whole_picture(glm::uvec2 extent, double depth, glm::vec3 color) { return right_of(extent, -8, depth, color); }

PixelTriangle right_of(glm::uvec2 extent, double column, double depth, glm::vec3 color) {
    const double far_right = column + 3 * (extent.x + 16.0), middle = extent.y / 2.0, reach = 2 * (extent.y + 16.0);
    return {.corners = {glm::dvec3(column, middle - reach, depth), {column, middle + reach, depth}, {far_right, middle, depth}},
            .color = color};
}

Frame frame_of_triangles(glm::uvec2 extent, std::uint32_t samples, std::span<const PixelTriangle> triangles) {
    Frame frame;
    View& view = frame.view;
    view.width = extent.x;
    view.height = extent.y;
    view.samples = samples;
    view.near = 0.125f;
    view.projection = perspective(1, double(extent.x) / extent.y, view.near);
    for (const PixelTriangle& triangle : triangles) {
        Mesh mesh;
        mesh.name = "triangle";
        mesh.indices = {0, 1, 2};
        for (const glm::dvec3& corner : triangle.corners) mesh.positions.push_back(under(view, corner));
        const auto place = static_cast<std::uint32_t>(frame.meshes.size());
        frame.meshes.push_back(mesh);
        Material paint;
        paint.name = "paint";
        paint.lighting_model = LightingModel::lambert;
        paint.base_color = glm::vec4(triangle.color, 1);
        paint.emissive = triangle.emissive;
        paint.double_sided = true;
        frame.materials.push_back(paint);
        Draw draw;
        draw.mesh = draw.material = place;
        frame.draws.push_back(draw);
    }
    Light light;
    light.name = "sun";
    light.type = LightType::directional;
    light.direction = {0, 0, 1};
    frame.lights = {light};
    return frame;
}

}  // namespace strata
