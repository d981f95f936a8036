#include "replay/cli/given_options.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "capture_format/nearest_name.h"
#include "replay/cli/renamed_options.h"

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
    for (const auto& [before, now] : renamed_options)
        if (option == before && app.get_option_no_throw(std::string(now)))
            return fail(Fault::usage, "usage.renamed_option", "{option} was renamed: pass {name}", before, now);
    std::vector<std::string> names;
    for (const CLI::Option* known : app.get_options())
        for (const std::string& name : known->get_lnames()) names.push_back("--" + name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    const bool is_program = app.get_parent() == nullptr;
    return fail(Fault::usage, "options.unknown", "{verb} has no option {option}{suggestion}",
                is_program ? "strata" : "strata " + app.get_name(), option, did_you_mean(option, known));
}

Result<const CLI::App*> find_verb(const CLI::App& program, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* verb : program.get_subcommands({})) {
        if (verb->get_name() == name) return verb;
        if (!verb->get_group().empty()) names.push_back(verb->get_name());
    }
    const std::vector<std::string_view> known(names.begin(), names.end());
    return fail(Fault::usage, "options.unknown_verb", "there is no verb '{verb}'{suggestion}", name, did_you_mean(name, known));
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
void check_whole(std::string& text) {
    Whole value = 0;
    const auto rest = rest_after_number(text, value);
    if (!rest || !rest->empty())
        throw RefusedValue{fail(Fault::usage, "options.not_a_number", "takes a whole number from {low} to {high}, not '{value}'",
                                std::numeric_limits<Whole>::min(), std::numeric_limits<Whole>::max(), text)};
    text = std::to_string(value);
}

/// Bytes with or without a unit, which is CLI11's to know.
void check_size(std::string& text) {
    std::uint64_t value = 0;
    const auto rest = rest_after_number(text, value);
    if (!rest || value == 0)
        throw RefusedValue{fail(Fault::usage, "options.not_a_size", "takes a size above 0 like 256MiB, not '{value}'", text)};
    text = std::to_string(value) + *rest;
}

/// Of a text that is a number: refuse_what_is_no_number() comes first.
double number_in(const std::string& text) {
    double value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

void check_real(std::string& text) {
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = problem == std::errc() && end == text.data() + text.size() && std::isfinite(value);
    if (!is_number) throw RefusedValue{fail(Fault::usage, "options.not_a_number", "takes a finite number, not '{value}'", text)};
}

/// A validator of CLI11, which returns why it refuses a value, from a check that throws a RefusedValue.
CLI::Validator validator(std::function<void(std::string&)> check, std::string help = "") {
    return CLI::Validator([check = std::move(check)](std::string& text) { return check(text), std::string(); }, std::move(help));
}

/// Null behind the last one.
CLI::Validator* validator_of(CLI::Option& option, int index) {
    try {
        return option.get_validator(index);
    } catch (const CLI::OptionNotFound&) {
        return nullptr;
    }
}

/// A validator does not know of which option it checks the values.
void name_in_errors(CLI::Option& option) {
    for (int i = 0; CLI::Validator* each = validator_of(option, i); ++i)
        each->operation([check = *each, &option](std::string& text) {
            try {
                return check(text);
            } catch (const RefusedValue& refused) {
                throw RefusedValue{within(refused.error, "{option}", option.get_name())};
            }
        });
}

}  // namespace

Result<void> check_names(const CLI::App& program, std::span<const std::string> arguments) {
    const CLI::App* verb = &program;
    if (std::ranges::count(arguments, "--version") > 0 && arguments.size() > 1)
        return fail(Fault::usage, "options.excluded", "{option} cannot be combined with {other}", "--version",
                    "a verb or another option");
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
        const auto check = [&](void (*each)(std::string&)) { option->transform(validator(each)); };
        if (type.starts_with("FLOAT")) check(check_real);
        else if (type.starts_with("UINT:SIZE")) check(check_size);
        else if (type.starts_with("UINT")) check(check_whole<std::uint64_t>);
        else if (type.starts_with("INT")) check(check_whole<std::int64_t>);
        name_in_errors(*option);
    }
}

CLI::Validator from_to(double low, double high) {
    const auto check = [=](const std::string& text) {
        const double value = number_in(text);
        if (!(value >= low && value <= high))
            throw RefusedValue{
                fail(Fault::usage, "options.out_of_range", "takes a number from {low} to {high}, not {value}", low, high, text)};
    };
    return validator(check, fmt::format("{} to {}", low, high));
}

CLI::Validator one_of(std::vector<std::string> words) {
    const std::string named = fmt::format("{{{}}}", fmt::join(words, ","));
    const auto check = [words = std::move(words)](const std::string& text) {
        if (std::ranges::count(words, text) > 0) return;
        const std::vector<std::string_view> known(words.begin(), words.end());
        throw RefusedValue{fail(Fault::usage, "options.not_a_choice", "takes {choices}, not '{value}'{suggestion}",
                                fmt::format("{}", fmt::join(words, " or ")), text, did_you_mean(text, known))};
    };
    return validator(check, named);
}

CLI::Validator not_negative() {
    return validator([](const std::string& text) {
        if (!(number_in(text) >= 0))
            throw RefusedValue{
                fail(Fault::usage, "options.out_of_range", "takes a number of {low} or more, not {value}", 0, text)};
    });
}

CLI::Validator positive() {
    return validator([](const std::string& text) {
        if (!(number_in(text) > 0))
            throw RefusedValue{fail(Fault::usage, "options.out_of_range", "takes a number above {low}, not {value}", 0, text)};
    });
}

CLI::Validator one_or_four() {
    const auto check = [](const std::string& text) {
        if (text != "1" && text != "4")
            throw RefusedValue{fail(Fault::usage, "options.not_a_choice", "takes {choices}, not '{value}'", "1 or 4", text)};
    };
    return validator(check, "{1,4}");
}

CLI::Validator sample_index() { return from_to(0, 3); }

Result<void> check_values(const CLI::App& verb) {
    for (const CLI::Option* option : verb.get_options()) {
        if (option->get_items_expected_min() == 0) continue;  // flags, and options whose value may be left out
        for (const std::string& value : option->results())
            if (value.find_first_not_of(" \t\r\n") == value.npos)
                return fail(Fault::usage, "options.empty_value", "the value of {option} is empty", option->get_name());
    }
    return {};
}

Result<void> check_not_given(const CLI::App& verb, std::initializer_list<const char*> options, std::string_view why) {
    for (const char* name : options)
        if (verb.get_option(name)->count() > 0)
            return fail(Fault::usage, "options.not_applicable", "{option} does not apply: {reason}", name, why);
    return {};
}

}  // namespace strata
