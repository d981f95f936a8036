#include "capture_format/import/gltf_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "capture_format/import/gltf_materials.h"

namespace strata::gltf {
namespace {

glm::dvec3 vector3(const std::vector<double>& values, glm::dvec3 fallback) {
    return values.size() == 3 ? glm::dvec3(values[0], values[1], values[2]) : fallback;
}

glm::dmat4 local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::dmat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];  // both column-major
        return matrix;
    }
    glm::dmat4 transform = glm::translate(glm::dmat4(1), vector3(node.translation, glm::dvec3(0)));
    if (node.rotation.size() == 4) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (glm::length(rotation) > 0) transform *= glm::mat4_cast(glm::normalize(rotation));
    }
    return glm::scale(transform, vector3(node.scale, glm::dvec3(1)));
}

/// The nodes a scene starts from. A model without scenes shows every node that is nobody's child.
Result<std::vector<int>> roots(const tinygltf::Model& model) {
    if (!model.scenes.empty()) {
        const auto scene = static_cast<std::size_t>(std::max(model.defaultScene, 0));
        if (scene >= model.scenes.size()) return fail(Fault::bad_input, "scene {} does not exist", scene);
        return model.scenes[scene].nodes;
    }
    std::vector<bool> is_child(model.nodes.size());
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            if (child >= 0 && static_cast<std::size_t>(child) < is_child.size()) is_child[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        if (!is_child[i]) result.push_back(static_cast<int>(i));
    }
    return result;
}

/// glTF lights without a range reach infinitely far; ours end where less than this irradiance, in W/m^2, is left.
constexpr double unnoticed_irradiance = 1.0 / 256;
/// Half angles from here on are no spot: the tangent of a shadow map's frustum grows without bound.
constexpr double widest_spot = 0.49 * std::numbers::pi;

glm::vec3 any_perpendicular(glm::vec3 axis) {
    return glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
}

Light convert_light(const tinygltf::Light& source, const glm::dmat4& to_world) {
    Light light;
    light.name = source.name;
    light.position = glm::dvec3(to_world[3]);
    const glm::dvec3 forward = -glm::dvec3(to_world[2]);
    if (glm::length(forward) > 0) light.direction = glm::vec3(glm::normalize(forward));
    light.axis_u = any_perpendicular(light.direction);
    const glm::dvec3 intensity = vector3(source.color, glm::dvec3(1)) * source.intensity;
    light.intensity = glm::vec3(intensity);
    const double brightest = std::max({intensity.x, intensity.y, intensity.z, 1e-6});
    light.range = static_cast<float>(source.range > 0 ? source.range : std::sqrt(brightest / unnoticed_irradiance));
    if (source.type == "directional") light.type = LightType::directional;
    if (source.type == "spot") {
        light.type = LightType::round_spot;
        const double outer = std::clamp(source.spot.outerConeAngle, 1e-3, widest_spot);
        light.outer_angle = static_cast<float>(outer);
        light.inner_angle = static_cast<float>(std::clamp(source.spot.innerConeAngle, 0.0, outer));
        light.shadow.casts = true;
    }
    return light;
}

}  // namespace

Result<std::vector<PlacedNode>> place_nodes(const tinygltf::Model& model) {
    const auto start = roots(model);
    if (!start) return start.error();
    struct Pending {
        int node;
        glm::dmat4 parent;
    };
    std::vector<Pending> pending;
    for (auto root = start->rbegin(); root != start->rend(); ++root) pending.push_back({*root, glm::dmat4(1)});
    std::vector<bool> reached(model.nodes.size());
    std::vector<PlacedNode> placed;
    while (!pending.empty()) {  // a stack, not recursion: a file may nest a million nodes
        const Pending next = pending.back();
        pending.pop_back();
        if (next.node < 0 || static_cast<std::size_t>(next.node) >= model.nodes.size()) {
            return fail(Fault::bad_input, "node {} does not exist (there are {})", next.node, model.nodes.size());
        }
        const auto index = static_cast<std::size_t>(next.node);
        if (reached[index]) return fail(Fault::bad_input, "node {} is reached twice; nodes must be a tree", next.node);
        reached[index] = true;
        const tinygltf::Node& node = model.nodes[index];
        placed.push_back({&node, next.parent * local_transform(node)});
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
            pending.push_back({*child, placed.back().to_world});
        }
    }
    return placed;
}

View look_along(glm::dvec3 eye, glm::dvec3 forward, glm::dvec3 up) {
    forward = glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    View view;
    view.origin = eye;
    view.to_view = glm::transpose(glm::dmat3(right, glm::cross(right, forward), forward));
    return view;
}

namespace {

/// A view that has been turned until what it sees lies in its middle, and what it then sees: x / z and y / z.
struct Aim {
    View view;
    glm::dvec2 low{0}, high{0};
    double nearest = 0;

    bool fits(double slope, double width_over_height) const {
        const glm::dvec2 widest = glm::max(-low, high);
        return nearest > 0 && widest.x <= slope * width_over_height && widest.y <= slope;
    }
};

Aim aimed_view(std::span<const glm::dvec3> points, glm::dvec3 eye, glm::dvec3 forward) {
    Aim aim;
    for (int turn = 0; turn < 4; ++turn) {  // the middle moves a little as the view turns; it has settled after two or three
        aim = {look_along(eye, forward, {0, 1, 0}), glm::dvec2(1e300), glm::dvec2(-1e300), 1e300};
        for (const glm::dvec3& point : points) {
            const glm::dvec3 p = aim.view.to_view * (point - eye);
            aim.nearest = std::min(aim.nearest, p.z);
            aim.low = glm::min(aim.low, glm::dvec2(p) / p.z);
            aim.high = glm::max(aim.high, glm::dvec2(p) / p.z);
        }
        if (!(aim.nearest > 0)) return aim;
        const glm::dvec2 middle = (aim.low + aim.high) * 0.5;
        if (turn < 3) forward = glm::transpose(aim.view.to_view) * glm::normalize(glm::dvec3(middle, 1));
    }
    return aim;
}

}  // namespace

View framing_view(std::span<const glm::dvec3> points, const Bounds& bounds, const GltfOptions& options) {
    constexpr double vertical_fov = 0.7;  // radians, near that of a 35 mm lens on 35 mm film
    constexpr double margin = 1.05;
    const double aspect = static_cast<double>(options.width) / options.height;
    const double slope = std::tan(vertical_fov / 2) / margin;
    const double azimuth = glm::radians(options.azimuth), elevation = glm::radians(options.elevation);
    const glm::dvec3 towards_eye(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                                 std::cos(azimuth) * std::cos(elevation));
    // From the far distance every point is inside a sphere that fits; then as near as all points still fit.
    double near_end = 0, far_end = 1e-6 + bounds.radius() * (1 + 1 / std::min(slope, slope * aspect));
    for (int halving = 0; halving < 20; ++halving) {
        const double distance = (near_end + far_end) / 2;
        const bool fits = aimed_view(points, bounds.center() + towards_eye * distance, -towards_eye).fits(slope, aspect);
        (fits ? far_end : near_end) = distance;
    }
    const Aim aim = aimed_view(points, bounds.center() + towards_eye * far_end, -towards_eye);
    View view = aim.view;
    view.near = static_cast<float>(std::clamp(aim.nearest * 0.5, far_end * 1e-6, 0.1));
    view.projection = perspective(vertical_fov, aspect, static_cast<double>(view.near));
    return view;
}

double white_radiance(const Frame& frame, const Bounds& scene) {
    const auto brightest = [](glm::vec3 color) { return static_cast<double>(std::max({color.x, color.y, color.z})); };
    double irradiance = brightest(frame.sun.irradiance);
    for (const Light& light : frame.lights) {
        const double distance = std::max(glm::length(light.position - scene.center()), scene.radius() * 0.5);
        const bool reaches = light.type == LightType::directional || distance < static_cast<double>(light.range);
        const double falloff = light.type == LightType::directional ? 1 : distance * distance;
        if (reaches) irradiance += brightest(light.intensity) / falloff;
    }
    return irradiance / std::numbers::pi;
}

std::vector<std::string> add_lights(Frame& frame, const tinygltf::Model& model, const std::vector<PlacedNode>& nodes) {
    std::vector<std::string> warnings;
    bool has_sun = false;
    for (const PlacedNode& placed : nodes) {
        const double index = number_in(placed.node->extensions, "KHR_lights_punctual", "light", -1);
        if (index < 0) continue;
        if (index >= static_cast<double>(model.lights.size())) {
            warnings.push_back(fmt::format("node '{}' has light {}, which does not exist", placed.node->name, index));
            continue;
        }
        const Light light = convert_light(model.lights[static_cast<std::size_t>(index)], placed.to_world);
        if (light.type == LightType::directional && !has_sun) {
            has_sun = true;
            frame.sun.direction = light.direction;
            frame.sun.irradiance = light.intensity;
            frame.sun.shadow.casts = true;
        } else {
            frame.lights.push_back(light);
        }
    }
    return warnings;
}

}  // namespace strata::gltf
