#include "replay/error_text.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "replay/tables/cell.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const ErrorField& field) {
    return std::visit(
        [](const auto& value) -> ordered_json {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::int64_t>) return value;
            else return cell_json(value);
        },
        field.value);
}

template <typename Number>
std::string as_word(Number number) {
    return fmt::format("{}", number);
}

/// In quotes, as JSON has it, where it is more than a word: the line of an error stays one line, and its values stay apart.
std::string as_word(const std::string& text) {
    const bool is_word =
        !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return c > ' ' && c != '"' && c != 127; });
    return is_word ? text : ordered_json(text).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string id_text(const Error& error) {
    std::string text(error.id.text());
    const char* gap = ": ";
    for (const ErrorField& field : error.fields) {
        const std::string value = std::visit([](const auto& held) { return as_word(held); }, field.value);
        text += fmt::format("{}{}={}", gap, field.name, value);
        gap = " ";
    }
    return text;
}

ordered_json json_of(const Error& error) {
    ordered_json fields = ordered_json::object();
    for (const ErrorField& field : error.fields)
        if (!fields.contains(field.name)) fields[std::string(field.name)] = json_of(field);
    return {{"id", error.id.text()},
            {"kind", name(error.fault)},
            {"exit_code", static_cast<int>(error.fault)},
            {"sentence", error.sentence},
            {"fields", fields}};
}

}  // namespace strata
