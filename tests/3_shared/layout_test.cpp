// Blocks of shaders and structs of C++ are the same bytes. SPIR-V carries member names and offsets, so the shaders say
// themselves where they read; nothing runs.
#include <algorithm>
#include <cstddef>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "passes/graph/shader.h"
#include "passes/registry.h"
#include "passes/shaders/ltc.shared.h"
#include "passes/shaders/scene/draws.shared.h"
#include "passes/shaders/scene/lights.shared.h"
#include "passes/shaders/scene/materials.shared.h"
#include "passes/shaders/scene/shadows.shared.h"
#include "passes/shaders/scene/view.shared.h"
#include "passes/technique.h"

namespace strata {
namespace {

struct Field {
    std::string_view name;
    std::size_t offset;
};

struct Record {
    std::string_view name;
    std::size_t bytes;
    std::vector<Field> fields;
};

std::vector<Record> view_records() {
    using V = ViewRecord;
    return {{"ViewRecord",
             sizeof(V),
             {{"projection", offsetof(V, projection)},
              {"to_world", offsetof(V, to_world)},
              {"ndc_scale", offsetof(V, ndc_scale)},
              {"ndc_offset", offsetof(V, ndc_offset)},
              {"extent", offsetof(V, extent)},
              {"samples", offsetof(V, samples)},
              {"near", offsetof(V, near)},
              {"exposure", offsetof(V, exposure)},
              {"pre_exposure", offsetof(V, pre_exposure)},
              {"white_level", offsetof(V, white_level)},
              {"white", offsetof(V, white)},
              {"background", offsetof(V, background)},
              {"fog_density", offsetof(V, fog_density)},
              {"fog_color", offsetof(V, fog_color)},
              {"fog_path", offsetof(V, fog_path)},
              {"sky", offsetof(V, sky)},
              {"ground", offsetof(V, ground)},
              {"light_count", offsetof(V, light_count)},
              {"shadow_count", offsetof(V, shadow_count)},
              {"first_emitter", offsetof(V, first_emitter)},
              {"seed", offsetof(V, seed)},
              {"frame_index", offsetof(V, frame_index)},
              {"time", offsetof(V, time)}}}};
}

std::vector<Record> geometry_records() {
    using D = DrawRecord;
    return {{"DrawRecord",
             sizeof(D),
             {{"to_view", offsetof(D, to_view)},
              {"normal_to_view", offsetof(D, normal_to_view)},
              {"material", offsetof(D, material)},
              {"soft_fade", offsetof(D, soft_fade)},
              {"layer", offsetof(D, layer)},
              {"bound_center", offsetof(D, bound_center)},
              {"bound_radius", offsetof(D, bound_radius)},
              {"motion", offsetof(D, motion)},
              {"first_index", offsetof(D, first_index)},
              {"vertex_offset", offsetof(D, vertex_offset)},
              {"normals", offsetof(D, normals)},
              {"tangents", offsetof(D, tangents)},
              {"uv0", offsetof(D, uv0)},
              {"uv1", offsetof(D, uv1)},
              {"colors", offsetof(D, colors)},
              {"first_particle", offsetof(D, first_particle)}}}};
}

std::vector<Record> material_records() {
    using U = TextureUseRecord;
    using M = MaterialRecord;
    using T = TextureRecord;
    return {{"TextureUseRecord",
             sizeof(U),
             {{"texture", offsetof(U, texture)},
              {"uv_set", offsetof(U, uv_set)},
              {"row0", offsetof(U, row0)},
              {"row1", offsetof(U, row1)}}},
            {"MaterialRecord",
             sizeof(M),
             {{"base_color", offsetof(M, base_color)},
              {"emissive", offsetof(M, emissive)},
              {"metallic", offsetof(M, metallic)},
              {"transmission", offsetof(M, transmission)},
              {"roughness", offsetof(M, roughness)},
              {"lighting_model", offsetof(M, lighting_model)},
              {"alpha_mode", offsetof(M, alpha_mode)},
              {"mask_cutoff", offsetof(M, mask_cutoff)},
              {"normal_scale", offsetof(M, normal_scale)},
              {"occlusion_strength", offsetof(M, occlusion_strength)},
              {"distortion", offsetof(M, distortion)},
              {"double_sided", offsetof(M, double_sided)},
              {"textures", offsetof(M, textures)}}},
            {"TextureRecord",
             sizeof(T),
             {{"first", offsetof(T, first)},
              {"format", offsetof(T, format)},
              {"width", offsetof(T, width)},
              {"height", offsetof(T, height)},
              {"mips", offsetof(T, mips)},
              {"sampling", offsetof(T, sampling)}}}};
}

std::vector<Record> light_records() {
    using L = LightRecord;
    using S = ShadowRecord;
    return {{"LightRecord",
             sizeof(L),
             {{"position", offsetof(L, position)},
              {"type", offsetof(L, type)},
              {"direction", offsetof(L, direction)},
              {"range", offsetof(L, range)},
              {"intensity", offsetof(L, intensity)},
              {"source_radius", offsetof(L, source_radius)},
              {"axis_u", offsetof(L, axis_u)},
              {"cos_inner", offsetof(L, cos_inner)},
              {"cos_outer", offsetof(L, cos_outer)},
              {"tan_half", offsetof(L, tan_half)},
              {"half_extent", offsetof(L, half_extent)},
              {"texture", offsetof(L, texture)},
              {"features", offsetof(L, features)},
              {"first_blocker", offsetof(L, first_blocker)},
              {"blockers", offsetof(L, blockers)},
              {"first_portal", offsetof(L, first_portal)},
              {"portals", offsetof(L, portals)},
              {"first_clip", offsetof(L, first_clip)},
              {"clips", offsetof(L, clips)},
              {"shadow", offsetof(L, shadow)},
              {"shadow_slots", offsetof(L, shadow_slots)},
              {"visibility_layer", offsetof(L, visibility_layer)},
              {"window", offsetof(L, window)}}},
            {"ShadowRecord",
             sizeof(S),
             {{"view_to_map", offsetof(S, view_to_map)},
              {"light", offsetof(S, light)},
              {"size", offsetof(S, size)},
              {"bias", offsetof(S, bias)},
              {"range_begin", offsetof(S, range_begin)},
              {"range_end", offsetof(S, range_end)},
              {"texel", offsetof(S, texel)},
              {"source_width", offsetof(S, source_width)},
              {"offset", offsetof(S, offset)},
              {"layer", offsetof(S, layer)}}}};
}

std::vector<Record> blocker_records() {
    using B = BlockerRecord;
    using U = LightBlockerRecord;
    using P = BlockerPortalRecord;
    return {{"BlockerRecord",
             sizeof(B),
             {{"normal", offsetof(B, normal)},
              {"half_u", offsetof(B, half_u)},
              {"center", offsetof(B, center)},
              {"half_v", offsetof(B, half_v)},
              {"u", offsetof(B, u)},
              {"one_sided", offsetof(B, one_sided)}}},
            {"ClipPlaneRecord",
             sizeof(ClipPlaneRecord),
             {{"normal", offsetof(ClipPlaneRecord, normal)}, {"distance", offsetof(ClipPlaneRecord, distance)}}},
            {"LtcRecord",
             sizeof(LtcRecord),
             {{"m11", offsetof(LtcRecord, m11)},
              {"m13", offsetof(LtcRecord, m13)},
              {"m22", offsetof(LtcRecord, m22)},
              {"m31", offsetof(LtcRecord, m31)},
              {"m33", offsetof(LtcRecord, m33)},
              {"albedo", offsetof(LtcRecord, albedo)},
              {"fresnel", offsetof(LtcRecord, fresnel)}}},
            {"LightBlockerRecord", sizeof(U), {{"blocker", offsetof(U, blocker)}, {"portals", offsetof(U, portals)}}},
            {"BlockerPortalRecord",
             sizeof(P),
             {{"center", offsetof(P, center)},
              {"half_extent", offsetof(P, half_extent)},
              {"turn", offsetof(P, turn)},
              {"blocker", offsetof(P, blocker)}}}};
}

std::map<std::string_view, Record> scene_records() {
    std::map<std::string_view, Record> all;
    for (const auto& group : {view_records(), geometry_records(), material_records(), light_records(), blocker_records()})
        for (const Record& record : group) all.emplace(record.name, record);
    return all;
}

/// The last part of "outer.inner".
std::string own_name(const BlockMember& member) { return member.name.substr(member.name.rfind('.') + 1); }

std::vector<const Shader*> built_in_shaders() {
    std::vector<const Shader*> shaders;
    for (const std::string& name : ShaderLibrary::built_in().names()) shaders.push_back(ShaderLibrary::built_in().find(name));
    return shaders;
}

TEST(Layout, SceneRecordsLieWhereTheShadersReadThem) {
    const auto records = scene_records();
    std::set<std::string_view> seen;
    for (const Shader* shader : built_in_shaders()) {
        for (const BlockMember& member : shader->members) {
            const auto record = records.find(member.holder);
            if (record == records.end()) continue;
            seen.insert(record->first);
            const auto field = std::ranges::find(record->second.fields, own_name(member), &Field::name);
            ASSERT_NE(field, record->second.fields.end()) << member.holder << " has no " << own_name(member) << " in this table";
            EXPECT_EQ(member.offset_in_holder, field->offset) << shader->name << ": " << member.holder << "." << own_name(member);
        }
    }
    EXPECT_TRUE(seen.contains("ViewRecord") && seen.contains("DrawRecord")) << "nothing was compared";
}

TEST(Layout, ArraysOfSceneRecordsHaveTheirSizeAsStride) {
    const std::map<std::string_view, std::size_t> strides = {
        {"vertex_positions", sizeof(glm::vec3)},
        {"vertex_normals", sizeof(glm::vec3)},
        {"vertex_tangents", sizeof(glm::vec4)},
        {"vertex_uvs", sizeof(glm::vec2)},
        {"vertex_colors", sizeof(glm::vec4)},
        {"particle_bottoms", sizeof(glm::vec4)},
        {"particle_tops", sizeof(glm::vec4)},
        {"particle_depths", sizeof(float)},
        {"particle_uvs", sizeof(glm::vec4)},
        {"particle_glows", sizeof(glm::vec4)},
        {"draws", sizeof(DrawRecord)},
        {"materials", sizeof(MaterialRecord)},
        {"textures", sizeof(TextureRecord)},
        {"lights", sizeof(LightRecord)},
        {"shadows", sizeof(ShadowRecord)},
        {"blockers", sizeof(BlockerRecord)},
        {"light_blockers", sizeof(LightBlockerRecord)},
        {"blocker_portals", sizeof(BlockerPortalRecord)},
        {"portals", sizeof(BlockerPortalRecord)},
        {"clip_planes", sizeof(ClipPlaneRecord)},
        {"ltc_table", sizeof(LtcRecord)},
    };
    const std::set<std::string> scene_blocks = {
        "VertexPositions", "VertexNormals", "VertexTangents", "VertexUvs",      "VertexColors", "ParticleBottoms", "ParticleTops",
        "ParticleDepths",  "ParticleUvs",   "ParticleGlows",  "Draws",          "Materials",    "Textures",        "Lights",
        "Shadows",         "Blockers",      "LightBlockers",  "BlockerPortals", "ClipPlanes",   "LtcTable",        "Portals"};
    for (const Shader* shader : built_in_shaders()) {
        for (const BlockMember& member : shader->members) {
            if (!scene_blocks.contains(member.block) || member.holder != member.block) continue;
            const auto known = strides.find(member.name);
            ASSERT_NE(known, strides.end()) << shader->name << ": " << member.block << "." << member.name;
            EXPECT_EQ(member.stride, known->second) << shader->name << ": " << member.name;
        }
    }
}

TEST(Layout, TheRecordsOfThisTableAreComplete) {
    for (const auto& [name, record] : scene_records()) {
        std::vector<std::size_t> offsets;
        for (const Field& field : record.fields) offsets.push_back(field.offset);
        EXPECT_TRUE(std::ranges::is_sorted(offsets)) << name;
        EXPECT_EQ(std::ranges::adjacent_find(offsets), offsets.end()) << name;
    }
}

/// Offsets by member name of every struct or block in the technique's shaders.
std::map<std::string, std::map<std::string, std::uint32_t>> structs_of(const Technique& technique) {
    std::map<std::string, std::map<std::string, std::uint32_t>> structs;
    for (const Shader* shader : built_in_shaders()) {
        if (!shader->name.starts_with(std::string(technique.name) + "/")) continue;
        for (const BlockMember& member : shader->members) structs[member.holder][own_name(member)] = member.offset_in_holder;
    }
    return structs;
}

/// The name as GLSL spells it.
std::string identifier(std::string_view name) {
    std::string text(name);
    std::ranges::replace(text, '-', '_');
    std::ranges::replace(text, ' ', '_');
    return text;
}

/// The struct that C++ and GLSL share is called for the technique: WeightedParams. Wherever its shaders have one, it has these
/// members at these offsets.
TEST(Layout, ParametersLieWhereTheTechniquesShadersReadThem) {
    for (const Technique& technique : techniques()) {
        for (const auto& [name, members] : structs_of(technique)) {
            if (!name.ends_with("Params") || name == "Params") continue;
            for (const Param& param : technique.params) {
                const auto member = members.find(identifier(param.name));
                ASSERT_NE(member, members.end()) << technique.name << ": " << name << " has no " << param.name;
                EXPECT_EQ(member->second, param.offset) << technique.name << ": " << name << "." << param.name;
            }
        }
    }
}

/// Structs in the block count, too: a technique's counters begin with those of what it is made of.
TEST(Layout, CountersLieWhereTheTechniquesShadersCount) {
    for (const Technique& technique : techniques()) {
        for (const Shader* shader : built_in_shaders()) {
            if (!shader->name.starts_with(std::string(technique.name) + "/")) continue;
            std::map<std::string, std::uint32_t> offsets;
            for (const BlockMember& member : shader->members)
                if (member.block == "Counters") offsets[own_name(member)] = member.offset;
            if (offsets.empty()) continue;
            for (const Counter& counter : technique.counters) {
                const auto member = offsets.find(identifier(counter.name));
                ASSERT_NE(member, offsets.end()) << shader->name << " has no " << counter.name;
                EXPECT_EQ(member->second, counter.offset) << shader->name << ": " << counter.name;
            }
        }
    }
}

TEST(Layout, ACountersBlockIsAsLargeAsItsStruct) {
    for (const Technique& technique : techniques()) {
        for (const Shader* shader : built_in_shaders()) {
            if (!shader->name.starts_with(std::string(technique.name) + "/")) continue;
            for (const BlockMember& member : shader->members)
                if (member.block == "Counters" && member.holder == "Counters") {
                    EXPECT_EQ(member.bytes, technique.counter_bytes) << shader->name;
                }
        }
    }
}

}  // namespace
}  // namespace strata
