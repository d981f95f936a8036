#include "replay/scene/device_scene.h"

#include <array>
#include <span>
#include <string_view>

#include <xxhash.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/reference/ltc_table.h"

namespace strata {
namespace {

/// The scene's buffers: block name in passes/shaders/scene.glsl, and the bytes. The row's place is its import id - 1.
struct BufferRow {
    const char* name;
    std::span<const std::byte> (*bytes)(const SceneRecords&);
};

template <auto Member>
std::span<const std::byte> still_bytes_of(const SceneRecords& scene) {
    return std::as_bytes(std::span(scene.still.*Member));
}

template <auto Member>
std::span<const std::byte> bytes_of(const SceneRecords& scene) {
    return std::as_bytes(std::span(scene.*Member));
}

std::span<const std::byte> view_bytes(const SceneRecords& scene) { return std::as_bytes(std::span(&scene.view, 1)); }

// The same for every scene.
std::span<const std::byte> ltc_bytes(const SceneRecords&) { return std::as_bytes(ltc_table()); }

constexpr BufferRow rows[] = {
    {"View", view_bytes},
    {"VertexPositions", bytes_of<&SceneRecords::positions>},
    {"Draws", bytes_of<&SceneRecords::draws>},
    {"Materials", bytes_of<&SceneRecords::materials>},
    {"Textures", bytes_of<&SceneRecords::textures>},
    {"Texels", bytes_of<&SceneRecords::texels>},
    {"Lights", bytes_of<&SceneRecords::lights>},
    {"Shadows", bytes_of<&SceneRecords::shadows>},
    {"Blockers", bytes_of<&SceneRecords::blockers>},
    {"LightBlockers", bytes_of<&SceneRecords::light_blockers>},
    {"BlockerPortals", bytes_of<&SceneRecords::blocker_portals>},
    {"Portals", bytes_of<&SceneRecords::portals>},
    {"ClipPlanes", bytes_of<&SceneRecords::clip_planes>},
    {"LtcTable", ltc_bytes},
    // The sources of every draw list; of these, Indices alone is offered to shaders.
    {"DrawCommands", bytes_of<&SceneRecords::commands>},
    {"Indices", bytes_of<&SceneRecords::indices>},
    {"Places", bytes_of<&SceneRecords::places>},
    {"VertexNormals", bytes_of<&SceneRecords::normals>},
    {"VertexTangents", bytes_of<&SceneRecords::tangents>},
    {"VertexUvs", bytes_of<&SceneRecords::uvs>},
    {"VertexColors", bytes_of<&SceneRecords::colors>},
    {"ParticleBottoms", bytes_of<&SceneRecords::particle_bottoms>},
    {"ParticleTops", bytes_of<&SceneRecords::particle_tops>},
    {"ParticleDepths", bytes_of<&SceneRecords::particle_depths>},
    {"ParticleUvs", bytes_of<&SceneRecords::particle_uvs>},
    {"ParticleGlows", bytes_of<&SceneRecords::particle_glows>},
    {"Still View", still_bytes_of<&StillRecords::views>},
    {"Still Draws", still_bytes_of<&StillRecords::draws>},
    {"Still Lights", still_bytes_of<&StillRecords::lights>},
    {"Still Blockers", still_bytes_of<&StillRecords::blockers>},
    {"Still LightBlockers", still_bytes_of<&StillRecords::light_blockers>},
    {"Still BlockerPortals", still_bytes_of<&StillRecords::blocker_portals>},
    {"Still Portals", still_bytes_of<&StillRecords::portals>},
    {"Still ClipPlanes", still_bytes_of<&StillRecords::clip_planes>},
};

consteval std::size_t row_of(std::string_view name) {
    std::size_t row = 0;
    while (rows[row].name != name) ++row;
    return row;
}

// A buffer of nothing still has to exist: a storage buffer of zero bytes is no buffer.
constexpr std::array<std::byte, 16> nothing{};

std::span<const std::byte> contents(const BufferRow& row, const SceneRecords& scene) {
    const auto bytes = row.bytes(scene);
    return bytes.empty() ? std::span<const std::byte>(nothing) : bytes;
}

}  // namespace

void DeviceScene::describe(const SceneRecords& scene) {
    bytes_.clear();
    for (const BufferRow& row : rows) bytes_.push_back(contents(row, scene).size());
    opaque_ = scene.opaque;
    casters_ = scene.casters;
    transparent_ = scene.transparent;
    numbered_ = scene.numbered;
    separate_ = scene.separate;
    back_to_front_ = scene.back_to_front;
}

void DeviceScene::upload(const SceneRecords& scene) {
    describe(scene);
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const std::span<const std::byte> bytes = contents(rows[i], scene);
        const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
        const std::array<std::uint64_t, 2> now{hash.low64, hash.high64};
        if (const auto before = uploaded_.find(i); before != uploaded_.end() && before->second == now) continue;
        uploaded_.erase(i);  // after an upload that failed its contents are unknown
        executor_->upload({i + 1}, bytes);
        uploaded_.emplace(i, now);
    }
}

void DeviceScene::forget() {
    for (std::size_t i = 0; i < std::size(rows); ++i) executor_->forget({i + 1});
    uploaded_.clear();
}

void DeviceScene::import_into(Graph& graph, FrameImages& images) const {
    std::array<Buffer, std::size(rows)> buffers;
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        buffers[i] = graph.import(rows[i].name, bytes_[i], {i + 1});
        graph.offer(rows[i].name, buffers[i]);
    }
    const auto list = [&](CommandRange range) {
        return DrawList{buffers[row_of("DrawCommands")], buffers[row_of("Indices")], range.first, range.count};
    };
    images.all_opaque = images.opaque = list(opaque_);
    images.casters = list(casters_);
    images.transparent = list(transparent_);
    images.numbered = list(numbered_);
    images.numbered.indices = buffers[row_of("Places")];
    images.separate = list(separate_);
    images.separate.indices = {};
    images.numbered.of_places = images.separate.of_places = true;
    images.back_to_front = list(back_to_front_);
}

}  // namespace strata
