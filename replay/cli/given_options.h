// What a command line says, judged before its verb runs: names that exist, numbers that are numbers, options that apply.
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "replay/cli/verb.h"

namespace strata {

/// Fails where an argument names a verb or an option that does not exist, and says which one is nearest.
Result<void> check_names(const CLI::App& program, std::span<const std::string> arguments);

/// From now on the verb's options for numbers refuse what is no finite decimal number or does not fit (nan, inf, 0x10, 2^64, -1
/// where nothing is below 0), which CLI11 2.1 takes or wraps around; and validators' errors name the option. To be called when
/// all options are declared.
void refuse_what_is_no_number(CLI::App& verb);

/// What validators throw of a value that they refuse. refuse_what_is_no_number() adds the option's name.
struct RefusedValue {
    Error error;
};

/// For options whose number has bounds, which are in the help and in the sentence. Every option for a whole number of less than
/// 64 bits needs some: CLI11 2.1 says "Could not convert" of a number that does not fit.
CLI::Validator from_to(double low, double high);

/// For options that take one of these words.
CLI::Validator one_of(std::vector<std::string> words);

/// For options whose number is 0 or more.
CLI::Validator not_negative();

/// For options whose number is above 0.
CLI::Validator positive();

/// For samples per pixel, and for the index of one of them.
CLI::Validator one_or_four();
CLI::Validator sample_index();

/// Fails where an option or argument that was given is empty or blank, which would count as not given.
Result<void> check_values(const CLI::App& verb);

/// Fails where one of these options was given: it would be ignored, and `why` says why.
Result<void> check_not_given(const CLI::App& verb, std::initializer_list<const char*> options, std::string_view why);

}  // namespace strata
