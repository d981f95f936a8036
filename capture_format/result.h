// What a function returns when the world may be at fault: a value, or an Error with a sentence that says what to do.
// Our own mistakes are asserts; the device's collapse is an exception caught in Session::run.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/core.h>

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

struct [[nodiscard]] Error {
    Fault fault = Fault::bad_input;
    std::string sentence;
};

/// An Error of the given kind; the format string is checked at compile time.
template <typename... Args>
Error fail(Fault fault, fmt::format_string<Args...> format, Args&&... args) {
    return {fault, fmt::format(format, std::forward<Args>(args)...)};
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
