// An assert is for our own mistakes: a release build does not have it. What a library or the system returns is checked in every
// build.
#include <algorithm>
#include <regex>
#include <span>

#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

/// Whether an assert looks at what a library of C or the system returns; these call nothing by a name of C++.
bool asserts_a_result(const std::string& code) {
    static const std::regex call(R"(\bassert\b[^;]*(\b(ZSTD|XXH|exr|libdeflate|stbi|meshopt|sqlite3|glfw|vk)\w*|[^\w>]::\w+)\()");
    return code.find("assert(") != code.npos && std::regex_search(code, call);
}

TEST(Asserts, AreOfNoResultOfALibraryOrOfTheSystem) {
    EXPECT_TRUE(asserts_a_result("    assert(!ZSTD_isError(left));"));
    EXPECT_TRUE(asserts_a_result("assert(::close(file) == 0);"));
    EXPECT_FALSE(asserts_a_result("assert(std::ranges::is_sorted(names));"));
    EXPECT_FALSE(asserts_a_result("assert(left > 0); ZSTD_isError(left);"));
    for (const SourceFile& file : source_files()) {
        if (file.folder() == "tests" || is_shader(file)) continue;
        for (std::size_t line = 0; line < file.lines.size(); ++line)
            EXPECT_FALSE(asserts_a_result(code_of(file.lines[line]))) << file.path.string() << ":" << line + 1;
    }
}

/// A call without its check is found where all calls are.
TEST(Asserts, ZstdIsCalledInOneFile) {
    for (const SourceFile& file : source_files())
        for (const std::string& line : file.lines) {
            if (file.folder() == "tests" || !included(line).starts_with("zstd")) continue;
            EXPECT_EQ(file.path.generic_string(), "capture_format/container/compression.cpp");
        }
}

/// The words of any other exception say what is wrong with a file; of this one they would say that it is damaged.
TEST(Exceptions, ThatBecomeASentenceAreNoLackOfMemory) {
    int found = 0;
    for (const SourceFile& file : source_files())
        for (std::size_t line = 0; line < file.lines.size(); ++line) {
            if (file.folder() == "tests" || file.lines[line].find("catch (const std::exception& ") == std::string::npos) continue;
            const std::size_t first = line - std::min<std::size_t>(line, 5);
            const auto before = std::span(file.lines).subspan(first, line - first);
            const bool is_told_apart = std::ranges::any_of(
                before, [](const std::string& text) { return text.find("catch (const std::bad_alloc&)") != text.npos; });
            EXPECT_TRUE(is_told_apart) << file.path.string() << ":" << line + 1 << ": catch std::bad_alloc before";
            ++found;
        }
    EXPECT_GE(found, 5);
}

}  // namespace
}  // namespace strata
