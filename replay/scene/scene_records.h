// A recorded frame as the records that shaders read (passes/shaders/scene.shared.h), computed on the CPU: everything is made
// camera-relative in double and rounded once. Knows no graphics API; Session uploads the bytes.
#pragma once

#include <vector>

#include "passes/scene/light_records.h"
#include "passes/shaders/scene/draws.shared.h"
#include "passes/shaders/scene/materials.shared.h"
#include "passes/shaders/scene/shadows.shared.h"
#include "passes/shaders/scene/view.shared.h"

namespace strata {

class SceneFacts;  // passes/scene/scene_facts.h

/// VkDrawIndexedIndirectCommand. first_instance is the draw's index into Draws.
struct DrawCommand {
    std::uint32_t index_count = 0, instance_count = 1, first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;
};

/// A run of commands.
struct CommandRange {
    std::uint32_t first = 0, count = 0;
};

/// The records as still_view() sees them, offered as "Still View" and so on. None in a frame without light volumes.
struct StillRecords : LightRecords {
    std::vector<ViewRecord> views;  ///< one
    std::vector<DrawRecord> draws;  ///< of Frame::draws; motion is as the frame's own eye sees it
};

struct SceneRecords : LightRecords {
    ViewRecord view{};
    StillRecords still;
    // What vertices have, mesh by mesh (passes/shaders/vertex.glsl).
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents, colors;  ///< colors of particles, too
    std::vector<glm::vec2> uvs;
    // What particles have, emitter by emitter.
    std::vector<glm::vec4> particle_bottoms, particle_tops, particle_uvs, particle_glows;
    std::vector<float> particle_depths;
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> places;      ///< in indices: what numbered draws have for theirs (numbering.h)
    std::vector<DrawRecord> draws;          ///< Frame::draws, then one per emitter
    std::vector<MaterialRecord> materials;  ///< Frame::materials, then one per emitter
    std::vector<TextureRecord> textures;
    std::vector<std::uint32_t> texels;
    std::vector<ShadowRecord> shadows;
    std::vector<DrawCommand> commands;
    CommandRange opaque, casters, transparent, numbered, separate, back_to_front;
};

SceneRecords scene_records(const SceneFacts&);

// The parts, each in its own file.
void add_geometry(const SceneFacts&, SceneRecords&);  // geometry.cpp: vertices, indices, draws, commands
void add_materials(const Frame&, SceneRecords&);      // materials.cpp
void add_textures(const Frame&, SceneRecords&);
void add_lights(const SceneFacts&, SceneRecords&);  // lights.cpp: lights and what stops them, shadows, view
void add_still(const SceneFacts&, SceneRecords&);   // geometry.cpp: StillRecords, of what the others added

}  // namespace strata
