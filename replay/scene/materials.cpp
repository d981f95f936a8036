// Materials and textures as records: texels of every texture in one buffer of uints, mips finest first.
#include <algorithm>
#include <cstring>

#include <fmt/core.h>

#include "replay/scene/scene_records.h"

namespace strata {
namespace {

TextureUseRecord record(const TextureUse& use) {
    const auto& m = use.transform;
    return {.texture = use.texture, .uv_set = use.uv_set, .row0 = {m[0], m[1], m[2]}, .row1 = {m[3], m[4], m[5]}};
}

MaterialRecord record(const Material& m) {
    return {
        .base_color = m.base_color,
        .emissive = m.emissive,
        .metallic = m.metallic,
        .transmission = m.transmission,
        .roughness = m.roughness,
        .lighting_model = static_cast<uint>(m.lighting_model),
        .alpha_mode = static_cast<uint>(m.alpha_mode),
        .mask_cutoff = m.mask_cutoff,
        .normal_scale = m.normal_scale,
        .occlusion_strength = m.occlusion_strength,
        .distortion = m.distortion,
        .double_sided = m.double_sided ? 1u : 0u,
        .base_color_texture = record(m.base_color_texture),
        .metallic_roughness_texture = record(m.metallic_roughness_texture),
        .normal_texture = record(m.normal_texture),
        .emissive_texture = record(m.emissive_texture),
        .occlusion_texture = record(m.occlusion_texture),
    };
}

std::uint64_t texel_bytes_of(TextureFormat format) {
    return format == TextureFormat::rgba32f ? 16 : format == TextureFormat::rgba16f ? 8 : 4;
}

std::uint64_t mip_bytes(const Texture& t, std::uint32_t mip) {
    return std::uint64_t(std::max(1u, t.width >> mip)) * std::max(1u, t.height >> mip) * texel_bytes_of(t.format);
}

std::uint64_t bytes_from(const Texture& t, std::uint32_t first_mip) {
    std::uint64_t sum = 0;
    for (std::uint32_t mip = first_mip; mip < t.mips; ++mip) sum += mip_bytes(t, mip);
    return sum;
}

/// How many of the finest mips each texture leaves out so that all fit.
std::vector<std::uint32_t> mips_to_drop(const Frame& frame, std::uint64_t budget) {
    std::vector<std::uint32_t> dropped(frame.textures.size(), 0);
    std::uint64_t total = 0;
    for (const Texture& t : frame.textures) total += bytes_from(t, 0);
    while (total > budget) {
        std::size_t largest = dropped.size();
        std::uint64_t largest_bytes = 0;
        for (std::size_t i = 0; i < dropped.size(); ++i) {
            if (dropped[i] + 1 >= frame.textures[i].mips) continue;
            const std::uint64_t finest = mip_bytes(frame.textures[i], dropped[i]);
            if (finest > largest_bytes) largest = i, largest_bytes = finest;
        }
        if (largest == dropped.size()) break;
        total -= largest_bytes;
        ++dropped[largest];
    }
    return dropped;
}

}  // namespace

void add_materials(const Frame& frame, SceneRecords& scene) {
    for (const Material& m : frame.materials) scene.materials.push_back(record(m));
    for (const Emitter& emitter : frame.emitters) {
        Material sprite{.name = emitter.name, .lighting_model = LightingModel::unlit, .alpha_mode = emitter.alpha_mode};
        sprite.double_sided = true;
        sprite.base_color_texture.texture = emitter.texture;
        scene.materials.push_back(record(sprite));
    }
}

void add_textures(const Frame& frame, std::uint64_t texel_bytes, SceneRecords& scene) {
    const std::vector<std::uint32_t> dropped = mips_to_drop(frame, texel_bytes);
    for (std::size_t i = 0; i < frame.textures.size(); ++i) {
        const Texture& t = frame.textures[i];
        const std::uint64_t skipped = bytes_from(t, 0) - bytes_from(t, dropped[i]);
        scene.textures.push_back({
            .first = static_cast<uint>(scene.texels.size()),
            .format = static_cast<uint>(t.format),
            .width = std::max(1u, t.width >> dropped[i]),
            .height = std::max(1u, t.height >> dropped[i]),
            .mips = t.mips - dropped[i],
            .address = static_cast<uint>(t.address),
        });
        const std::size_t at = scene.texels.size();
        scene.texels.resize(at + bytes_from(t, dropped[i]) / 4);
        std::memcpy(scene.texels.data() + at, t.texels.data() + skipped, (scene.texels.size() - at) * 4);
        if (dropped[i] > 0)
            scene.notes.push_back(
                fmt::format("texture '{}' is used without its {} finest mips: the device binds {} MiB of texels", t.name,
                            dropped[i], texel_bytes >> 20));
    }
}

}  // namespace strata
