#include "tests/support/errors.h"

#include <algorithm>
#include <ostream>

#include <fmt/format.h>

namespace strata {
namespace {

std::string text_of(const ErrorField& field) {
    return std::visit([](const auto& value) { return fmt::format("{}", value); }, field.value);
}

}  // namespace

std::string with_id(const Error& error) {
    std::string text = fmt::format("{} ({}", error.sentence, error.id.text());
    const char* gap = ": ";
    for (const ErrorField& field : error.fields) {
        text += fmt::format("{}{}={}", gap, field.name, text_of(field));
        gap = " ";
    }
    return text + ")";
}

void PrintTo(const Error& error, std::ostream* out) { *out << name(error.fault) << ": " << with_id(error); }

bool FailsWithMatcher::MatchAndExplain(const Error& error, std::ostream* why) const {
    if (!id_.empty() && error.id != id_) {
        if (why) *why << "whose id is " << error.id.text();
        return false;
    }
    return std::ranges::all_of(fields_, [&](const Field& wanted) {
        const bool found = std::ranges::any_of(error.fields, [&](const ErrorField& field) {
            return field.name == wanted.name && wanted.text.Matches(text_of(field));
        });
        if (!found && why) *why << "whose field " << wanted.name << " differs or is missing";
        return found;
    });
}

bool FailsWithMatcher::MatchAndExplain(const std::optional<Error>& error, std::ostream* why) const {
    if (error) return MatchAndExplain(*error, why);
    if (why) *why << "which did not fail";
    return false;
}

void FailsWithMatcher::DescribeTo(std::ostream* out) const {
    *out << "fails with " << (id_.empty() ? "any id" : id_);
    for (const Field& field : fields_) {
        *out << ", " << field.name << " ";
        field.text.DescribeTo(out);
    }
}

void FailsWithMatcher::DescribeNegationTo(std::ostream* out) const {
    *out << "not: ";
    DescribeTo(out);
}

}  // namespace strata
