// What C++ and shaders share stands in *.shared.h, and nothing else does: a struct that no shader reads is a plain header's.
// Enums of a capture that shaders read as numbers have one constant each there, which passes/shaders/capture_enums.cpp asserts.
#include <algorithm>
#include <cctype>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

bool is_shared(const SourceFile& file) { return file.path.generic_string().ends_with(".shared.h"); }

bool is_of_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// The words of the code of a line.
std::vector<std::string> words_of(const std::string& line) {
    const std::string code = code_of(line);
    std::vector<std::string> words;
    for (std::size_t at = 0; at < code.size();) {
        std::size_t end = at;
        while (end < code.size() && is_of_a_word(code[end])) ++end;
        if (end > at) words.push_back(code.substr(at, end - at));
        at = std::max(end, at + 1);
    }
    return words;
}

std::set<std::string> words_of_shaders() {
    std::set<std::string> words;
    for (const SourceFile& file : source_files())
        if (is_shader(file))
            for (const std::string& line : file.lines)
                for (std::string& word : words_of(line)) words.insert(std::move(word));
    return words;
}

/// What the structs of shared headers are made of, by name.
std::map<std::string, std::set<std::string>> shared_structs() {
    std::map<std::string, std::set<std::string>> structs;
    for (const SourceFile& file : source_files()) {
        if (!is_shared(file)) continue;
        std::set<std::string>* open = nullptr;
        for (const std::string& line : file.lines) {
            const std::vector<std::string> words = words_of(line);
            if (line.starts_with("struct ")) open = &structs[words.at(1)];
            if (open && !line.starts_with("struct ")) open->insert(words.begin(), words.end());
            if (line.starts_with("};")) open = nullptr;
        }
    }
    return structs;
}

TEST(SharedHeaders, HoldNoStructThatNoShaderReads) {
    const auto structs = shared_structs();
    ASSERT_GT(structs.size(), 50u) << "the structs were not found";
    std::set<std::string> read = words_of_shaders();
    for (std::size_t before = 0; before != read.size();) {
        before = read.size();
        for (const auto& [name, words] : structs)
            if (read.contains(name)) read.insert(words.begin(), words.end());
    }
    for (const auto& [name, words] : structs)
        EXPECT_TRUE(read.contains(name)) << "no shader reads " << name << ": a plain header or the .cpp can have it";
}

struct CapturedEnum {
    std::string_view name, prefix;  ///< of its constants in GLSL
    std::string_view fields;        ///< that hold it in records and shaders
};

constexpr CapturedEnum captured_enums[] = {
    {"LightType", "light_", "type"},    {"LightingModel", "model_", "lighting_model"}, {"AlphaMode", "alpha_", "alpha_mode"},
    {"FogPath", "fog_by_", "fog_path"}, {"TextureFormat", "texture_", "format"},       {"AddressMode", "address_", "sampling"},
    {"MipFilter", "mip_", "sampling"},  {"RangeWindow", "window_", "light.window"},
};

std::vector<std::string> enumerators(std::string_view of) {
    std::vector<std::string> found;
    for (const SourceFile& file : source_files()) {
        if (file.folder() != "capture_format") continue;
        bool is_open = false;
        for (const std::string& line : file.lines) {
            const bool opens = line.starts_with("enum class " + std::string(of) + " ");
            is_open |= opens;
            if (!is_open) continue;
            const std::string list = opens ? line.substr(std::min(line.find('{'), line.size())) : line;
            for (const std::string& word : words_of(list)) found.push_back(word);
            if (line.find("};") != std::string::npos) is_open = false;
        }
    }
    return found;
}

struct Definition {
    std::string path, value;
    bool is_shared = false;
};

/// Every "const uint NAME = VALUE;" of shaders and shared headers.
std::multimap<std::string, Definition> constants_of_shaders() {
    std::multimap<std::string, Definition> constants;
    for (const SourceFile& file : source_files()) {
        if (!is_shader(file) && !is_shared(file)) continue;
        for (const std::string& line : file.lines) {
            const std::string code = code_of(line);
            const std::size_t at = code.find("const uint ");
            const std::size_t equals = code.find(" = ", at);
            if (at == std::string::npos || equals == std::string::npos) continue;
            constants.emplace(code.substr(at + 11, equals - at - 11),
                              Definition{file.path.generic_string(), code.substr(equals + 3), is_shared(file)});
        }
    }
    return constants;
}

std::string asserted_enums() {
    const auto file = std::ranges::find(source_files(), "passes/shaders/capture_enums.cpp",
                                        [](const SourceFile& f) { return f.path.generic_string(); });
    std::string text;
    if (file != source_files().end())
        for (const std::string& line : file->lines) text += line + "\n";
    return text;
}

TEST(CapturedEnums, HaveOneConstantInGlslWhichTheBuildAsserts) {
    const auto constants = constants_of_shaders();
    const std::string asserted = asserted_enums();
    std::size_t found = 0;
    for (const CapturedEnum& one : captured_enums) {
        ASSERT_GT(enumerators(one.name).size(), 1u) << one.name;
        for (const std::string& enumerator : enumerators(one.name)) {
            const std::string constant = std::string(one.prefix) + enumerator;
            const auto [first, last] = constants.equal_range(constant);
            if (first == last) continue;
            ++found;
            EXPECT_EQ(std::distance(first, last), 1) << constant << " has a private copy in " << std::prev(last)->second.path;
            EXPECT_TRUE(first->second.is_shared) << first->second.path << ": C++ does not see " << constant;
            const std::string assertion = constant + " == in_glsl(" + std::string(one.name) + "::" + enumerator + ")";
            EXPECT_NE(asserted.find(assertion), std::string::npos) << "capture_enums.cpp does not assert " << assertion;
        }
    }
    EXPECT_EQ(found, 35u) << "constants of captured enums";
}

TEST(CapturedEnums, AreNoBareNumbersInShaders) {
    std::string fields;
    for (const CapturedEnum& one : captured_enums) fields += (fields.empty() ? "" : "|") + std::string(one.fields);
    const std::string compared = " *([=!<>]=|[<>]) *";
    const std::regex compares("\\b(" + fields + ")" + compared + "[0-9]|[0-9]u?" + compared + "([a-z_]+\\.)?(" + fields + ")\\b");
    ASSERT_TRUE(std::regex_search("if (light.type >= 3u) return;", compares));
    ASSERT_TRUE(std::regex_search("return 5u == m.alpha_mode;", compares));
    for (const SourceFile& file : source_files()) {
        if (!is_shader(file) && !is_shared(file)) continue;
        for (std::size_t line = 0; line < file.lines.size(); ++line) {
            const std::string code = code_of(file.lines[line]);
            if (std::ranges::none_of(captured_enums,
                                     [&](const CapturedEnum& one) { return code.find(one.fields) != std::string::npos; }))
                continue;
            EXPECT_FALSE(std::regex_search(code, compares)) << file.path.string() << ":" << line + 1 << ": " << code;
        }
    }
}

}  // namespace
}  // namespace strata
