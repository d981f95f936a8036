// A model judges what the device computes, so nothing that feeds the device may call it: a mistake would be in both.
#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

// No models, and why they may call one.
const std::map<std::string, std::string> exceptions = {
    {"passes/lighting/tiled/cull_scene.h", "makes what the mirror of culling reads; only the model makes one"},
    {"passes/indirect/volume_light.cpp", "the light of volumes that truth and models of transparency start from"}};

/// "model.h", "tint_model.cpp", "cull_mirror.h".
bool is_model(const std::filesystem::path& path) {
    const std::string stem = path.stem().string();
    return stem == "model" || stem.ends_with("_model") || stem.ends_with("_mirror");
}

bool may_call_models(const SourceFile& file) {
    const std::string stem = file.path.stem().string();
    return file.folder() == "tests" || stem.ends_with("_test") || stem == "truth" || stem == "judge" || is_model(file.path);
}

/// The models' headers that a file includes. The inspector's ui/model.h is no model of a technique.
std::vector<std::string> included_models(const SourceFile& file) {
    std::vector<std::string> found;
    for (const std::string& line : file.lines)
        if (const std::string path = included(line); path.starts_with("passes/") && is_model(path)) found.push_back(path);
    return found;
}

TEST(Models, AreCalledByModelsTruthsJudgesAndTestsOnly) {
    for (const SourceFile& file : source_files()) {
        if (may_call_models(file) || exceptions.contains(file.path.generic_string())) continue;
        for (const std::string& model : included_models(file))
            ADD_FAILURE() << file.path.string() << " includes " << model
                          << ": move what the device needs to a file of its own, and let the model derive its own";
    }
}

TEST(Models, HaveExceptionsOnlyWhereOneIsNeeded) {
    for (const auto& [path, reason] : exceptions) {
        const auto file = std::ranges::find(source_files(), path, [](const SourceFile& f) { return f.path.generic_string(); });
        ASSERT_NE(file, source_files().end()) << path;
        EXPECT_FALSE(included_models(*file).empty()) << path << " includes no model any more";
        EXPECT_FALSE(reason.empty()) << path;
    }
}

/// Functions that a line of a source declares without defining them: "name(".
bool declares(const std::string& line, const std::string& function) {
    return line.ends_with(");") && line.find(" " + function + "(") != std::string::npos && line.find_first_of(" \t") > 0 &&
           line.find('=') == std::string::npos && line.find("return") == std::string::npos;
}

// A declaration without a header would get around the rule above. A technique names its model's function; nothing else.
TEST(Models, AreNotDeclaredAgainButForTheFunctionATechniqueNames) {
    std::map<std::string, std::string> functions;  // by name, the header
    for (const SourceFile& file : source_files()) {
        if (!is_model(file.path) || !is_header(file) || file.folder() != "passes") continue;
        for (const std::string& line : file.lines) {
            const std::size_t open = line.find('(');
            if (open == std::string::npos || line.starts_with(' ') || line.starts_with('/') || line.starts_with('#')) continue;
            const std::size_t before = line.find_last_of(" *&", open);
            if (before == std::string::npos) continue;
            const std::string name = line.substr(before + 1, open - before - 1);
            if (!name.empty() && !name.ends_with("_model")) functions[name] = file.path.string();
        }
    }
    ASSERT_GT(functions.size(), 20u) << "no functions were found";
    for (const SourceFile& file : source_files()) {
        if (file.folder() != "passes" || may_call_models(file) || is_header(file) || is_shader(file)) continue;
        for (const std::string& line : file.lines)
            for (const auto& [name, header] : functions)
                EXPECT_FALSE(!line.starts_with(' ') && declares(code_of(line), name))
                    << file.path.string() << " declares " << name << " of " << header << ": " << line;
    }
}

}  // namespace
}  // namespace strata
