// A glTF 2.0 scene (.gltf or .glb) becomes frames, one at a time: an animation of many frames is never in memory as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/frame/frame.h"
#include "capture_format/result.h"

namespace strata {

namespace gltf {
class Folder;
}
struct Texture;  // capture_format/frame/texture.h

struct GltfOptions {
    std::uint32_t width = 160, height = 90, samples = 1;
    std::int32_t camera = -1;  ///< index of a glTF camera; -1: the first, or a framing camera when there is none
    /// Degrees from the front (+z) towards the right (+x), and above the horizon: where the framing camera stands.
    std::optional<double> azimuth, elevation;  ///< default 22 and 16
    /// Where the eye is and what it looks at, in meters, instead of any camera; without a target the middle of the scene.
    std::optional<glm::dvec3> eye, target;
    /// Degrees from the bottom to the top of the picture, of all but the file's cameras; without it as the view needs.
    std::optional<double> fov;
    /// Factor from radiance to what the film sees; without it as the lights need.
    std::optional<float> exposure;
    bool inside = false;        ///< the camera stands within the scene where it sees farthest, as for a closed room
    std::optional<double> fps;  ///< frames per second of the animation, default 30
    std::string animation;      ///< by name or index; empty: the first one, if there is one
    /// Bytes that the file, its buffers, vertices and pictures may take in memory together, frames and what becomes of them until
    /// they are recorded among them; hostile files claim more. 0: half of the machine's memory.
    std::uint64_t memory_budget = 0;
    /// Takes each texture as soon as it is decoded, in the order of Frame::textures, so that one image at a time is in memory.
    /// Frames then have textures without their finest mips: up to 256 texels each way are left, enough for a thumbnail. An error
    /// ends the import. Without this, frames have whole textures.
    std::function<Result<void>(Texture)> take_texture;
};

class GltfScene {
public:
    /// Reads a file and what it refers to below its own folder. Fails with the name of a required extension that is not
    /// supported, with what is wrong in the file, or with the option that has no effect on it.
    static Result<GltfScene> open(const std::filesystem::path&, const GltfOptions&);
    /// The same for a file in memory. Opens no files: only a .glb's chunk and data URIs are read. The name is for sentences.
    static Result<GltfScene> open(std::span<const std::byte> bytes, const std::string& name, const GltfOptions&);
    GltfScene(GltfScene&&) noexcept;
    GltfScene& operator=(GltfScene&&) noexcept;
    ~GltfScene();

    /// The scene at index / fps seconds; an animation begins again after its last key. previous_to_world is the transform one
    /// frame earlier, that of the frame itself at index 0. A framing camera stands still and sees the whole animation; the
    /// exposure is that of frame 0. Fails for azimuth, elevation or fov where the file's own camera is used. Meshes that skins or
    /// morph targets move are new in every frame, the others are the same.
    Result<Frame> frame(std::uint32_t index);
    /// What was ignored and why, of the file and of the frames made so far.
    const std::vector<std::string>& warnings() const;

private:
    struct Contents;
    static Result<GltfScene> read(std::vector<std::byte> bytes, const gltf::Folder&, std::string name, const GltfOptions&);
    explicit GltfScene(std::unique_ptr<Contents>);
    std::unique_ptr<Contents> contents_;
};

struct ImportedScene {
    Frame frame;
    std::vector<std::string> warnings;  ///< what was ignored and why
};

/// The first frame of a scene.
Result<ImportedScene> import_gltf(const std::filesystem::path&, const GltfOptions&);

}  // namespace strata
