#include "replay/error_text.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace strata {
namespace {

using nlohmann::ordered_json;

/// JSON has no NaN and no infinities.
ordered_json json_of(const ErrorField& field) {
    return std::visit(
        [](const auto& value) -> ordered_json {
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>)
                if (!std::isfinite(value)) return fmt::format("{}", value);
            return value;
        },
        field.value);
}

}  // namespace

std::string id_text(const Error& error) {
    std::string text(error.id.text());
    const char* gap = ": ";
    for (const ErrorField& field : error.fields) {
        text += std::visit([&](const auto& value) { return fmt::format("{}{}={}", gap, field.name, value); }, field.value);
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
