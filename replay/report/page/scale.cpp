#include "replay/report/page/scale.h"

#include <fmt/format.h>

#include "replay/report/seen.h"
#include "replay/tables/table.h"

namespace strata {

std::string error_words(const RankingError& error, double value) {
    if (!error.is_of_white) return fmt::format("{} {}", error.name, short_number(value));
    const std::string percent = value < exact_below ? fmt::format("under {:g}", 100 * exact_below) : short_number(100 * value);
    return fmt::format("{} % of white, {}", percent, seen_as(value).words);
}

std::string scale_html(const RankingError& error) {
    if (!error.is_of_white) return "";
    std::string text = "<div class=\"scale\">";
    const auto classes = seen_classes();
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const std::string to = i + 1 < classes.size() ? fmt::format("{:g}", 100 * classes[i + 1].from) : "";
        const std::string range = i == 0       ? fmt::format("below {} %", to)
                                  : to.empty() ? fmt::format("from {:g} %", 100 * classes[i].from)
                                               : fmt::format("{:g} to {} %", 100 * classes[i].from, to);
        text += fmt::format("<div><i class=\"k{}\"></i><b>{}</b> {}</div>", i, range, classes[i].words);
    }
    return text + "</div>\n";
}

std::string class_square(const RankingError& error, double value) {
    if (!error.is_of_white) return "";
    return fmt::format("<i class=\"k{}\"></i>", &seen_as(value) - seen_classes().data());
}

}  // namespace strata
