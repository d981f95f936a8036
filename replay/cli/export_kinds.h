// What `strata export` can make of a frame: one function per kind.
#pragma once

#include <optional>

#include "replay/cli/verb_options.h"

namespace strata {

struct ExportOptions {
    OpenOptions open;
    ChoiceOptions choices;
    std::size_t frame = 0;
    std::vector<std::string> images;  ///< --image
    bool deep = false, gltf = false, json = false;
    bool caption = false;                 ///< --caption
    std::optional<std::uint32_t> sample;  ///< --sample
    std::string transmittance = "refused";
    std::filesystem::path output;
};

/// Every transparent fragment in front of the replayed depth, as a deep image.
Result<void> export_deep(const ExportOptions&);
/// Frame images or debug views: all of them as parts of an .exr, or one as a .png.
Result<void> export_images(const ExportOptions&);
/// The scene as a self-contained .glb; what glTF cannot say is printed.
Result<void> export_scene(const ExportOptions&);
/// The frame as JSON, with the field names of the schema; bulk data by its hashes.
Result<void> export_json(const ExportOptions&);

}  // namespace strata
