// Errors: what is said for people, and the same as an id and fields for scripts.
#include "capture_format/result.h"

#include <algorithm>

#include <fmt/format.h>

namespace strata {
namespace {

struct FieldValue {
    using Value = decltype(ErrorField::value);
    template <typename T>
    Value operator()(T value) const {
        if constexpr (std::is_same_v<T, bool>) return std::string(value ? "true" : "false");
        else if constexpr (std::is_same_v<T, char>) return std::string(1, value);
        else if constexpr (std::is_floating_point_v<T>) return static_cast<double>(value);
        else if constexpr (std::is_integral_v<T> && std::is_signed_v<T>) return static_cast<std::int64_t>(value);
        else if constexpr (std::is_integral_v<T>) return static_cast<std::uint64_t>(value);
        else if constexpr (std::is_same_v<T, fmt::string_view>) return std::string(value.data(), value.size());
        else if constexpr (std::is_same_v<T, const char*>) return std::string(value);
        else return std::string();
    }
};

/// "{frame:>3}" as "{:>3}", and the names that were taken out.
struct PlainSentence {
    std::string format;
    std::vector<std::string_view> names;
};

PlainSentence without_names(std::string_view named) {
    PlainSentence plain;
    for (std::size_t i = 0; i < named.size();) {
        const bool is_field = named[i] == '{' && named[i + 1] != '{';
        if (named[i] == '{' && !is_field) plain.format += named[i++];
        plain.format += named[i++];
        if (!is_field) continue;
        const std::size_t end = named.find_first_of(":}", i);
        plain.names.push_back(named.substr(i, end - i));
        i = end;
    }
    return plain;
}

std::vector<ErrorField> fields_of(const std::vector<std::string_view>& names, fmt::format_args args) {
    std::vector<ErrorField> fields;
    for (std::size_t i = 0; i < names.size(); ++i)
        fields.push_back({names[i], fmt::visit_format_arg(FieldValue(), args.get(static_cast<int>(i)))});
    return fields;
}

}  // namespace

std::string_view name(Fault fault) {
    switch (fault) {
        case Fault::over_tolerance:
            return "over_tolerance";
        case Fault::usage:
            return "usage";
        case Fault::bad_input:
            return "bad_input";
        case Fault::device_lacks:
            return "device_lacks";
        case Fault::device_failed:
            return "device_failed";
        case Fault::expectation_missing:
            return "expectation_missing";
        case Fault::not_repeatable:
            return "not_repeatable";
        case Fault::internal:
            return "internal";
        case Fault::stopped:
            return "stopped";
    }
    return "unknown";
}

const ErrorField* Error::field(std::string_view wanted) const {
    const auto found = std::ranges::find(fields, wanted, &ErrorField::name);
    return found == fields.end() ? nullptr : &*found;
}

namespace detail {

Error error_of(Fault fault, ErrorId id, std::string_view sentence, fmt::format_args args) {
    const PlainSentence plain = without_names(sentence);
    return {.fault = fault, .sentence = fmt::vformat(plain.format, args), .id = id, .fields = fields_of(plain.names, args)};
}

Error wrapped(Error error, std::string_view where, fmt::format_args args) {
    const PlainSentence plain = without_names(where);
    error.sentence = fmt::vformat(plain.format, args) + ": " + error.sentence;
    for (ErrorField& field : fields_of(plain.names, args)) error.fields.push_back(std::move(field));
    return error;
}

Error remarked(Error error, std::string_view remark, fmt::format_args args) {
    const PlainSentence plain = without_names(remark);
    error.sentence += "; " + fmt::vformat(plain.format, args);
    for (ErrorField& field : fields_of(plain.names, args)) error.fields.push_back(std::move(field));
    return error;
}

}  // namespace detail
}  // namespace strata
