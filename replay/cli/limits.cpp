#include "replay/cli/limits.h"

#include <charconv>
#include <cmath>

#include "replay/tables/table.h"

namespace strata {

Result<std::optional<double>> parse_limit(const char* option, std::string_view given, std::string_view unit, double factor) {
    if (given.empty()) return std::optional<double>();
    const bool has_unit = given.ends_with(unit);
    const std::string_view text = given.substr(0, given.size() - (has_unit ? unit.size() : 0));
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || end != text.data() + text.size() || !(value > 0) || !std::isfinite(value))
        return fail(Fault::usage, "options.malformed", "{option} takes a number above 0, like 2{unit}, not '{value}'", option,
                    unit, given);
    if (!has_unit && unit == "%" && value >= 1)
        return fail(Fault::usage, "options.share_above_1",
                    "{option} {value} is a limit of {percent} %; for a percentage, write % after the number", option, given,
                    short_number(100 * value));
    return std::optional(has_unit ? value * factor : value);
}

}  // namespace strata
