#include "replay/report/page/page_items.h"

#include <fmt/format.h>

#include "replay/markup_text.h"
#include "replay/report/page/scatter.h"

namespace strata {
namespace {

std::string list_line(const std::string& head, const std::string& text) {
    return fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(head), escaped(text));
}

}  // namespace

std::string Marks::html(const std::string& technique) const {
    return fmt::format("<svg class=\"mark\" viewBox=\"-7 -7 14 14\"><path class=\"{} full\" d=\"{}\"/></svg>",
                       mark_class(kind(technique)), mark_path(kind(technique)));
}

std::string provenance_html(std::initializer_list<std::string> facts) {
    std::string text;
    for (const std::string& fact : facts)
        if (!fact.empty()) text += fmt::format("<span>{}</span>", escaped(fact));
    return text;
}

std::string command_html(const std::string& command) {
    return fmt::format("<div class=\"cmd\"><code>{}</code><button class=\"copy js\">copy</button></div>\n", escaped(command));
}

std::string answer_html(std::span<const AnswerLine> lines, const std::string& times_are) {
    std::string text;
    for (const AnswerLine& line : lines)
        if (line.head != replay_head && line.text != times_are) text += list_line(line.head, line.text);
    return text.empty() ? "" : "<dl>\n" + text + "</dl>\n";
}

std::string left_out_html(std::span<const std::pair<std::string, std::string>> reasons) {
    std::string text;
    for (const auto& [row, reason] : reasons) text += list_line(row, reason);
    return text.empty() ? "" : "<h3>Not in the table</h3><dl>\n" + text + "</dl>\n";
}

std::string note_html(const std::string& note, const std::string& id) {
    if (note.empty()) return "";
    const std::string data = id.empty() ? "" : fmt::format(" data-id=\"{}\"", escaped(id));
    return fmt::format("<p class=\"warn\"{}>{}</p>\n", data, escaped(note));
}

}  // namespace strata
