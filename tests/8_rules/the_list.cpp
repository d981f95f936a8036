#include "tests/8_rules/the_list.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

namespace strata {
namespace {

/// A technique's folder and its source have one name; a room of a stage holds what its techniques share.
bool has_own_source(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / (folder.filename().string() + ".cpp"));
}

}  // namespace

std::vector<std::string> listed_techniques() {
    std::ifstream file(std::filesystem::path(STRATA_SOURCE_DIR) / "passes/CMakeLists.txt");
    std::vector<std::string> names;
    bool inside = false;
    for (std::string line; std::getline(file, line);) {
        line = line.substr(0, line.find('#'));
        std::erase(line, ' ');
        if (line == ")") inside = false;
        if (inside && !line.empty()) names.push_back(line);
        if (line.starts_with("add_techniques(")) inside = true;
    }
    return names;
}

std::vector<std::string> technique_folders() {
    const std::set<std::string> no_stages = {"graph", "reference", "scene", "shaders", "views"};
    const std::filesystem::path passes = std::filesystem::path(STRATA_SOURCE_DIR) / "passes";
    std::vector<std::string> folders;
    for (const auto& stage : std::filesystem::directory_iterator(passes)) {
        if (!stage.is_directory() || no_stages.contains(stage.path().filename().string())) continue;
        for (const auto& technique : std::filesystem::directory_iterator(stage.path()))
            if (has_own_source(technique.path())) folders.push_back(technique.path().lexically_relative(passes).generic_string());
    }
    std::ranges::sort(folders);
    return folders;
}

}  // namespace strata
