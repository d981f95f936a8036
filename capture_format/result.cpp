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

/// The text of a sentence, whose values join the fields.
std::string formatted(std::string_view sentence, fmt::format_args args, std::vector<ErrorField>& fields) {
    std::string format;
    int index = 0;
    detail::for_each_part(
        sentence, [&](char c) { format += c; },
        [&](std::string_view name) {
            fields.push_back({name, fmt::visit_format_arg(FieldValue(), args.get(index++))});
        });
    return fmt::vformat(format, args);
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
    Error error{.fault = fault, .sentence = {}, .id = id};
    error.sentence = formatted(sentence, args, error.fields);
    return error;
}

Error wrapped(Error error, std::string_view where, fmt::format_args args) {
    error.sentence = formatted(where, args, error.fields) + ": " + error.sentence;
    return error;
}

Error remarked(Error error, std::string_view remark, fmt::format_args args) {
    error.sentence += "; " + formatted(remark, args, error.fields);
    return error;
}

}  // namespace detail
}  // namespace strata
