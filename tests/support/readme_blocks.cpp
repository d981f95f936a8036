#include "tests/support/readme_blocks.h"

#include <algorithm>
#include <sstream>

namespace strata {
namespace {

constexpr std::string_view fence = "```", indentation = "    ";

std::string without_end_spaces(std::string text) {
    text.erase(text.find_last_not_of(' ') + 1);
    return text;
}

/// A line of a block as the command that it is: two spaces begin what is said of it.
std::string command_in(const std::string& line) { return without_end_spaces(line.substr(0, line.find("  "))); }

}  // namespace

std::string ReadmeBlock::text() const {
    std::string text;
    for (const std::string& each : lines) text += each + "\n";
    return text;
}

std::vector<ReadmeBlock> blocks_of(std::string_view markdown) {
    std::istringstream stream{std::string(markdown)};
    std::vector<ReadmeBlock> blocks;
    std::string section;
    bool fenced = false, indented = false, after_blank = true;
    std::size_t number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        if (line.starts_with(fence)) {
            fenced = !fenced;
            if (fenced) blocks.push_back({section, line.substr(fence.size()), {}, number + 1});
        } else if (fenced) {
            blocks.back().lines.push_back(line);
        } else if (line.starts_with(indentation) && (indented || after_blank)) {
            if (!indented) blocks.push_back({section, "", {}, number});
            blocks.back().lines.push_back(line.substr(indentation.size()));
            indented = true;
        } else {
            indented = false;
            if (line.starts_with("#")) section = line.substr(std::min(line.size(), line.find_first_not_of("# ")));
        }
        after_blank = line.empty();
    }
    return blocks;
}

std::vector<ReadmeCommand> commands_of(const ReadmeBlock& block, const std::vector<std::string>& programs) {
    std::vector<ReadmeCommand> commands;
    if (!block.language.empty()) return commands;
    const bool prompts = std::ranges::any_of(block.lines, [](const std::string& line) { return line.starts_with("$ "); });
    bool goes_on = false;
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
        const std::string& line = block.lines[i];
        if (goes_on) {
            commands.back().text += command_in(line.substr(std::min(line.size(), line.find_first_not_of(' '))));
        } else if (prompts && !line.starts_with("$ ")) {
            if (!commands.empty()) commands.back().output.push_back(line);
            continue;
        } else {
            const std::string command = command_in(prompts ? line.substr(2) : line);
            const bool runs = std::ranges::any_of(
                programs, [&](const std::string& program) { return command == program || command.starts_with(program + " "); });
            if (!runs) continue;
            commands.push_back({command, {}, block.line + i});
        }
        goes_on = commands.back().text.ends_with('\\');
        if (goes_on) commands.back().text.pop_back();
    }
    return commands;
}

}  // namespace strata
