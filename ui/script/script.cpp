#include "ui/script/script.h"

#include <algorithm>
#include <charconv>

#include "capture_format/nearest_name.h"

namespace strata::ui {
namespace {

using Words = std::vector<std::string>;

/// What a command works with.
struct Hands {
    Player& player;
    const std::filesystem::path& folder;
};

struct Command {
    std::string_view name, takes;
    std::size_t words;  ///< after its name
    Result<void> (*play)(Hands&, const Words&);
};

Result<double> number(const std::string& word) {
    double value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size())
        return fail(Fault::usage, "script.not_a_number", "'{word}' is not a number", word);
    return value;
}

/// Calls with two numbers, which stand at the place and behind it.
template <typename Play>
Result<void> with_numbers(const Words& words, std::size_t at, const Play& play) {
    const auto first = number(words[at]), second = number(words[at + 1]);
    if (!first) return first.error();
    if (!second) return second.error();
    return play(*first, *second);
}

Result<void> drag(Hands& hands, const Words& words) {
    const auto value = number(words[1]);
    return value ? hands.player.drag(words[0], *value) : Result<void>(value.error());
}

Result<void> wheel(Hands& hands, const Words& words) {
    const auto steps = number(words[0]);
    return steps ? hands.player.wheel(static_cast<float>(*steps)) : Result<void>(steps.error());
}

Result<void> move(Hands& hands, const Words& words) {
    return with_numbers(
        words, 1, [&](double x, double y) { return hands.player.move(words[0], static_cast<float>(x), static_cast<float>(y)); });
}

Result<void> pull(Hands& hands, const Words& words) {
    return with_numbers(words, 0,
                        [&](double x, double y) { return hands.player.pull(static_cast<float>(x), static_cast<float>(y)); });
}

Result<void> pin(Hands& hands, const Words& words) {
    return with_numbers(words, 0, [&](double x, double y) {
        hands.player.inspector().model().pin = glm::ivec2(static_cast<int>(x), static_cast<int>(y));
        return hands.player.frames(2);
    });
}

// clang-format off
constexpr Command commands[] = {
    {"click", "PATH", 1, [](Hands& hands, const Words& words) { return hands.player.click(words[0]); }},
    {"choose", "PATH ITEM", 2, [](Hands& hands, const Words& words) { return hands.player.choose(words[0], words[1]); }},
    {"drag", "PATH VALUE", 2, drag},
    {"type", "PATH TEXT", 2, [](Hands& hands, const Words& words) { return hands.player.type(words[0], words[1]); }},
    {"key", "NAME", 1, [](Hands& hands, const Words& words) { return hands.player.key(words[0]); }},
    {"move", "PATH X Y", 3, move},
    {"pull", "X Y", 2, pull},
    {"wheel", "STEPS", 1, wheel},
    {"pin", "X Y", 2, pin},
    {"wait", "", 0, [](Hands& hands, const Words&) { return hands.player.wait(); }},
    {"expect", "PATH TEXT", 2, [](Hands& hands, const Words& words) { return hands.player.expect(words[0], words[1]); }},
    {"shot", "FILE.png", 1, [](Hands& hands, const Words& words) { return hands.player.shot(hands.folder / words[0]); }},
    {"tree", "FILE.json", 1, [](Hands& hands, const Words& words) { return hands.player.tree(hands.folder / words[0]); }},
};
// clang-format on

Result<void> play(Hands& hands, const ScriptLine& line) {
    const auto command = std::ranges::find(commands, line.words[0], &Command::name);
    if (command == std::end(commands)) {
        std::vector<std::string_view> known;
        for (const Command& each : commands) known.push_back(each.name);
        return fail(Fault::usage, "script.unknown_command", "there is no command '{command}'{suggestion}", line.words[0],
                    did_you_mean(line.words[0], known));
    }
    const Words words(line.words.begin() + 1, line.words.end());
    if (words.size() != command->words)
        return fail(Fault::usage, "script.argument_count", "'{command}' takes {wanted} arguments, not {given}: {usage}",
                    command->name, command->words, words.size(), fmt::format("{} {}", command->name, command->takes));
    return command->play(hands, words);
}

/// Words apart by spaces, of which those in quotes may hold some; outside of quotes a backslash takes the next character as it
/// is. Fails where a quote is not closed.
Result<Words> words_of(std::string_view line) {
    Words words;
    char quote = 0;
    bool inside = false, escaped = false;
    for (const char c : line) {
        if (quote == 0 && !inside && c == '#') break;
        if (!escaped && quote == 0 && c == '\\') {
            escaped = true;
        } else if (escaped) {
            if (!inside) words.emplace_back();
            inside = true;
            escaped = false;
            words.back() += c;
        } else if (quote != 0 && c == quote) {
            quote = 0;
        } else if (quote == 0 && (c == '\'' || c == '"')) {
            quote = c;
            if (!inside) words.emplace_back();
            inside = true;
        } else if (quote == 0 && (c == ' ' || c == '\t' || c == '\r')) {
            inside = false;
        } else {
            if (!inside) words.emplace_back();
            inside = true;
            words.back() += c;
        }
    }
    if (quote != 0) return fail(Fault::usage, "script.open_quote", "a quote is not closed");
    return words;
}

}  // namespace

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& file) {
    std::vector<ScriptLine> lines;
    for (std::size_t number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        auto words = words_of(text.substr(0, end));
        if (!words) return within(words.error(), "{file}:{line}", file, number);
        if (!words->empty()) lines.push_back({number, *std::move(words)});
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

Result<void> play(Player& player, const std::vector<ScriptLine>& lines, const std::string& file,
                  const std::filesystem::path& folder, const strata::Progress& progress) {
    Hands hands{player, folder};
    for (const ScriptLine& line : lines) {
        if (progress) progress(fmt::format("{}:{}", file, line.number), double(&line - lines.data()) / double(lines.size()));
        if (const auto done = play(hands, line); !done) return within(done.error(), "{file}:{line}", file, line.number);
    }
    return {};
}

}  // namespace strata::ui
