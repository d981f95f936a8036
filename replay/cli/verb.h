// What a verb of the command line is: one file, one row in verbs.cpp.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "capture_format/result.h"

namespace CLI {
class App;
class Validator;
}  // namespace CLI

namespace strata {

/// Type names of options for files: a verb does not replace a file it reads, also where an output is a link to it.
inline constexpr const char *input_file = "INPUT", *output_file = "OUTPUT";
inline constexpr const char* input_files = "INPUTS";    ///< such files, or folders of them
inline constexpr const char* output_folder = "FOLDER";  ///< made where it is missing
inline constexpr const char* judged_file = "CAPTURE";   ///< read by a verb that says itself what is wrong with it
inline constexpr const char* extended_file = "FILE";    ///< read and replaced by what is longer

struct Verb {
    std::string_view name, summary;
    /// Declares the options and returns what runs once they are parsed.
    std::function<Result<void>()> (*declare)(CLI::App&);
};

/// Every verb, in the order of the help.
std::span<const Verb> verbs();

}  // namespace strata
