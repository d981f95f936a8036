// Includes go one way: ui -> replay -> passes -> capture_format; captures -> capture_format; tests -> everything.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

const std::map<std::string, std::set<std::string>> may_include = {
    {"capture_format", {"capture_format"}},
    {"captures", {"captures", "capture_format"}},
    {"passes", {"passes", "capture_format"}},
    {"replay", {"replay", "passes", "capture_format"}},
    {"ui", {"ui", "replay", "passes", "capture_format"}},
};

const std::set<std::string> capture_headers_of_passes = {"capture_format/frame.h",       "capture_format/frame_features.h",
                                                         "capture_format/light_types.h", "capture_format/nearest_name.h",
                                                         "capture_format/result.h",      "capture_format/view.h"};
const std::string parts_of_frames = "capture_format/frame/";

// The only folders that know a graphics API.
constexpr std::string_view vulkan_folders[] = {"replay/gpu/", "replay/isa/", "ui/window/", "tests/"};

std::string place(const SourceFile& file, std::size_t line) { return file.path.string() + ":" + std::to_string(line + 1); }

/// Calls visit(file, line number, included path) for every #include.
template <typename Visit>
void for_every_include(const Visit& visit) {
    for (const SourceFile& file : source_files())
        for (std::size_t line = 0; line < file.lines.size(); ++line)
            if (const std::string path = included(file.lines[line]); !path.empty()) visit(file, line, path);
}

std::string first_folder(const std::string& path) { return path.substr(0, path.find('/')); }

TEST(Layers, TheRulesSeeTheProject) { EXPECT_GT(source_files().size(), 50u); }

TEST(Layers, IncludesGoOneWay) {
    for_every_include([](const SourceFile& file, std::size_t line, const std::string& path) {
        const std::string to = first_folder(path), from = file.path.generic_string();
        const bool is_test = from.ends_with("_test.cpp");
        // `strata record` and `strata report --hard-cases` build their frames.
        const bool records_scenarios =
            (from.starts_with("replay/cli/") || from.starts_with("replay/report/hard_case")) && to == "captures";
        const auto rule = may_include.find(file.folder());
        if (is_test || records_scenarios) return;
        if (rule == may_include.end() || (!may_include.contains(to) && to != "tests")) return;
        EXPECT_TRUE(rule->second.contains(to)) << place(file, line) << " includes " << path;
    });
}

TEST(Layers, PassesKnowTheFrameAndNotTheFile) {
    for_every_include([](const SourceFile& file, std::size_t line, const std::string& path) {
        if (file.folder() != "passes" || first_folder(path) != "capture_format") return;
        if (file.path.generic_string().ends_with("_test.cpp")) return;
        EXPECT_TRUE(capture_headers_of_passes.contains(path) || path.starts_with(parts_of_frames))
            << place(file, line) << " includes " << path;
    });
}

/// "replay/session" of a file below it. Of a file that lies directly in replay its own name, "replay/plural": those of that
/// folder that others build on may lie beside those that build on others.
std::string room(const std::filesystem::path& path) {
    const auto second = std::next(path.begin());
    return first_folder(path.generic_string()) + "/" + (std::next(second) == path.end() ? second->stem() : *second).string();
}

/// The rooms of replay, ui and passes, each with those whose headers it includes, tests left out.
std::map<std::string, std::set<std::string>> rooms() {
    std::map<std::string, std::set<std::string>> includes;
    for_every_include([&](const SourceFile& file, std::size_t, const std::string& path) {
        const std::string folder = file.folder();
        if ((folder != "replay" && folder != "ui" && folder != "passes") || file.path.generic_string().ends_with("_test.cpp"))
            return;
        if (first_folder(path) == folder && room(path) != room(file.path)) includes[room(file.path)].insert(room(path));
    });
    return includes;
}

/// All that `from` includes, directly or not.
std::set<std::string> reached(const std::map<std::string, std::set<std::string>>& includes, const std::string& from) {
    std::set<std::string> found;
    std::vector<std::string> next = {from};
    while (!next.empty()) {
        const auto entry = includes.find(next.back());
        next.pop_back();
        if (entry == includes.end()) continue;
        for (const std::string& to : entry->second)
            if (found.insert(to).second) next.push_back(to);
    }
    return found;
}

TEST(Layers, FoldersOfReplayUiAndPassesIncludeEachOtherOneWay) {
    const auto includes = rooms();
    EXPECT_GT(includes.size(), 30u);
    for (const auto& [from, direct] : includes) {
        if (!std::filesystem::is_directory(std::filesystem::path(STRATA_SOURCE_DIR) / from)) continue;
        for (const std::string& to : direct)
            EXPECT_FALSE(reached(includes, to).contains(from)) << from << " includes " << to << ", which includes " << from;
    }
}

TEST(Layers, OnlyTheDeviceFoldersKnowVulkan) {
    for_every_include([](const SourceFile& file, std::size_t line, const std::string& path) {
        if (!path.starts_with("vulkan/") && !path.starts_with("vk_")) return;
        const std::string from = file.path.string();
        const bool allowed =
            std::ranges::any_of(vulkan_folders, [&](std::string_view folder) { return from.starts_with(folder); });
        EXPECT_TRUE(allowed) << place(file, line) << " includes " << path;
    });
}

TEST(Layers, OnlyTheDeviceFolderNamesVulkanInItsCode) {
    for (const SourceFile& file : source_files()) {
        if (file.folder() != "passes" && file.folder() != "capture_format") continue;
        for (std::size_t line = 0; line < file.lines.size(); ++line) {
            const std::string code = code_of(file.lines[line]);
            EXPECT_EQ(code.find("vk::"), std::string::npos) << place(file, line);
        }
    }
}

TEST(Layers, ProjectFilesAreIncludedByTheirFullPath) {
    for_every_include([](const SourceFile& file, std::size_t line, const std::string& path) {
        const bool is_ours = file.lines[line].find('"') != std::string::npos;
        if (!is_ours || path.find('/') != std::string::npos) return;
        ADD_FAILURE() << place(file, line) << " includes \"" << path << "\": say where it lives, or use <>";
    });
}

}  // namespace
}  // namespace strata
