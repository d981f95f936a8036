// The resources and submissions of check_frame(): sizes, indices, uv sets. Texels, colors, normals and tangents may hold any
// bits.
#include <algorithm>
#include <bit>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/inspection.h"

namespace strata {
namespace {

/// Texture coordinates and their transforms beyond this have no fraction left to filter with (2^16 tiles of 256 texels is
/// all of a float's mantissa), and their texel indices stay far inside 64 bits.
constexpr float largest_uv = 65536;
/// In-world interfaces are drawn one layer after another.
constexpr std::uint32_t last_layer = 255;

template <typename T>
bool all_finite(const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [](const T& value) { return finite(value); });
}

bool usable_uvs(const std::vector<glm::vec2>& uvs) {
    return std::all_of(uvs.begin(), uvs.end(), [](glm::vec2 uv) {
        return within(uv.x, -largest_uv, largest_uv) && within(uv.y, -largest_uv, largest_uv);
    });
}

void inspect_texture_use(Inspection& inspection, std::size_t textures, const TextureUse& use) {
    inspection.expect_optional_index("texture", use.texture, textures);
    inspection.expect_within("uv set", use.uv_set, 0, 1);
    for (const float element : use.transform) {
        inspection.expect_within("element of a uv transform", element, -largest_uv, largest_uv);
    }
}

void inspect_material(Inspection& inspection, std::size_t textures, const Material& material) {
    inspection.expect_name(material.name);
    inspection.expect_known("lighting model", material.lighting_model, last_lighting_model);
    inspection.expect_known("alpha mode", material.alpha_mode, AlphaMode::additive);
    inspection.expect_finite("base color", material.base_color);
    inspection.expect_finite("emissive radiance", material.emissive);
    inspection.expect_within("metallic", material.metallic, 0, 1);
    inspection.expect_within("roughness", material.roughness, 0, 1);
    inspection.expect_finite("normal scale", material.normal_scale);
    inspection.expect_within("occlusion strength", material.occlusion_strength, 0, 1);
    inspection.expect_finite("mask cutoff", material.mask_cutoff);
    for (int i = 0; i < 3; ++i) {
        inspection.expect_within("transmission", material.transmission[i], 0, 1);
    }
    inspection.expect_finite("distortion", material.distortion);
    for (const TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                                  &material.emissive_texture, &material.occlusion_texture}) {
        inspect_texture_use(inspection, textures, *use);
    }
}

/// Textures are looked up with the mesh's own uv sets, so these must be there.
void inspect_uv_sets(Inspection& inspection, const MeshShape& mesh, const Material& material) {
    for (const TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                                  &material.emissive_texture, &material.occlusion_texture}) {
        if (use->texture == no_index || mesh.empty) continue;
        inspection.expect(use->uv_set == 0 ? mesh.has_uv0 : mesh.has_uv1, "frame.uv_set_missing",
                          "material '{material:.60}' has a texture on uv set {uv_set}, which mesh '{mesh:.60}' lacks",
                          material.name, use->uv_set, mesh.name);
    }
}

bool affine(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        if (!finite(matrix[column]) || matrix[column][3] != (column == 3 ? 1 : 0)) return false;
    }
    return true;
}

void inspect_matrix(Inspection& inspection, std::string_view property, const glm::dmat4& matrix) {
    inspection.expect(affine(matrix), "frame.not_affine", "{property} must be finite with the last row 0 0 0 1", property);
}

void inspect_draw(Inspection& inspection, const ResourceShapes& resources, const Draw& draw) {
    inspection.expect_name(draw.name);
    const bool has_mesh = inspection.expect_index("mesh", draw.mesh, resources.meshes.size());
    const bool has_material = inspection.expect_index("material", draw.material, resources.materials.size());
    inspect_matrix(inspection, "to_world", draw.to_world);
    inspect_matrix(inspection, "previous_to_world", draw.previous_to_world);
    inspection.expect_known("mobility", draw.mobility, Mobility::moving);
    inspection.expect_known("resolution", draw.resolution, Resolution::low);
    inspection.expect_within("layer", draw.layer, 0, last_layer);
    // An earlier failure may be that material's own bad uv set.
    if (has_mesh && has_material && !inspection.failed())
        inspect_uv_sets(inspection, resources.meshes[draw.mesh], resources.materials[draw.material]);
}

void inspect_particle(Inspection& inspection, const Particle& particle) {
    inspection.expect_finite("center", particle.center);
    inspection.expect_not_negative("size in meters", particle.size);
    inspection.expect_finite("rotation", particle.rotation);
    for (int i = 0; i < 4; ++i) {
        inspection.expect_within("uv frame", particle.uv_frame[i], -largest_uv, largest_uv);
    }
}

void inspect_emitter(Inspection& inspection, std::size_t textures, const Emitter& emitter, std::size_t index) {
    inspection.at({"emitter", index, emitter.name});
    inspection.expect_name(emitter.name);
    inspection.expect_optional_index("texture", emitter.texture, textures);
    inspection.expect(emitter.alpha_mode == AlphaMode::blend || emitter.alpha_mode == AlphaMode::premultiplied ||
                          emitter.alpha_mode == AlphaMode::additive,
                      "frame.particle_alpha_mode",
                      "particles must blend, be premultiplied or add, not have alpha mode {alpha_mode}",
                      static_cast<std::uint32_t>(emitter.alpha_mode));
    inspection.expect_not_negative("soft depth fade in meters", emitter.soft_depth_fade);
    inspection.expect_known("resolution", emitter.resolution, Resolution::low);
    inspection.expect_within("layer", emitter.layer, 0, last_layer);
    for (std::size_t i = 0; i < emitter.particles.size(); ++i) {
        inspection.at({"emitter", index, emitter.name, "particle", i});
        inspect_particle(inspection, emitter.particles[i]);
    }
}

}  // namespace

void inspect_texture(Inspection& inspection, const Texture& texture) {
    inspection.expect_name(texture.name);
    const bool shaped = inspection.expect_known("texture format", texture.format, TextureFormat::rgba32f) &&
                        inspection.expect_extent(texture.width, texture.height);
    inspection.expect_known("address mode", texture.address, AddressMode::mirror_clamp);
    inspection.expect_known("magnification filter", texture.magnify, TexelFilter::nearest);
    inspection.expect_known("minification filter", texture.minify, TexelFilter::nearest);
    inspection.expect_known("filter between mips", texture.between_mips, MipFilter::none);
    if (!shaped) return;
    const auto most_mips = static_cast<std::uint32_t>(std::bit_width(std::max(texture.width, texture.height)));
    if (!inspection.expect_within("number of mips", texture.mips, 1, most_mips)) return;
    inspection.expect(texture.texels.size() == texture_bytes(texture), "frame.texel_bytes",
                      "the mips need {needed_bytes} bytes; the texture has {bytes}", texture_bytes(texture),
                      texture.texels.size());
}

void inspect_mesh(Inspection& inspection, const Mesh& mesh) {
    inspection.expect_name(mesh.name);
    const std::size_t vertices = mesh.positions.size();
    inspection.expect_at_most("vertices", vertices, no_index - 1);
    const struct {
        std::string_view name;
        std::size_t length;
    } streams[] = {{"normals", mesh.normals.size()},
                   {"tangents", mesh.tangents.size()},
                   {"uv0", mesh.uv0.size()},
                   {"uv1", mesh.uv1.size()},
                   {"colors", mesh.colors.size()}};
    for (const auto& stream : streams) {
        inspection.expect(stream.length == 0 || stream.length == vertices, "frame.stream_length",
                          "{stream} must be absent or as many as the {positions} positions, not {length}", stream.name, vertices,
                          stream.length);
    }
    inspection.expect(all_finite(mesh.positions), "frame.not_finite", "{property} is not finite", "a position");
    inspection.expect(usable_uvs(mesh.uv0) && usable_uvs(mesh.uv1), "frame.uv_range",
                      "texture coordinates must be -{most} to {most}", largest_uv, largest_uv);
    inspection.expect(mesh.indices.size() % 3 == 0, "frame.whole_triangles", "{indices} indices are not whole triangles",
                      mesh.indices.size());
    const auto largest = std::max_element(mesh.indices.begin(), mesh.indices.end());
    if (largest == mesh.indices.end()) return;
    inspection.expect(*largest < vertices, "frame.vertex_range", "index {index} points at vertex {vertex}; there are {vertices}",
                      largest - mesh.indices.begin(), *largest, vertices);
}

void inspect_submissions(Inspection& inspection, const Frame& frame, const ResourceShapes& resources) {
    for (std::size_t i = 0; i < resources.materials.size(); ++i) {
        inspection.at({"material", i, resources.materials[i].name});
        inspect_material(inspection, resources.textures, resources.materials[i]);
    }
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        inspection.at({"draw", i, frame.draws[i].name});
        inspect_draw(inspection, resources, frame.draws[i]);
    }
    for (std::size_t i = 0; i < frame.emitters.size(); ++i) {
        inspect_emitter(inspection, resources.textures, frame.emitters[i], i);
    }
}

}  // namespace strata
