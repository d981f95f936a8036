// Runs the built program and keeps what it said.
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace strata {

struct Finished {
    int code = 0;
    std::string out, err;
};

/// strata with these arguments (a shell line), in a folder of its own that is emptied for each test.
Finished strata(const std::string& arguments);

/// The same after a line of the shell's own in the same process: "ulimit -f 1", "export NAME=value".
Finished strata_after(const std::string& line, const std::string& arguments);

struct Refusal {
    std::string arguments;
    int code = 0;
    std::string sentence;  ///< on the error output, which is all that is printed
};
void expect_refusals(const std::string& verb, std::span<const Refusal>);

/// The folder; made for the running test.
std::filesystem::path folder();

}  // namespace strata
