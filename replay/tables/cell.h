// What one cell of a table holds, and the one rule for what is missing, cannot be judged or is not finite.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include <nlohmann/json_fwd.hpp>

#include "capture_format/safe_variant.h"
#include "replay/measure/timing.h"

namespace strata {

/// A value that exists and that nothing could determine: rounding decides every texel, a compiler does not state it.
struct Unknown {};

/// Nothing (monostate): not measured, or it does not apply.
using CellValue = SafeVariant<std::monostate, Unknown, double, std::uint64_t, Spread, bool, std::string>;

template <typename T>
CellValue cell_or_nothing(const std::optional<T>& value) {
    return value ? CellValue(*value) : CellValue();
}
template <typename T>
CellValue cell_or_unknown(const std::optional<T>& value) {
    return value ? CellValue(*value) : CellValue(Unknown{});
}
/// Text that is missing where it is empty.
inline CellValue cell_if_any(std::string text) { return text.empty() ? CellValue() : CellValue(std::move(text)); }

inline bool is_nothing(const CellValue& value) { return std::holds_alternative<std::monostate>(value); }

enum class CellKind {
    text,    ///< words
    flag,    ///< yes or no
    count,   ///< a whole number
    number,  ///< three significant digits
    share,   ///< 0 to 1, in percent for people
    ratio,   ///< a multiple, with its spread: two digits after the point
    spread,  ///< a median and its deviation
    median   ///< the same, of which text shows the median alone
};

enum class Better { neither, less, more, nearer_zero };

/// What a plot may have along an axis.
enum class Role { other, error, cost };

enum Place : unsigned {
    in_text = 1,  ///< and Markdown: what a person reads first
    in_json = 2,
    in_csv = 4,
    in_window = 8,
    in_files = in_json | in_csv,
    everywhere = in_text | in_files | in_window
};

/// The one description of a value, for every format.
struct Described {
    std::string key;    ///< in JSON and CSV: "stage_ms"
    std::string title;  ///< above a column: "ms"
    std::string help;   ///< a sentence without its subject
    CellKind kind = CellKind::number;
    Better better = Better::neither;
    unsigned shown = everywhere;
    std::string unit = {};         ///< "ms"; empty: none, or what the title says
    std::string digits = {};       ///< of text, as fmt has them (".5f"), instead of the kind's own
    std::string json = {};         ///< where the key lies deeper in JSON: "/implementation_error/rmse"
    std::string short_title = {};  ///< where room is scarce: the window
    std::string label = {};        ///< after a number and along an axis: "ms of the stage"
    std::size_t width = 0;         ///< of lines (as_lines), at least
    bool if_any = false;           ///< text leaves the column out where no row has it
    Role role = Role::other;
    bool is_detail = false;  ///< the window shows it only where it is an axis
};

/// Whether its values have a median and a deviation.
inline bool has_spread(const Described& is) {
    return is.kind == CellKind::ratio || is.kind == CellKind::spread || is.kind == CellKind::median;
}
/// For people: "" for nothing, "-" for what is unknown.
std::string cell_text(const Described&, const CellValue&);
/// For JSON: null for what is unknown; NaN and infinities, for which JSON has no number, are "nan", "inf" and "-inf". Not for
/// nothing: its key is left out.
nlohmann::ordered_json cell_json(const CellValue&);
nlohmann::ordered_json json_of(const Spread&);
/// For CSV: empty for nothing and for what is unknown; of a spread the median. Text is quoted.
std::string cell_csv(const CellValue&);
/// A number that ranks the cell, where it has one.
std::optional<double> cell_number(const CellValue&);

}  // namespace strata
