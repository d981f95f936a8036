// Meshes and particles as vertices, indices, draws and indirect commands. Meshes are stored once however many draws use them;
// particles become camera-facing quads in view space, in the corner order that passes/reference/fragments.h states. On the device
// a vertex takes 12 bytes and what else its mesh has: normal 12, tangent 16, uv 8 each, color 16; a particle takes 84. An index
// takes 4, and 4 more where a transparent draw has it; a particle has 12 of them, 6 in submission order, 6 from back to front,
// and 24 bytes more.
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/particles.h"
#include "passes/scene/object_order.h"
#include "passes/scene/scene_facts.h"
#include "passes/scene/still_view.h"
#include "passes/scene/view_space.h"
#include "replay/scene/numbering.h"
#include "replay/scene/scene_records.h"

namespace strata {
namespace {

/// Where a mesh lies in the buffers: see DrawRecord.
struct MeshRange {
    std::uint32_t first_index = 0, index_count = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t normals = no_index, tangents = no_index, uv0 = no_index, uv1 = no_index, colors = no_index;
};

/// Appends what a mesh has: its first place.
template <typename T>
std::uint32_t append(const std::vector<T>& of_mesh, std::vector<T>& all) {
    const auto first = static_cast<std::uint32_t>(all.size());
    all.insert(all.end(), of_mesh.begin(), of_mesh.end());
    return first;
}

/// The same of an attribute; no_index where the mesh does not have it.
template <typename T>
std::uint32_t append_attribute(const std::vector<T>& of_mesh, std::vector<T>& all) {
    return of_mesh.empty() ? no_index : append(of_mesh, all);
}

MeshRange add_mesh(const Mesh& mesh, SceneRecords& scene) {
    return {.first_index = append(mesh.indices, scene.indices),
            .index_count = static_cast<std::uint32_t>(mesh.indices.size()),
            .vertex_offset = static_cast<std::int32_t>(append(mesh.positions, scene.positions)),
            .normals = append_attribute(mesh.normals, scene.normals),
            .tangents = append_attribute(mesh.tangents, scene.tangents),
            .uv0 = append_attribute(mesh.uv0, scene.uvs),
            .uv1 = append_attribute(mesh.uv1, scene.uvs),
            .colors = append_attribute(mesh.colors, scene.colors)};
}

/// The same triangles turned around. View space is left-handed, so a transform into it that mirrors keeps a right-handed
/// object's front counter-clockwise on screen; for one that does not mirror the winding is turned here.
std::uint32_t add_reversed(const MeshRange& range, SceneRecords& scene) {
    const auto first = static_cast<std::uint32_t>(scene.indices.size());
    for (std::uint32_t i = 0; i + 2 < range.index_count; i += 3)
        for (const std::uint32_t corner : {0u, 2u, 1u}) scene.indices.push_back(scene.indices[range.first_index + i + corner]);
    return first;
}

void add_particle(const Frame& frame, const Particle& p, SceneRecords& scene) {
    const glm::dvec3 center = in_view_space(frame.view, p.center);
    const double c = std::cos(double(p.rotation)), s = std::sin(double(p.rotation));
    const auto corner = [&](double x, double y) {
        const glm::dvec2 turned(c * x - s * y, s * x + c * y);
        return glm::vec2(glm::dvec2(center) + turned * double(p.size));
    };
    scene.particle_bottoms.emplace_back(corner(-1, -1), corner(1, -1));
    scene.particle_tops.emplace_back(corner(1, 1), corner(-1, 1));
    scene.particle_depths.push_back(float(center.z));
    scene.particle_uvs.push_back(p.uv_frame);
    const bool is_at_a_depth = std::isfinite(p.depth_offset);  // or it shows nothing
    scene.particle_glows.push_back(is_at_a_depth ? glm::vec4(p.emissive, p.depth_offset) : glm::vec4(0));
    scene.colors.push_back(is_at_a_depth ? glm::vec4(p.color, p.alpha) : glm::vec4(0));
}

/// Two triangles per particle, in the given order.
std::uint32_t add_quads(std::span<const std::uint32_t> order, SceneRecords& scene) {
    const auto first = static_cast<std::uint32_t>(scene.indices.size());
    for (const std::uint32_t particle : order)
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) scene.indices.push_back(particle * 4 + corner);
    return first;
}

/// A flattened object has no inverse; its normals come from the matrix itself.
bool is_flat(const glm::dmat4& to_view) { return std::abs(glm::determinant(glm::dmat3(to_view))) < 1e-30; }

/// See DrawRecord::motion: of the object alone, because the camera of the frame before is not recorded.
glm::dmat4 motion_in_view(const Draw& draw, const glm::dmat4& view) {
    glm::dmat4 moved = view * (draw.to_world - draw.previous_to_world);
    if (moved == glm::dmat4(0)) return moved;
    const glm::dmat4 to_view = view * draw.to_world;
    if (!is_flat(to_view)) return moved * glm::inverse(to_view);
    moved[0] = moved[1] = moved[2] = glm::dvec4(0);
    return moved;  // as its origin has
}

glm::dmat4 to_view_space(const View& view) { return glm::translate(glm::dmat4(view.to_view), -view.origin); }

glm::dmat3 of_normals(const glm::dmat4& to_view) {
    const glm::dmat3 linear(to_view);
    return is_flat(to_view) ? linear : glm::transpose(glm::inverse(linear));
}

DrawRecord draw_record(const Frame& frame, const Draw& draw, const BoundingSphere& bound, const MeshRange& mesh) {
    const glm::dmat4 view = to_view_space(frame.view), to_view = view * draw.to_world;
    return {
        .to_view = glm::mat4(to_view),
        .normal_to_view = glm::mat3(of_normals(to_view)),
        .material = draw.material,
        .soft_fade = 0,
        .layer = draw.layer,
        .bound_center = glm::vec3(bound.center),
        .bound_radius = float(bound.radius),
        .motion = glm::mat4(motion_in_view(draw, view)),
        .normals = mesh.normals,
        .tangents = mesh.tangents,
        .uv0 = mesh.uv0,
        .uv1 = mesh.uv1,
        .colors = mesh.colors,
        .first_particle = no_index,
    };
}

/// Of an emitter whose particles are the next to be added.
DrawRecord emitter_record(const Frame& frame, std::size_t index, const SceneRecords& scene) {
    const Emitter& emitter = frame.emitters[index];
    return {
        .to_view = glm::mat4(1),
        .normal_to_view = glm::mat3(1),
        .material = static_cast<uint>(frame.materials.size() + index),
        .soft_fade = emitter.soft_depth_fade,
        .layer = emitter.layer,
        .bound_center = glm::vec3(0),
        .bound_radius = 0,
        .motion = glm::mat4(0),  // particles have neither names nor velocities
        .normals = no_index,
        .tangents = no_index,
        .uv0 = no_index,
        .uv1 = no_index,
        .colors = static_cast<uint>(scene.colors.size()),
        .first_particle = static_cast<uint>(scene.particle_depths.size()),
    };
}

/// Appends one command per listed draw.
CommandRange add_commands(std::span<const std::uint32_t> listed, std::span<const DrawCommand> of_draw, SceneRecords& scene) {
    const CommandRange range{static_cast<std::uint32_t>(scene.commands.size()), static_cast<std::uint32_t>(listed.size())};
    for (const std::uint32_t draw : listed) scene.commands.push_back(of_draw[draw]);
    return range;
}

/// The listed draws over places, which those of one range of indices share.
std::vector<DrawCommand> numbered(std::vector<DrawCommand> commands, std::span<const std::uint32_t> listed, SceneRecords& scene) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> first_places;  // by the range's first and its count
    for (const std::uint32_t draw : listed) {
        DrawCommand& command = commands[draw];
        const auto [place, is_new] = first_places.try_emplace({command.first_index, command.index_count});
        if (is_new) {
            place->second = static_cast<std::uint32_t>(scene.places.size());
            add_places(scene.indices, command.first_index, command.index_count, scene.places);
        }
        command.first_index = place->second;
        command.vertex_offset = 0;
    }
    return commands;
}

/// As VkDrawIndirectCommand in the same 20 bytes: the first vertex is the first place in the list of indices.
std::vector<DrawCommand> not_indexed(std::vector<DrawCommand> commands) {
    for (DrawCommand& command : commands)
        command.vertex_offset = static_cast<std::int32_t>(std::exchange(command.first_instance, 0u));
    return commands;
}

}  // namespace

void add_geometry(const SceneFacts& facts, SceneRecords& scene) {
    const Frame& frame = facts.frame();
    std::vector<MeshRange> meshes;
    for (const Mesh& mesh : frame.meshes) meshes.push_back(add_mesh(mesh, scene));

    std::vector<DrawCommand> submitted, sorted;
    std::vector<std::uint32_t> reversed(meshes.size(), no_index);
    for (std::uint32_t i = 0; i < frame.draws.size(); ++i) {
        const Draw& draw = frame.draws[i];
        const MeshRange& range = meshes[draw.mesh];
        std::uint32_t first = range.first_index;
        if (glm::determinant(frame.view.to_view * glm::dmat3(draw.to_world)) > 0) {
            if (reversed[draw.mesh] == no_index) reversed[draw.mesh] = add_reversed(range, scene);
            first = reversed[draw.mesh];
        }
        scene.draws.push_back(draw_record(frame, draw, facts.bounds().spheres[i], range));
        submitted.push_back({range.index_count, 1, first, range.vertex_offset, i});
    }
    sorted = submitted;
    for (std::size_t e = 0; e < frame.emitters.size(); ++e) {
        const Emitter& emitter = frame.emitters[e];
        scene.draws.push_back(emitter_record(frame, e, scene));
        for (const Particle& particle : emitter.particles) add_particle(frame, particle, scene);
        std::vector<std::uint32_t> order(emitter.particles.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto index = static_cast<std::uint32_t>(scene.draws.size() - 1);
        const auto count = static_cast<std::uint32_t>(order.size() * 6);
        submitted.push_back({count, 1, add_quads(order, scene), 0, index});
        sorted.push_back({count, 1, add_quads(back_to_front_particles(frame, emitter), scene), 0, index});
    }
    for (std::uint32_t i = 0; i < scene.draws.size(); ++i) {
        scene.draws[i].first_index = submitted[i].first_index;
        scene.draws[i].vertex_offset = static_cast<uint>(submitted[i].vertex_offset);
    }

    scene.opaque = add_commands(facts.lists().opaque, submitted, scene);
    scene.casters = add_commands(facts.lists().casters, submitted, scene);
    scene.transparent = add_commands(facts.lists().transparent, submitted, scene);
    scene.numbered = add_commands(facts.lists().transparent, numbered(submitted, facts.lists().transparent, scene), scene);
    scene.separate = add_commands(facts.lists().transparent, not_indexed(submitted), scene);
    scene.back_to_front = add_commands(back_to_front_draws(frame), sorted, scene);
}

void add_still(const SceneFacts& facts, SceneRecords& scene) {
    const Frame& frame = facts.frame();
    if (frame.light_volumes.empty()) return;
    Frame around;  // what records of lights are made of
    around.view = still_view(frame);
    around.blockers = frame.blockers;
    around.portals = frame.portals;
    static_cast<LightRecords&>(scene.still) = light_records(around, facts.lights());
    scene.still.views.push_back(scene.view);
    scene.still.views.back().to_world = glm::mat3(glm::transpose(around.view.to_view));
    const glm::dmat4 view = to_view_space(around.view);
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        const glm::dmat4 to_view = view * frame.draws[i].to_world;
        DrawRecord& draw = scene.still.draws.emplace_back(scene.draws[i]);
        draw.to_view = glm::mat4(to_view);
        draw.normal_to_view = glm::mat3(of_normals(to_view));
        const BoundingSphere bound = sphere_around(around.view, frame.draws[i], facts.bounds().boxes[frame.draws[i].mesh]);
        draw.bound_center = glm::vec3(bound.center);
        draw.bound_radius = float(bound.radius);
    }
}

}  // namespace strata
