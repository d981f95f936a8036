// What is shown, as files: the image's own numbers as an EXR, what the screen makes of them as a PNG, and where they come from
// beside them (a PNG here has no text).
#pragma once

#include <filesystem>

#include "replay/expectations/provenance.h"
#include "ui/window/imgui_layer.h"

namespace strata::ui {

struct ShownImage {
    std::string name;  ///< of the image
    std::shared_ptr<const HostImage> image;
    std::uint32_t layer = 0;  ///< of the PNG; the EXR has all
    Look look;
    Metadata provenance;
};

/// Writes STEM.exr, STEM.png and STEM.json, numbered where there are such files; the path without extension.
Result<std::filesystem::path> save(const std::filesystem::path& folder, const std::string& stem, const ShownImage&);

/// The first of STEM, STEM_2, STEM_3, ... of which there is no file.
std::filesystem::path free_path(const std::filesystem::path& folder, const std::string& stem);
/// "smoke_0_transparency_moments_motion": of a capture, a frame and an image.
std::string stem_of(const std::filesystem::path& capture, std::size_t frame, std::string_view image);
/// "exposure=1 black=0 white=1 channels=RGB curve=sRGB".
std::string text(const Look&);

}  // namespace strata::ui
