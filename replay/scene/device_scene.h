// The scene's buffers on the device, and how a graph gets at them.
#pragma once

#include <array>
#include <map>

#include "replay/gpu/executor.h"
#include "replay/scene/scene_records.h"

namespace strata {

struct FrameImages;  // passes/frame_images.h

class DeviceScene {
public:
    explicit DeviceScene(Executor& executor) : executor_(&executor) {}

    /// What import_into() speaks of, before any of it is on the device.
    void describe(const SceneRecords&);
    /// Describes the scene and uploads those of its buffers whose bytes differ from what the device holds.
    void upload(const SceneRecords&);
    /// Takes everything off the device.
    void forget();
    /// Sizes of the buffers described.
    const std::vector<std::uint64_t>& bytes() const { return bytes_; }
    /// Imports the buffers, offers them by their block names, and fills in the draw lists.
    void import_into(Graph&, FrameImages&) const;

private:
    Executor* executor_;
    std::vector<std::uint64_t> bytes_;  ///< by row of the buffer table
    /// XXH3-128 of what is on the device, by row of the buffer table: meshes and textures of a recording seldom change.
    std::map<std::size_t, std::array<std::uint64_t, 2>> uploaded_;
    CommandRange opaque_, casters_, transparent_, numbered_, separate_, back_to_front_;
};

/// Import ids below this belong to the scene, those from here to first_free_import to given outputs (Declaration::given).
inline constexpr std::uint64_t first_given_import = 50;
inline constexpr std::uint64_t first_free_import = 100;

}  // namespace strata
