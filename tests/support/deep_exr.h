// Deep OpenEXR files for tests, written by OpenEXR itself; and what its own compositing makes of a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace strata {

enum class DeepLayout { lines, tiles };
enum class DeepPacking { none, rle, zips };

/// A deep image: for every pixel of the data window, row by row, its samples, each a value per channel.
struct DeepSource {
    std::vector<std::string> channels = {"R", "G", "B", "A", "Z"};  ///< floats; "Z:half" and "Z:uint" are stored as those
    std::uint32_t width = 1, height = 1;
    glm::ivec2 at{0};                           ///< the data window's corner
    glm::ivec2 display_from{0}, display_to{0};  ///< inclusive; equal: the data window
    std::vector<std::vector<std::vector<float>>> pixels;
    DeepLayout layout = DeepLayout::lines;
    DeepPacking packing = DeepPacking::zips;
};

/// The file's bytes.
std::string deep_file(const DeepSource&);
/// Several images as named parts, all in lines.
std::string deep_file(const std::vector<std::pair<std::string, DeepSource>>& parts);
/// One image of depth 0 that is not deep, whose data window begins at a place of the display window.
std::string flat_file(std::uint32_t width, std::uint32_t height, glm::ivec2 at = glm::ivec2(0));

/// What Imf::CompositeDeepScanLine makes of a file: RGB and A in float, row by row from the data window's corner.
struct OpenExrComposite {
    std::vector<glm::vec4> texels;
    glm::ivec2 from{0};
    std::size_t width = 0;
};
OpenExrComposite openexr_composite(const std::filesystem::path&);

}  // namespace strata
