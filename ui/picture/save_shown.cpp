#include "ui/picture/save_shown.h"

#include <cctype>

#include <nlohmann/json.hpp>

#include "capture_format/container/whole_file.h"
#include "capture_format/reader.h"
#include "replay/json_text.h"
#include "ui/picture/look_bytes.h"

namespace strata::ui {
namespace {

std::vector<std::byte> bytes_of(const ShownImage& shown) {
    const Extent& extent = shown.image->shape.extent;
    std::vector<std::byte> rgb;
    rgb.reserve(std::size_t{3} * extent.width * extent.height);
    for (std::uint32_t y = 0; y < extent.height; ++y)
        for (std::uint32_t x = 0; x < extent.width; ++x) {
            const auto bytes = shown_bytes(shown.look, texel(*shown.image, x, y, shown.layer));
            rgb.insert(rgb.end(), bytes.begin(), bytes.end());
        }
    return rgb;
}

}  // namespace

std::filesystem::path free_path(const std::filesystem::path& folder, const std::string& stem) {
    const auto is_taken = [](const std::filesystem::path& path) {
        for (const char* extension : {".exr", ".png", ".json"})
            if (std::filesystem::exists(path.string() + extension)) return true;
        return false;
    };
    std::filesystem::path path = folder / stem;
    for (int number = 2; is_taken(path); ++number) path = folder / fmt::format("{}_{}", stem, number);
    return path;
}

std::string text(const Look& look) {
    constexpr const char* channels[] = {"RGB", "R", "G", "B", "A", "luminance", "false color"};
    return fmt::format("exposure={} black={} white={} channels={} curve={}", look.exposure, look.black, look.white,
                       channels[static_cast<std::size_t>(look.channels)], look.curve == Curve::srgb ? "sRGB" : "raw");
}

std::string stem_of(const std::filesystem::path& capture, std::size_t frame, std::string_view image) {
    std::string stem = fmt::format("{}_{}_{}", capture.stem().string(), frame, image);
    for (char& c : stem)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
    return stem;
}

Result<std::filesystem::path> save(const std::filesystem::path& folder, const std::string& stem, const ShownImage& shown) {
    const std::filesystem::path path = free_path(folder, stem);
    Metadata provenance = shown.provenance;
    provenance["strata.image"] = shown.name;
    provenance["strata.look"] = text(shown.look);
    if (const auto done = write_exr(path.string() + ".exr", {{shown.name, *shown.image}}, provenance); !done) return done.error();
    if (const auto done = write_png(path.string() + ".png", shown.image->shape.extent, bytes_of(shown)); !done)
        return done.error();
    const std::string json = json_text(nlohmann::ordered_json(provenance));
    if (const auto done = write_whole_file(path.string() + ".json", json); !done) return done.error();
    return path;
}

}  // namespace strata::ui
