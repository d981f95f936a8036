// A new type of light is a row of capture_format/light_types.h: code asks for a property, and few files name a type.
#include <algorithm>
#include <array>
#include <regex>
#include <set>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

struct NamesAType {
    std::string_view path, because;
};

/// This list only gets shorter. Scenarios and tests build lights, and are not on it.
constexpr std::array names_a_type = {
    NamesAType{"capture_format/frame/light.h", "the types"},
    NamesAType{"capture_format/light_types.h", "the table"},
    NamesAType{"capture_format/import/gltf_lights.cpp", "what glTF calls spot and directional"},
    NamesAType{"passes/scene/light_list.cpp", "for the device the sun is a directional light"},
    NamesAType{"passes/reference/shade.cpp", "for references, too: they derive their lights apart"},
    NamesAType{"passes/indirect/lpv/ratios.cpp", "lights of a frame that is measured"},
    NamesAType{"passes/shaders/capture_enums.cpp", "asserts the constants of shaders"},
    NamesAType{"passes/shaders/light_types.shared.h", "the table, for shaders"},
    NamesAType{"passes/shaders/area_lights.glsl", "the outline of an area light"},
    NamesAType{"passes/lighting/tile_cell.glsl", "bounds of area lights"},
    NamesAType{"passes/indirect/lpv/injection/inject.comp", "how wide an area light is seen"},
};

bool is_production(const SourceFile& file) {
    return file.folder() != "tests" && file.folder() != "captures" && !file.path.generic_string().ends_with("_test.cpp");
}

/// Production files with code that matches, of lines that hold the text.
std::set<std::string> files_with(std::string_view text, const std::regex& wanted) {
    const auto matches = [&](const std::string& line) {
        return line.find(text) != std::string::npos && std::regex_search(code_of(line), wanted);
    };
    std::set<std::string> found;
    for (const SourceFile& file : source_files())
        if (is_production(file) && std::ranges::any_of(file.lines, matches)) found.insert(file.path.generic_string());
    return found;
}

TEST(LightTypes, AreNamedByFewFiles) {
    std::set<std::string> allowed;
    for (const NamesAType& one : names_a_type) allowed.emplace(one.path);
    const std::string types = "(omni|round_spot|square_spot|tube|sphere|disc|rectangle|directional)\\b";
    std::set<std::string> found = files_with("LightType", std::regex("LightType::" + types + "|enum class LightType"));
    found.merge(files_with("light_", std::regex("\\blight_" + types)));
    for (const std::string& path : found)
        EXPECT_TRUE(allowed.contains(path)) << path << " names a type of light: ask capture_format/light_types.h for a property";
    for (const std::string& path : allowed) EXPECT_TRUE(found.contains(path)) << path << " names no type any more";
    EXPECT_LT(found.size(), 15u);
}

TEST(LightTypes, AreASpotInOnePlaceOnly) {
    EXPECT_EQ(files_with("is_spot(", std::regex("\\bbool (light_)?is_spot\\(")),
              (std::set<std::string>{"capture_format/light_types.h", "passes/shaders/light_types.shared.h"}));
}

TEST(LightTypes, AreListedForTheDeviceBySceneFactsOnly) {
    EXPECT_EQ(
        files_with("light_list(", std::regex("[^:]\\blight_list\\(")),
        (std::set<std::string>{"passes/scene/light_list.cpp", "passes/scene/light_list.h", "passes/scene/scene_facts.cpp"}));
}

}  // namespace
}  // namespace strata
