// A frame as a glTF 2.0 file for other programs: meshes, materials, textures, draws, punctual lights and the camera.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "capture_format/result.h"

namespace strata {

struct Frame;  // capture_format/frame.h

struct ExportedScene {
    std::vector<std::byte> glb;
    std::vector<std::string> warnings;  ///< what of the frame glTF cannot say, by kind and number
};

/// A self-contained .glb. Reading it back gives the same draws, meshes, materials, lights and camera within float rounding, but
/// for what the warnings name. Transmission is written with KHR_materials_transmission, _volume and _ior so that the color that
/// goes through is the same. The first directional light is the sun. Fails (usage) for more than the 4 GiB a .glb can hold.
Result<ExportedScene> to_gltf(const Frame&);

/// The same into a file, which is written whole or not at all. Returns the warnings.
Result<std::vector<std::string>> export_gltf(const Frame&, const std::filesystem::path&);

}  // namespace strata
