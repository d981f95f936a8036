#include "replay/cli/given_options.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "capture_format/nearest_name.h"

namespace strata {
namespace {

/// The options' own spelling of an argument, or empty: "--size" of "--size=4x4", "-o" of "-ofile". Numbers below 0 are values.
std::string option_in(std::string_view argument) {
    if (argument.starts_with("--")) return std::string(argument.substr(0, argument.find('=')));
    const bool is_short = argument.size() > 1 && argument[0] == '-' && std::isalpha(static_cast<unsigned char>(argument[1]));
    return is_short ? std::string(argument.substr(0, 2)) : std::string();
}

Result<void> check_option(const CLI::App& app, const std::string& option) {
    if (option.empty() || app.get_option_no_throw(option)) return {};
    std::vector<std::string> names;
    for (const CLI::Option* known : app.get_options())
        for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    const bool is_program = app.get_parent() == nullptr;
    return fail_unnamed(Fault::usage, "{} has no option {}{}", is_program ? "strata" : "strata " + app.get_name(), option,
                        did_you_mean(option, known));
}

Result<const CLI::App*> find_verb(const CLI::App& program, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* verb : program.get_subcommands({})) {
        if (verb->get_name() == name) return verb;
        if (!verb->get_group().empty()) names.push_back(verb->get_name());
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fail_unnamed(Fault::usage, "there is no verb '{}'{}", name, did_you_mean(name, known));
}

/// Parses the digits that the text begins with; what follows them, or nothing where there are none or too many.
template <typename Whole>
std::optional<std::string> rest_after_number(std::string_view text, Whole& value) {
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc()) return std::nullopt;
    return std::string(end, text.data() + text.size());
}

/// A whole number; it is written anew, so that a 0 before it does not make it octal.
template <typename Whole>
std::string problem_of_whole(std::string& text) {
    Whole value = 0;
    const auto rest = rest_after_number(text, value);
    if (!rest || !rest->empty())
        return fmt::format("'{}' is not a whole number from {} to {}", text, std::numeric_limits<Whole>::min(),
                           std::numeric_limits<Whole>::max());
    text = std::to_string(value);
    return {};
}

/// Bytes with or without a unit, which is CLI11's to know.
std::string problem_of_size(std::string& text) {
    std::uint64_t value = 0;
    const auto rest = rest_after_number(text, value);
    if (!rest || value == 0) return fmt::format("'{}' is not a size above 0 like 256MiB", text);
    text = std::to_string(value) + *rest;
    return {};
}

/// Of a text that is a number: refuse_what_is_no_number() comes first.
double number_in(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

std::string problem_of_real(std::string& text) {
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = problem == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    return is_number ? std::string() : fmt::format("'{}' is not a finite number", text);
}

}  // namespace

Result<void> check_names(const CLI::App& program, std::span<const std::string> arguments) {
    const CLI::App* verb = &program;
    if (std::ranges::count(arguments, "--version") > 0 && arguments.size() > 1)
        return fail_unnamed(Fault::usage, "--version is given alone, without a verb and other options");
    for (const std::string& argument : arguments) {
        if (argument == "--") return {};
        if (verb == &program && !argument.starts_with('-')) {
            const auto found = find_verb(program, argument);
            if (!found) return found.error();
            verb = *found;
        } else if (const auto known = check_option(*verb, option_in(argument)); !known) {
            return known;
        }
    }
    return {};
}

void refuse_what_is_no_number(CLI::App& verb) {
    for (CLI::Option* option : verb.get_options([](CLI::Option*) { return true; })) {
        const std::string type = option->get_type_name();
        const auto check = [&](std::string (*problem)(std::string&)) { option->transform(CLI::Validator(problem, "")); };
        if (type.starts_with("FLOAT")) check(problem_of_real);
        else if (type.starts_with("UINT:SIZE")) check(problem_of_size);
        else if (type.starts_with("UINT")) check(problem_of_whole<std::uint64_t>);
        else if (type.starts_with("INT")) check(problem_of_whole<std::int64_t>);
    }
}

CLI::Validator from_to(double low, double high) {
    return CLI::Validator(
        [=](std::string& text) {
            const double value = number_in(text);
            return value >= low && value <= high ? std::string()
                                                 : fmt::format("takes a number from {} to {}, not {}", low, high, text);
        },
        fmt::format("{} to {}", low, high));
}

CLI::Validator one_of(std::vector<std::string> words) {
    const std::string named = fmt::format("{{{}}}", fmt::join(words, ","));
    return CLI::Validator(
        [words = std::move(words)](std::string& text) {
            if (std::ranges::count(words, text) > 0) return std::string();
            const std::vector<std::string_view> known(words.begin(), words.end());
            return fmt::format("takes {}, not '{}'{}", fmt::join(words, " or "), text, did_you_mean(text, known));
        },
        named);
}

CLI::Validator not_negative() {
    return CLI::Validator(
        [](std::string& text) {
            return number_in(text) >= 0 ? std::string() : fmt::format("takes a number of 0 or more, not {}", text);
        },
        "");
}

CLI::Validator positive() {
    return CLI::Validator(
        [](std::string& text) {
            return number_in(text) > 0 ? std::string() : fmt::format("takes a number above 0, not {}", text);
        },
        "");
}

CLI::Validator one_or_four() {
    return CLI::Validator(
        [](std::string& text) { return text == "1" || text == "4" ? "" : fmt::format("takes 1 or 4, not {}", text); }, "{1,4}");
}

CLI::Validator sample_index() { return from_to(0, 3); }

Result<void> check_values(const CLI::App& verb) {
    for (const CLI::Option* option : verb.get_options()) {
        if (option->get_items_expected_min() == 0) continue;  // flags, and options whose value may be left out
        for (const std::string& value : option->results())
            if (value.find_first_not_of(" \t\r\n") == value.npos)
                return fail_unnamed(Fault::usage, "{} is given an empty value", option->get_name());
    }
    return {};
}

Result<void> check_not_given(const CLI::App& verb, std::initializer_list<const char*> options, std::string_view why) {
    for (const char* name : options)
        if (verb.get_option(name)->count() > 0) return fail_unnamed(Fault::usage, "{} does not apply: {}", name, why);
    return {};
}

}  // namespace strata
