#include "replay/tables/cell.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "replay/tables/table.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

/// Calls the function of the alternative that a value holds.
template <typename... Cases>
struct Match : Cases... {
    using Cases::operator()...;
};
template <typename... Cases>
Match(Cases...) -> Match<Cases...>;  // clang 16 deduces no aggregates

ordered_json json_number(double value) {
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
}

template <typename Number>
std::string number_text(const Described& is, Number shown) {
    if (!is.digits.empty()) return fmt::format(fmt::runtime(fmt::format("{{:{}}}", is.digits)), shown);
    if (is.kind == CellKind::count) return fmt::format("{}", shown);
    return is.kind == CellKind::ratio ? fmt::format("{:.2f}", double(shown)) : short_number(double(shown));
}

/// One run has no spread.
std::string spread_text(const Described& is, const Spread& spread) {
    const std::string median = number_text(is, spread.median);
    const bool has_spread = is.kind != CellKind::median && spread.repeats != 1;
    return has_spread ? fmt::format("{} +-{}", median, number_text(is, spread.mad)) : median;
}

std::string quoted_field(std::string_view text) {
    std::string safe(1, '"');
    for (const char c : text) safe.append(c == '"' ? 2 : 1, c);
    return safe + '"';
}

}  // namespace

std::string cell_text(const Described& is, const CellValue& value) {
    const Match match{[](std::monostate) { return std::string(); },
                      [](Unknown) { return std::string("-"); },
                      [&](double number) { return number_text(is, is.kind == CellKind::share ? 100 * number : number); },
                      [&](std::uint64_t count) { return number_text(is, count); },
                      [&](const Spread& spread) { return spread_text(is, spread); },
                      [](bool flag) { return std::string(flag ? "yes" : "no"); },
                      [](const std::string& text) { return text; }};
    return std::visit(match, value);
}

ordered_json json_of(const Spread& spread) {
    return {{"median", json_number(spread.median)},
            {"mad", json_number(spread.mad)},
            {"low", json_number(spread.low)},
            {"high", json_number(spread.high)},
            {"repeats", spread.repeats}};
}

ordered_json cell_json(const CellValue& value) {
    const Match match{[](std::monostate) { return ordered_json(); },
                      [](Unknown) { return ordered_json(); },
                      [](double number) { return json_number(number); },
                      [](std::uint64_t count) { return ordered_json(count); },
                      [](const Spread& spread) { return json_of(spread); },
                      [](bool flag) { return ordered_json(flag); },
                      [](const std::string& text) { return ordered_json(text); }};
    return std::visit(match, value);
}

std::string cell_csv(const CellValue& value) {
    const Match match{[](std::monostate) { return std::string(); },
                      [](Unknown) { return std::string(); },
                      [](double number) { return fmt::format("{:.9g}", number); },
                      [](std::uint64_t count) { return fmt::format("{}", count); },
                      [](const Spread& spread) { return fmt::format("{:.9g}", spread.median); },
                      [](bool flag) { return fmt::format("{:d}", flag); },
                      [](const std::string& text) { return quoted_field(text); }};
    return std::visit(match, value);
}

std::optional<double> cell_number(const CellValue& value) {
    if (const auto* number = std::get_if<double>(&value)) return *number;
    if (const auto* count = std::get_if<std::uint64_t>(&value)) return double(*count);
    if (const auto* spread = std::get_if<Spread>(&value)) return spread->median;
    return {};
}

}  // namespace strata
