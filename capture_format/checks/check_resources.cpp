// The resources and submissions of check_frame(): sizes, indices, uv sets. Texels, colors, normals and tangents may hold any
// bits.
#include <algorithm>
#include <bit>

#include "capture_format/codec/texture_bytes.h"
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
    inspection.expect(optional_index(use.texture, textures), "it uses texture {} of {}", use.texture, textures);
    inspection.expect(use.uv_set <= 1, "uv sets are 0 and 1, not {}", use.uv_set);
    for (const float element : use.transform) {
        inspection.expect(within(element, -largest_uv, largest_uv), "a uv transform's element must be within +-{}, not {}",
                          largest_uv, element);
    }
}

void inspect_material(Inspection& inspection, std::size_t textures, const Material& material) {
    inspection.expect(material.name.size() <= longest_text, "names may have {} bytes", longest_text);
    inspection.expect(known(material.lighting_model, last_lighting_model), "there is no lighting model {}",
                      static_cast<std::uint32_t>(material.lighting_model));
    inspection.expect(known(material.alpha_mode, AlphaMode::additive), "there is no alpha mode {}",
                      static_cast<std::uint32_t>(material.alpha_mode));
    inspection.expect(finite(material.base_color), "the base color is not finite");
    inspection.expect(finite(material.emissive), "the emissive radiance is not finite");
    inspection.expect(within(material.metallic, 0, 1), "metallic must be 0 to 1, not {}", material.metallic);
    inspection.expect(within(material.roughness, 0, 1), "roughness must be 0 to 1, not {}", material.roughness);
    inspection.expect(finite(material.normal_scale), "the normal scale is not finite");
    inspection.expect(within(material.occlusion_strength, 0, 1), "the occlusion strength must be 0 to 1, not {}",
                      material.occlusion_strength);
    inspection.expect(finite(material.mask_cutoff), "the mask cutoff is not finite");
    for (int i = 0; i < 3; ++i) {
        inspection.expect(within(material.transmission[i], 0, 1), "transmission must be 0 to 1, not {}",
                          material.transmission[i]);
    }
    inspection.expect(finite(material.distortion), "the distortion is not finite");
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
        inspection.expect(use->uv_set == 0 ? mesh.has_uv0 : mesh.has_uv1,
                          "material '{:.60}' has a texture on uv set {}, which mesh '{:.60}' lacks", material.name, use->uv_set,
                          mesh.name);
    }
}

bool affine(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        if (!finite(matrix[column]) || matrix[column][3] != (column == 3 ? 1 : 0)) return false;
    }
    return true;
}

void inspect_draw(Inspection& inspection, const ResourceShapes& resources, const Draw& draw) {
    inspection.expect(draw.name.size() <= longest_text, "names may have {} bytes", longest_text);
    const bool has_mesh =
        inspection.expect(draw.mesh < resources.meshes.size(), "it draws mesh {} of {}", draw.mesh, resources.meshes.size());
    const bool has_material = inspection.expect(draw.material < resources.materials.size(), "it uses material {} of {}",
                                                draw.material, resources.materials.size());
    inspection.expect(affine(draw.to_world), "to_world must be finite with the last row 0 0 0 1");
    inspection.expect(affine(draw.previous_to_world), "previous_to_world must be finite with the last row 0 0 0 1");
    inspection.expect(known(draw.mobility, Mobility::moving), "there is no mobility {}",
                      static_cast<std::uint32_t>(draw.mobility));
    inspection.expect(known(draw.resolution, Resolution::low), "there is no resolution {}",
                      static_cast<std::uint32_t>(draw.resolution));
    inspection.expect(draw.layer <= last_layer, "layers are 0 to {}, not {}", last_layer, draw.layer);
    // An earlier failure may be that material's own bad uv set.
    if (has_mesh && has_material && !inspection.failed())
        inspect_uv_sets(inspection, resources.meshes[draw.mesh], resources.materials[draw.material]);
}

void inspect_particle(Inspection& inspection, const Particle& particle, std::size_t index) {
    inspection.expect(finite(particle.center), "particle {}'s center is not finite", index);
    inspection.expect(positive_or_zero(particle.size), "particle {}'s size must be 0 m or above, not {}", index, particle.size);
    inspection.expect(finite(particle.rotation), "particle {}'s rotation is not finite", index);
    for (int i = 0; i < 4; ++i) {
        inspection.expect(within(particle.uv_frame[i], -largest_uv, largest_uv), "particle {}'s uv frame must be within +-{}",
                          index, largest_uv);
    }
}

void inspect_emitter(Inspection& inspection, std::size_t textures, const Emitter& emitter) {
    inspection.expect(emitter.name.size() <= longest_text, "names may have {} bytes", longest_text);
    inspection.expect(optional_index(emitter.texture, textures), "it uses texture {} of {}", emitter.texture, textures);
    inspection.expect(emitter.alpha_mode == AlphaMode::blend || emitter.alpha_mode == AlphaMode::premultiplied ||
                          emitter.alpha_mode == AlphaMode::additive,
                      "particles blend, are premultiplied or add; alpha mode {} is none of these",
                      static_cast<std::uint32_t>(emitter.alpha_mode));
    inspection.expect(positive_or_zero(emitter.soft_depth_fade), "the soft depth fade must be 0 m or above, not {}",
                      emitter.soft_depth_fade);
    inspection.expect(known(emitter.resolution, Resolution::low), "there is no resolution {}",
                      static_cast<std::uint32_t>(emitter.resolution));
    inspection.expect(emitter.layer <= last_layer, "layers are 0 to {}, not {}", last_layer, emitter.layer);
    for (std::size_t i = 0; i < emitter.particles.size(); ++i) inspect_particle(inspection, emitter.particles[i], i);
}

}  // namespace

void inspect_texture(Inspection& inspection, const Texture& texture) {
    inspection.expect(texture.name.size() <= longest_text, "names may have {} bytes", longest_text);
    const bool shaped = inspection.expect(known(texture.format, TextureFormat::rgba32f), "there is no texture format {}",
                                          static_cast<std::uint32_t>(texture.format)) &&
                        inspection.expect(within(texture.width, 1, largest_extent) && within(texture.height, 1, largest_extent),
                                          "the extent must be 1 to {} texels each way, not {} x {}", largest_extent,
                                          texture.width, texture.height);
    inspection.expect(known(texture.address, AddressMode::mirror_clamp), "there is no address mode {}",
                      static_cast<std::uint32_t>(texture.address));
    if (!shaped) return;
    const auto most_mips = static_cast<std::uint32_t>(std::bit_width(std::max(texture.width, texture.height)));
    if (!inspection.expect(within(texture.mips, 1, most_mips), "{} x {} texels have 1 to {} mips, not {}", texture.width,
                           texture.height, most_mips, texture.mips)) {
        return;
    }
    inspection.expect(texture.texels.size() == texture_bytes(texture), "its mips need {} bytes, {} are there",
                      texture_bytes(texture), texture.texels.size());
}

void inspect_mesh(Inspection& inspection, const Mesh& mesh) {
    inspection.expect(mesh.name.size() <= longest_text, "names may have {} bytes", longest_text);
    const std::size_t vertices = mesh.positions.size();
    inspection.expect(vertices < no_index, "a mesh may have {} vertices, not {}", no_index - 1, vertices);
    const struct {
        std::string_view name;
        std::size_t length;
    } streams[] = {{"normals", mesh.normals.size()},
                   {"tangents", mesh.tangents.size()},
                   {"uv0", mesh.uv0.size()},
                   {"uv1", mesh.uv1.size()},
                   {"colors", mesh.colors.size()}};
    for (const auto& stream : streams) {
        inspection.expect(stream.length == 0 || stream.length == vertices,
                          "{} must be absent or as many as the {} positions, not {}", stream.name, vertices, stream.length);
    }
    inspection.expect(all_finite(mesh.positions), "a position is not finite");
    inspection.expect(usable_uvs(mesh.uv0) && usable_uvs(mesh.uv1), "texture coordinates must be within +-{}", largest_uv);
    inspection.expect(mesh.indices.size() % 3 == 0, "{} indices are not whole triangles", mesh.indices.size());
    const auto largest = std::max_element(mesh.indices.begin(), mesh.indices.end());
    if (largest == mesh.indices.end()) return;
    inspection.expect(*largest < vertices, "index {} points at vertex {} of {}", largest - mesh.indices.begin(), *largest,
                      vertices);
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
        inspection.at({"emitter", i, frame.emitters[i].name});
        inspect_emitter(inspection, resources.textures, frame.emitters[i]);
    }
}

}  // namespace strata
