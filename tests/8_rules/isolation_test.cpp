// A technique is its folder and its line on the list: delete both and no trace is left.
#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"
#include "tests/8_rules/the_list.h"

namespace strata {
namespace {

/// Whether a rule about a technique's name looks at this file: not its own folder, not tests.
bool is_elsewhere(const SourceFile& file, const std::string& technique) {
    const std::string path = file.path.generic_string();
    return file.folder() != "tests" && !path.ends_with("_test.cpp") && !path.starts_with("passes/" + technique + "/");
}

/// Its name in code: "stage/name" as text or path, or the call stage::name(.
bool names(const std::string& code, const std::string& technique) {
    const auto ends_there = [&](std::size_t at) {
        const std::size_t end = at + technique.size();
        return end == code.size() || (!std::isalnum(static_cast<unsigned char>(code[end])) && code[end] != '_');
    };
    for (std::size_t at = code.find(technique); at != std::string::npos; at = code.find(technique, at + 1))
        if (ends_there(at)) return true;
    const std::size_t slash = technique.find('/');
    return code.find(technique.substr(0, slash) + "::" + technique.substr(slash + 1) + "(") != std::string::npos;
}

TEST(Isolation, ATechniquesNameOccursInItsFolderAndOnTheListOnly) {
    for (const std::string& technique : listed_techniques()) {
        for (const SourceFile& file : source_files()) {
            if (!is_elsewhere(file, technique)) continue;
            for (std::size_t line = 0; line < file.lines.size(); ++line)
                EXPECT_FALSE(names(code_of(file.lines[line]), technique))
                    << file.path.string() << ":" << line + 1 << " names " << technique << ": " << file.lines[line];
        }
    }
}

TEST(Isolation, NoTechniqueIncludesAnothersFolder) {
    const std::vector<std::string> all = technique_folders();
    for (const SourceFile& file : source_files()) {
        for (const std::string& line : file.lines) {
            for (const std::string& other : all) {
                const std::string folder = "passes/" + other + "/";
                const bool is_own = file.path.generic_string().starts_with(folder);
                if (is_own || file.folder() == "tests") continue;
                EXPECT_FALSE(included(line).starts_with(folder)) << file.path.string() << ": " << line;
            }
        }
    }
}

TEST(Isolation, NothingIsNamedForItsLackOfASubject) {
    for (const SourceFile& file : source_files())
        for (const auto& part : file.path)
            for (const char* empty_name : {"common", "core", "utils", "util", "misc", "helpers", "helper"})
                EXPECT_NE(part.stem().string(), empty_name) << file.path.string();
}

}  // namespace
}  // namespace strata
