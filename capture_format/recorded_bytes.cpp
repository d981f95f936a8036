#include "capture_format/recorded_bytes.h"

#include <string_view>
#include <vector>

#include "capture_format/frame.h"
#include "capture_format/recorder.h"

namespace strata {
namespace {

template <typename T>
std::uint64_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}

template <typename T>
std::uint64_t sum_of(const std::vector<T>& values) {
    std::uint64_t sum = 0;
    for (const T& value : values) sum += footprint(value);
    return sum;
}

template <typename T>
std::string labeled(std::string_view kind, std::size_t index, const T& resource) {
    return fmt::format("{} {} '{:.60}'", kind, index, resource.name);
}

}  // namespace

std::uint64_t footprint(const Texture& texture) { return sizeof(texture) + texture.name.size() + texture.texels.size(); }
std::uint64_t footprint(const Mesh& mesh) {
    return sizeof(mesh) + mesh.name.size() + bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(mesh.tangents) +
           bytes_of(mesh.uv0) + bytes_of(mesh.uv1) + bytes_of(mesh.colors) + bytes_of(mesh.indices);
}
std::uint64_t footprint(const Material& material) { return sizeof(material) + material.name.size(); }
std::uint64_t footprint(const Draw& draw) { return sizeof(draw) + draw.name.size(); }
std::uint64_t footprint(const Emitter& emitter) { return sizeof(emitter) + emitter.name.size() + bytes_of(emitter.particles); }
std::uint64_t footprint(const Light& light) {
    return sizeof(light) + light.name.size() + bytes_of(light.clip_planes) + bytes_of(light.blockers) + bytes_of(light.portals);
}

std::uint64_t recorded_bytes(const Frame& frame) {
    return sizeof(frame) + sum_of(frame.textures) + sum_of(frame.meshes) + sum_of(frame.materials) + sum_of(frame.draws) +
           sum_of(frame.emitters) + sum_of(frame.lights) + sum_of(frame.blockers) + sum_of(frame.portals);
}

std::string label(std::size_t index, const Texture& texture) { return labeled("texture", index, texture); }
std::string label(std::size_t index, const Mesh& mesh) { return labeled("mesh", index, mesh); }
std::string label(std::size_t index, const Material& material) { return labeled("material", index, material); }

std::string label(const Frame& frame, std::uint64_t number, std::uint64_t budget) {
    std::string too_large;
    const auto look_at = [&](std::string_view kind, const auto& list) {
        for (std::size_t i = 0; i < list.size() && too_large.empty(); ++i)
            if (footprint(list[i]) > budget) too_large = fmt::format("{} of frame {}", labeled(kind, i, list[i]), number);
    };
    look_at("texture", frame.textures);
    look_at("mesh", frame.meshes);
    look_at("emitter", frame.emitters);
    return too_large.empty() ? fmt::format("frame {} with {} draws", number, frame.draws.size()) : too_large;
}

}  // namespace strata
