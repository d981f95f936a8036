#include "tests/fuzz/walk_frame.h"

#include <cstdlib>

#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/encode_frame.h"
#include "capture_format/codec/texture_bytes.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/no_index.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame_features.h"
#include "capture_format/reader.h"

namespace strata {
namespace {

double sum_of(const Texture& texture) {
    const std::size_t bytes = texture_bytes(texture);
    return double(texture.texels[0]) + double(texture.texels[bytes - 1]);
}

double sum_of_use(const Frame& frame, const Mesh& mesh, const TextureUse& use) {
    if (use.texture == no_index || mesh.positions.empty()) return 0;
    const auto& uvs = use.uv_set == 0 ? mesh.uv0 : mesh.uv1;
    return sum_of(frame.textures[use.texture]) + double(uvs[0].x) + double(uvs[mesh.positions.size() - 1].y);
}

double sum_of(const Frame& frame, const Draw& draw) {
    const Mesh& mesh = frame.meshes[draw.mesh];
    const Material& material = frame.materials[draw.material];
    double sum = draw.to_world[3][0] + double(material.roughness);
    for (const std::uint32_t index : mesh.indices) {
        sum += double(mesh.positions[index].x);
        if (!mesh.normals.empty()) sum += double(mesh.normals[index].x);
        if (!mesh.tangents.empty()) sum += double(mesh.tangents[index].w);
        if (!mesh.colors.empty()) sum += double(mesh.colors[index].w);
    }
    for (const TextureUse* use : {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
                                  &material.emissive_texture, &material.occlusion_texture})
        sum += sum_of_use(frame, mesh, *use);
    return sum;
}

double sum_of(const Frame& frame, const Light& light) {
    double sum = light.texture == no_index ? 0 : sum_of(frame.textures[light.texture]);
    for (const std::uint32_t blocker : light.blockers) sum += double(frame.blockers[blocker].half_u);
    for (const std::uint32_t portal : light.portals) sum += double(frame.blockers[frame.portals[portal].blocker].half_u);
    return sum;
}

}  // namespace

double walk(const Frame& frame) {
    double sum = 0;
    for (const Texture& texture : frame.textures) sum += sum_of(texture);
    for (const Draw& draw : frame.draws) sum += sum_of(frame, draw);
    for (const Emitter& emitter : frame.emitters) {
        if (emitter.texture != no_index) sum += sum_of(frame.textures[emitter.texture]);
        for (const Particle& particle : emitter.particles) sum += particle.center.x;
    }
    for (const Light& light : frame.lights) sum += sum_of(frame, light);
    for (const Portal& portal : frame.portals) sum += double(frame.blockers[portal.blocker].half_u);
    const Features features = frame_features(frame);
    for (const Feature feature : all_features()) sum += double(features.reason(feature).size());
    return sum;
}

void expect_survives_writing(const Frame& frame, const std::filesystem::path& path) {
    BlobCollector blobs, blobs_again;
    const std::vector<std::byte> section = encode_frame(frame, blobs);
    // Hostile flatbuffers share tables and vectors that written ones repeat: what grows too large by that is not written.
    if (!verify_frame(section)) return;
    auto file = ContainerWriter::create(path);
    const auto packed = blobs.pack();
    if (!file || !packed) std::abort();
    for (const PackedBlobs& part : *packed)
        if (!file->add({SectionType::blobs, part.version, part.stored, part.raw_bytes})) std::abort();
    if (!file->add({SectionType::frame, 1, section, section.size()}) || !file->finish()) std::abort();
    const auto capture = Capture::open(path);
    const auto read = capture ? capture->frame(0) : Result<Frame>(capture.error());
    if (!read || encode_frame(*read, blobs_again) != section) std::abort();
}

}  // namespace strata
