#include "passes/scene/caster_hashes.h"

#include <map>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "passes/scene/digest.h"

namespace strata {
namespace {

std::uint64_t hash_of(const Mesh& mesh) {
    Digest digest;
    digest.add_all(mesh.positions).add_all(mesh.normals).add_all(mesh.uv0).add_all(mesh.uv1).add_all(mesh.colors);
    return digest.add_all(mesh.indices).value();
}

std::uint64_t hash_of(const Texture& texture) {
    Digest digest;
    digest.add(texture.format).add(texture.width).add(texture.height).add(texture.mips).add(texture.address);
    digest.add(texture.magnify).add(texture.minify).add(texture.between_mips);
    return digest.add_all(texture.texels).value();
}

/// Hashes of what stands in a list of the frame, by its index.
template <typename Item>
class Hashes {
public:
    explicit Hashes(const std::vector<Item>& items) : items_(&items) {}
    /// 0 for no_index.
    std::uint64_t at(std::uint32_t index) {
        if (index == no_index) return 0;
        const auto [known, is_new] = known_.try_emplace(index);
        if (is_new) known->second = hash_of((*items_)[index]);
        return known->second;
    }

private:
    const std::vector<Item>* items_;
    std::map<std::uint32_t, std::uint64_t> known_;
};

void add(Digest& digest, const TextureUse& use, Hashes<Texture>& textures) {
    digest.add(textures.at(use.texture)).add(use.uv_set).add(use.transform);
}

void add(Digest& digest, const Material& material, Hashes<Texture>& textures) {
    digest.add(material.lighting_model).add(material.alpha_mode).add(material.base_color).add(material.metallic);
    digest.add(material.mask_cutoff).add(material.double_sided);
    add(digest, material.base_color_texture, textures);
    add(digest, material.metallic_roughness_texture, textures);
}

}  // namespace

std::vector<std::uint64_t> caster_hashes(const Frame& frame, std::span<const std::uint32_t> draws) {
    Hashes<Mesh> meshes(frame.meshes);
    Hashes<Texture> textures(frame.textures);
    std::vector<std::uint64_t> hashes;
    for (const std::uint32_t index : draws) {
        const Draw& draw = frame.draws[index];
        Digest digest;
        digest.add(meshes.at(draw.mesh)).add(draw.to_world);
        add(digest, frame.materials[draw.material], textures);
        hashes.push_back(digest.value());
    }
    return hashes;
}

}  // namespace strata
