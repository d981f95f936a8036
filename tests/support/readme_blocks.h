// The blocks of code and of commands in a Markdown file: tests compile and run what a reader would copy.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strata {

/// A fenced block, or one that is indented by four spaces.
struct ReadmeBlock {
    std::string section;   ///< the heading above it, without "#"
    std::string language;  ///< after the fence; empty for indented blocks
    std::vector<std::string> lines;
    std::size_t line = 0;  ///< the number of its first line in the file, from 1

    std::string text() const;
};
std::vector<ReadmeBlock> blocks_of(std::string_view markdown);

/// A command and what it printed, as far as the file shows that.
struct ReadmeCommand {
    std::string text;                 ///< without what is said of it, two or more spaces to its right
    std::vector<std::string> output;  ///< where commands begin with "$ "
    std::size_t line = 0;             ///< of the file
};
/// The commands of indented blocks that run one of these programs. A line that ends with a backslash goes on in the next.
std::vector<ReadmeCommand> commands_of(const ReadmeBlock&, const std::vector<std::string>& programs);

}  // namespace strata
