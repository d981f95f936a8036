// Runs the built program and keeps what it said.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <iosfwd>
#include <span>
#include <string>

#include <gmock/gmock.h>

namespace strata {

struct Finished {
    int code = 0;
    std::string out, err;
};
void PrintTo(const Finished&, std::ostream*);

/// strata with these arguments (a shell line), in a folder of its own that is emptied for each test.
Finished strata(const std::string& arguments);

/// The same after a line of the shell's own in the same process: "ulimit -f 1", "export NAME=value".
Finished strata_after(const std::string& line, const std::string& arguments);

/// The same with other redirections than ">stdout.txt 2>stderr.txt", the files in which what it said is looked for.
Finished strata_into(const std::string& redirections, const std::string& arguments);

/// A line of the shell in that folder.
Finished shell(const std::string& line);

/// A program in the background, without a shell (whose children there ignore SIGINT); arguments are parted by spaces. What it
/// prints goes to the file of the folder.
pid_t start(const std::string& program, const std::string& arguments, const std::string& output = "/dev/null");
/// What became of it, once it ended; 128 + signal where one ended it before main().
int code_of(pid_t);

/// Matches a program that was started with -v and ended with this exit code and this error, whose last line is then
/// "strata: ID: name=value ...". The text is part of the values.
testing::Matcher<const Finished&> Refuses(int code, const std::string& id, const std::string& values = "");

struct Refusal {
    std::string arguments;
    int code = 0;
    std::string id, values;  ///< of the error, which is all that is printed
};
void expect_refusals(const std::string& verb, std::span<const Refusal>);

/// The one file of that extension in a folder; fails the test where there are more or none.
std::filesystem::path only_file(const std::filesystem::path& in, const std::string& extension);

/// The folder; made for the running test.
std::filesystem::path folder();

}  // namespace strata
