// What a function returns when the world may be at fault: a value, or an Error with a sentence that says what to do.
// Our own mistakes are asserts; the device's collapse is an exception caught in Session::run.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/core.h>

#include "capture_format/safe_variant.h"

namespace strata {

/// Why something could not be done. The kinds are the program's exit codes.
enum class Fault {
    over_tolerance = 1,       ///< a comparison failed
    usage = 2,                ///< the user asked for something that does not exist
    bad_input = 3,            ///< a file is damaged, cut short or lies about itself
    device_lacks = 4,         ///< the device lacks a feature that is needed
    device_failed = 5,        ///< the device was lost or the validation layer complained
    expectation_missing = 6,  ///< nothing to compare with
    not_repeatable = 7,       ///< two equal runs differed
    internal = 8,             ///< a mistake of this program
    stopped = 130,            ///< whoever asked for it asked to stop
};

/// "usage", "bad_input": the enumerator's name.
std::string_view name(Fault);

/// What an error is called in scripts and tests, however its sentence is worded: words of a-z, 0-9 and _ joined by dots, from the
/// area to the case: "import.gltf.accessor_range".
class ErrorId {
public:
    consteval ErrorId(const char* text) : text_(text) {
        if (!is_name(text_)) throw "an error's id is words of a-z, 0-9 and _, two or more, joined by dots";
    }
    constexpr std::string_view text() const { return text_; }
    friend constexpr bool operator==(ErrorId a, std::string_view b) { return a.text_ == b; }

private:
    static constexpr bool is_name(std::string_view text) {
        bool has_dot = false, in_word = false;
        for (const char c : text) {
            if (c == '.' && !in_word) return false;
            has_dot = has_dot || c == '.';
            in_word = c != '.';
            if (in_word && c != '_' && !(c >= 'a' && c <= 'z') && !(c >= '0' && c <= '9')) return false;
        }
        return has_dot && in_word;
    }
    std::string_view text_;
};

/// A number or a word of an error's sentence, by the name of its placeholder.
struct ErrorField {
    std::string_view name;
    SafeVariant<std::int64_t, std::uint64_t, double, std::string> value;
};

// The analyzer copies the error of a Result that has a value.
struct [[nodiscard]] Error {  // NOLINT(clang-analyzer-core.uninitialized.Assign)
    Fault fault = Fault::bad_input;
    std::string sentence;
    ErrorId id;
    std::vector<ErrorField> fields = {};  ///< in the order of the sentence; where another error is wrapped, the inner ones first

    /// The first field of that name, or null.
    const ErrorField* field(std::string_view name) const;
};

namespace detail {

/// Walks over a sentence whose placeholders have names: put(char) gets the format that fmt knows, "{:>3}" of "{frame:>3}";
/// name(string_view) gets each name, in the order of arguments.
template <typename Put, typename Name>
constexpr void for_each_part(std::string_view sentence, Put put, Name name) {
    for (std::size_t i = 0; i < sentence.size();) {
        const bool is_brace = sentence[i] == '{', is_escaped = is_brace && sentence.substr(i + 1).starts_with('{');
        if (is_escaped) put(sentence[i++]);
        put(sentence[i++]);
        if (!is_brace || is_escaped) continue;
        const std::size_t end = std::min(sentence.find_first_of(":}", i), sentence.size());
        name(sentence.substr(i, end - i));
        i = end;
    }
}

/// The format of a sentence, for fmt's own check at compile time.
template <std::size_t n>
struct PlainSentence {
    constexpr explicit PlainSentence(std::string_view sentence) {
        for_each_part(
            sentence, [this](char c) { text[size++] = c; },
            [](std::string_view name) {
                if (name.empty()) throw "a placeholder of an error's sentence has a name: {frame}";
            });
    }
    char text[n] = {};
    std::size_t size = 0;
};

/// The sentence of an error, checked at compile time against what is formatted into it.
template <typename... Args>
class Sentence {
public:
    template <std::size_t n>
    consteval Sentence(const char (&named)[n]) : named_(named, n - 1) {
        const PlainSentence<n> plain(named_);
        static_cast<void>(fmt::format_string<Args...>(fmt::string_view(plain.text, plain.size)));
    }
    std::string_view named() const { return named_; }

private:
    std::string_view named_;
};

Error error_of(Fault, ErrorId, std::string_view sentence, fmt::format_args);
Error wrapped(Error, std::string_view where, fmt::format_args);
Error remarked(Error, std::string_view remark, fmt::format_args);

}  // namespace detail

/// An Error of the given kind. Placeholders of the sentence have names, which become the error's fields, and follow the order of
/// the arguments: fail(Fault::usage, "replay.no_frame", "there is no frame {frame}: the capture has {frames}", 7, 3).
template <typename... Args>
Error fail(Fault fault, ErrorId id, std::type_identity_t<detail::Sentence<Args...>> sentence, Args&&... args) {
    return detail::error_of(fault, id, sentence.named(), fmt::make_format_args(args...));
}

/// The same error with where it happened before its sentence, "frame 3: ...". Keeps its kind, its id and its fields.
template <typename... Args>
Error within(Error error, std::type_identity_t<detail::Sentence<Args...>> where, Args&&... args) {
    return detail::wrapped(std::move(error), where.named(), fmt::make_format_args(args...));
}

/// The same error with a remark, such as what to do, behind its sentence: "...; record it again". Keeps what within() keeps.
template <typename... Args>
Error advised(Error error, std::type_identity_t<detail::Sentence<Args...>> remark, Args&&... args) {
    return detail::remarked(std::move(error), remark.named(), fmt::make_format_args(args...));
}

template <typename T>
class Result;

namespace detail {
template <typename T>
struct AsResult {
    using Type = Result<T>;
};
template <typename T>
struct AsResult<Result<T>> {
    using Type = Result<T>;
};
}  // namespace detail

/// A T or an Error. Test it as a bool before use.
template <typename T>
class [[nodiscard]] Result {
public:
    Result(T value) : held_(std::in_place_index<0>, std::move(value)) {}
    Result(Error error) : held_(std::in_place_index<1>, std::move(error)) {}

    explicit operator bool() const { return held_.index() == 0; }
    const T& operator*() const& { return std::get<0>(held_); }
    T& operator*() & { return std::get<0>(held_); }
    T&& operator*() && { return std::get<0>(std::move(held_)); }
    const T* operator->() const { return &std::get<0>(held_); }
    T* operator->() { return &std::get<0>(held_); }
    const Error& error() const { return std::get<1>(held_); }

    /// What `next`, which takes a T& and returns a value or a Result, makes of the value; or the error.
    template <typename Next>
    auto and_then(Next&& next) && {
        using Made = typename detail::AsResult<std::invoke_result_t<Next, T&>>::Type;
        return *this ? Made(next(std::get<0>(held_))) : Made(error());
    }

private:
    std::variant<T, Error> held_;
};

/// Success, or an Error.
template <>
class [[nodiscard]] Result<void> {
public:
    Result() = default;
    Result(Error error) : error_(std::move(error)) {}

    explicit operator bool() const { return !error_; }
    const Error& error() const { return *error_; }

    /// What `next`, which takes nothing and returns a value or a Result, makes; or the error.
    template <typename Next>
    auto and_then(Next&& next) && {
        using Made = typename detail::AsResult<std::invoke_result_t<Next>>::Type;
        return *this ? Made(next()) : Made(error());
    }

private:
    std::optional<Error> error_;
};

}  // namespace strata
