#include "ui/window/layout.h"

#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "capture_format/container/whole_file.h"

namespace strata::ui {
namespace {

constexpr int least_width = 640, least_height = 480;

}  // namespace

void remember_size(Layout& layout, int width, int height) {
    if (width < least_width || height < least_height) return;
    layout.width = width;
    layout.height = height;
}

std::optional<std::filesystem::path> layout_file(const char* state_home, const char* home) {
    if (state_home && *state_home) return std::filesystem::path(state_home) / "strata" / "inspector.json";
    if (home && *home) return std::filesystem::path(home) / ".local" / "state" / "strata" / "inspector.json";
    return {};
}

Layout read_layout(const std::filesystem::path& path) {
    Layout layout;
    std::ifstream file(path);
    const auto json = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) return layout;
    const auto read = [&](const char* key, auto& number, auto low, auto high) {
        if (json.contains(key) && json[key].is_number())
            number = std::clamp(json[key].get<std::decay_t<decltype(number)>>(), low, high);
    };
    read("left", layout.left, 120.0f, 2000.0f);
    read("right", layout.right, 120.0f, 2000.0f);
    read("bottom", layout.bottom, 60.0f, 2000.0f);
    read("width", layout.width, least_width, 16384);
    read("height", layout.height, least_height, 16384);
    if (json.contains("settings") && json["settings"].is_object())
        for (const auto& [key, value] : json["settings"].items())
            if (value.is_boolean()) layout.settings[key] = value.get<bool>();
    return layout;
}

Result<void> write_layout(const std::filesystem::path& path, const Layout& layout) {
    std::error_code problem;
    std::filesystem::create_directories(path.parent_path(), problem);
    if (problem)
        return fail(Fault::usage, "file.cannot_make_folder", "cannot make the folder {folder}: {reason}",
                    path.parent_path().string(), problem.message());
    const nlohmann::ordered_json json{{"left", layout.left},   {"right", layout.right},   {"bottom", layout.bottom},
                                      {"width", layout.width}, {"height", layout.height}, {"settings", layout.settings}};
    return write_whole_file(path, json.dump(2) + "\n");
}

}  // namespace strata::ui
