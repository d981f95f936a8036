#include "replay/probe/probe_frame.h"

#include <numbers>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"

namespace strata {
namespace {

// Fragments that hide less are drawn as light: techniques drop them otherwise (docs/algorithms/transparency.md 0.2), and with
// them the slot they take. The light is just above what is dropped and far below what is measured.
constexpr double least_alpha = 1e-5;
constexpr float faint = 2e-6f;

/// Half a strip of a pixel column: its center is covered and no neighbor's.
constexpr double strip_share = .6;

class Builder {
public:
    explicit Builder(const ProbeScene& scene) {
        frame_.view.width = static_cast<std::uint32_t>(scene.points.size());
        frame_.view.height = 1;
        frame_.view.near = static_cast<float>(scene.nearest) / 2;
        frame_.view.projection = perspective(std::numbers::pi / 2, 1, double(frame_.view.near));
        frame_.background = glm::vec3(scene.background);
        frame_.seed = scene.seed;
        Mesh& square = frame_.meshes.emplace_back();
        square.name = "square";
        square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        square.normals.assign(4, glm::vec3(0, 0, -1));
        square.indices = {0, 1, 2, 0, 2, 3};
    }

    std::uint32_t material(glm::vec4 color, glm::vec3 transmission, AlphaMode mode) {
        frame_.materials.push_back({.name = "card",
                                    .lighting_model = LightingModel::unlit,
                                    .alpha_mode = mode,
                                    .base_color = color,
                                    .transmission = transmission,
                                    .double_sided = true});
        return static_cast<std::uint32_t>(frame_.materials.size() - 1);
    }

    /// x and half_width are in the picture, which is from -1 to 1.
    void card(std::uint32_t material, double z, double x, double half_width) {
        const glm::dmat4 to_world =
            glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(x * z, 0, z)), glm::dvec3(half_width * z, 1.5 * z, 1));
        frame_.draws.push_back({.name = "card", .material = material, .to_world = to_world, .previous_to_world = to_world});
    }

    Frame take() { return std::move(frame_); }

private:
    Frame frame_;
};

void add(Builder& builder, const Fragment& fragment) {
    const double z = fragment.depth;
    if (fragment.alpha < least_alpha) {
        builder.card(builder.material(glm::vec4(faint, faint, faint, 1), {}, AlphaMode::additive), z, 0, 1.5);
        return;
    }
    // t = 1 - alpha (1 - k). Rounding must not make colored glass of gray smoke.
    glm::dvec3 k = 1. - (1. - fragment.transmittance) / fragment.alpha;
    for (int c = 0; c < 3; ++c) k[c] = k[c] < 1e-9 ? 0 : k[c];
    builder.card(builder.material(glm::vec4(0, 0, 0, fragment.alpha), k, AlphaMode::blend), z, 0, 1.5);
}

/// The probes' material.
std::uint32_t add_probe(Builder& builder, ProbeKind kind) {
    const float light = kind == ProbeKind::thin_black ? 0.f : 1.f;
    if (kind == ProbeKind::additive) return builder.material(glm::vec4(light), {}, AlphaMode::additive);
    return builder.material(glm::vec4(glm::vec3(light), thin_probe_alpha), {}, AlphaMode::blend);
}

}  // namespace

Frame probe_frame(const ProbeScene& scene) {
    Builder builder(scene);
    const std::uint32_t probe = add_probe(builder, scene.kind);
    const double pixel = 2. / static_cast<double>(scene.points.size());
    const auto add_probes = [&](std::size_t before) {
        for (std::size_t i = 0; i < scene.points.size() && scene.kind != ProbeKind::none; ++i)
            if (scene.points[i].before == before)
                builder.card(probe, scene.points[i].depth, (static_cast<double>(i) + .5) * pixel - 1, strip_share * pixel / 2);
    };
    for (std::size_t i = 0; i < scene.fragments.size(); ++i) {
        add_probes(i);
        add(builder, scene.fragments[i]);
    }
    add_probes(scene.fragments.size());
    const std::uint32_t unseen = builder.material(glm::vec4(0, 0, 0, .5f), {}, AlphaMode::blend);
    for (const double z : {scene.nearest, scene.farthest}) builder.card(unseen, z, 1e4, .1);
    return builder.take();
}

}  // namespace strata
