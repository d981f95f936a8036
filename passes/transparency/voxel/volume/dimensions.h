// How large the volume is that the device makes: its slices, words and columns, from what is asked for. The model derives its
// own.
#pragma once

#include "passes/graph/step.h"
#include "passes/transparency/voxel/voxel.shared.h"
#include "passes/transparency/voxel/voxel_params.h"

namespace strata {

class Features;    // capture_format/frame_features.h
class SceneFacts;  // passes/scene/scene_facts.h
class Settings;    // passes/settings.h

}  // namespace strata

namespace strata::transparency {

/// What is asked for. Blocks have no slices for interface layers: where a frame has some, a sparse volume is adaptive.
VoxelParams voxel_params(const Settings&, const SceneFacts&);

/// The same parameters with the number of slices that a frame's world has, or all of its volume: interface layers have one each
/// in front of the world's, up to the highest, and the world has fewer than asked for where there would be more than most_slices.
VoxelParams of_world(VoxelParams, const SceneFacts&);
VoxelParams of_volume(VoxelParams, const SceneFacts&);

/// Whether soft particles are thick. What multiplies has one slice for each triangle.
bool has_segments(const VoxelParams&);

/// Of a texel of the prepass, of all channels.
std::uint32_t voxel_words(const VoxelParams&, std::uint32_t channels);
/// Of the prepass: what `resolution` says, doubled until the volume is at most 512 MiB, or a sparse one's pool has a block for
/// every tile and channel.
std::uint32_t voxel_divisor(const VoxelParams&, Extent, std::uint32_t channels);

/// `tint` where T(z) has one channel.
std::uint32_t voxel_tint(const VoxelParams&, const Features&);

}  // namespace strata::transparency
