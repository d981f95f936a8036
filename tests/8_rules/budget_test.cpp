// Header 150 lines, source 400, shader 200: above that ask, above double split.
#include <gtest/gtest.h>

#include "tests/8_rules/source_files.h"

namespace strata {
namespace {

std::size_t budget(const SourceFile& file) {
    if (is_header(file)) return 150;
    return is_shader(file) ? 200 : 400;
}

TEST(Budgets, NoFileIsTwiceAsLongAsItMayBe) {
    for (const SourceFile& file : source_files())
        EXPECT_LE(file.lines.size(), 2 * budget(file)) << file.path.string() << " wants to be split";
}

TEST(Budgets, NoLineRunsOffThePage) {
    for (const SourceFile& file : source_files())
        for (std::size_t line = 0; line < file.lines.size(); ++line)
            EXPECT_LE(file.lines[line].size(), 160u) << file.path.string() << ":" << line + 1;
}

TEST(Budgets, EveryHeaderBeginsByWhatItIsFor) {
    for (const SourceFile& file : source_files()) {
        if (!is_header(file) || file.lines.empty()) continue;
        EXPECT_TRUE(file.lines.front().starts_with("//")) << file.path.string();
    }
}

}  // namespace
}  // namespace strata
