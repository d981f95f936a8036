// Every verb that reads a file, and the command that makes it read one. A new verb joins all tests of bad files by its row.
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/core.h>

namespace strata {

struct FileVerb {
    std::string_view name;
    std::string_view before, after;  ///< the command around the file
    std::string_view extension;      ///< of what it reads
    bool takes_partial = false;      ///< whether it reads what is whole of a damaged capture when told so

    std::string file() const { return fmt::format("bad{}", extension); }
    std::string command() const { return fmt::format("{} {} {}", before, file(), after); }
};
inline void PrintTo(const FileVerb& verb, std::ostream* out) { *out << verb.command(); }

std::span<const FileVerb> file_verbs();
/// Every verb of the help.
std::span<const char* const> verb_names();
/// Those that read captures.
std::vector<FileVerb> capture_verbs();

}  // namespace strata
