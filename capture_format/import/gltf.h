// A glTF 2.0 scene (.gltf or .glb) becomes a frame.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata {

struct GltfOptions {
    std::uint32_t width = 160, height = 90, samples = 1;
    std::int32_t camera = -1;  ///< index of a glTF camera; -1: the first, or a framing camera when there is none
    /// Degrees from the front (+z) towards the right (+x), and above the horizon: where the framing camera stands.
    double azimuth = 22, elevation = 16;
};

struct ImportedScene {
    Frame frame;
    std::vector<std::string> warnings;  ///< what was ignored and why
};

/// Fails with the name of a required extension that is not supported, or with what is wrong in the file.
Result<ImportedScene> import_gltf(const std::filesystem::path&, const GltfOptions&);

}  // namespace strata
