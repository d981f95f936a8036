// The README's program that records is a file, word for word; tests/1_consumer builds and runs it.
#include <filesystem>

#include <gmock/gmock.h>

#include "tests/support/file_text.h"
#include "tests/support/readme_blocks.h"

namespace strata {
namespace {

using testing::ElementsAre;

TEST(ReadmeBlocks, CommandsStandBeforeWhatIsSaidOfThemAndBeforeWhatTheyPrint) {
    const auto blocks = blocks_of(
        "# One\n\n    run a     says\n            more\n    other b\n    run c \\\n        d\n\ntext\n    no\n"
        "## Two\n```cpp\nint i;\n```\n\n    $ run e\n    run f\n    ...\n");
    ASSERT_EQ(blocks.size(), 3u);
    EXPECT_EQ(blocks[1].section, "Two");
    EXPECT_EQ(blocks[1].language, "cpp");
    EXPECT_EQ(blocks[1].text(), "int i;\n");
    const auto commands = commands_of(blocks[0], {"run"}), shown = commands_of(blocks[2], {"run"});
    ASSERT_EQ(commands.size(), 2u);
    EXPECT_EQ(commands[0].text, "run a");
    EXPECT_EQ(commands[1].text, "run c d");
    EXPECT_EQ(commands[1].line, 6u);
    ASSERT_EQ(shown.size(), 1u);
    EXPECT_THAT(shown[0].output, ElementsAre("run f", "..."));
}

TEST(Readme, ItsProgramThatRecordsIsTheExample) {
    const std::filesystem::path source = STRATA_SOURCE_DIR, example = source / "docs/examples/recording";
    std::vector<std::string> fenced;
    for (const ReadmeBlock& block : blocks_of(file_text(source / "README.md")))
        if (!block.language.empty()) fenced.push_back(block.text());
    EXPECT_THAT(fenced, ElementsAre(file_text(example / "CMakeLists.txt"), file_text(example / "main.cpp")));
}

}  // namespace
}  // namespace strata
