#include "tests/7_tool/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/file_text.h"

namespace strata {
namespace {

/// The id of an error and its values, as -v prints them last.
std::pair<std::string, std::string> id_and_values(const Finished& failed) {
    constexpr std::string_view prefix = "strata: ";
    const std::string lines = failed.err.substr(0, failed.err.rfind('\n'));
    const std::size_t begin = lines.rfind('\n') + 1;
    if (lines.compare(begin, prefix.size(), prefix) != 0) return {};
    const std::string line = lines.substr(begin + prefix.size());
    const std::size_t colon = line.find(": ");
    return {line.substr(0, colon), colon == line.npos ? "" : line.substr(colon + 2)};
}

/// A line of the shell after "cd" into the folder.
Finished run_line(const std::string& line) {
    for (const char* old : {"stdout.txt", "stderr.txt"}) std::filesystem::remove(folder() / old);
    const int status = std::system(fmt::format("cd {} && {}", folder().string(), line).c_str());
    return {WEXITSTATUS(status), file_text(folder() / "stdout.txt"), file_text(folder() / "stderr.txt")};
}

}  // namespace

std::filesystem::path folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    const auto path =
        std::filesystem::path(testing::TempDir()) / "strata_tool" / (std::string(test->test_suite_name()) + "_" + test->name());
    static std::string made;
    if (made != path.string()) {
        std::filesystem::remove_all(path);
        std::filesystem::create_directories(path);
        made = path.string();
    }
    return path;
}

std::filesystem::path only_file(const std::filesystem::path& in, const std::string& extension) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(in))
        if (entry.path().extension() == extension) found.push_back(entry.path());
    EXPECT_EQ(found.size(), 1u) << in;
    return found.empty() ? std::filesystem::path() : found.front();
}

Finished shell(const std::string& line) { return run_line(line + " >stdout.txt 2>stderr.txt"); }

Finished strata(const std::string& arguments) { return strata_after("true", arguments); }

Finished strata_after(const std::string& line, const std::string& arguments) {
    return run_line(fmt::format("{} && " STRATA_BINARY_DIR "/strata {} >stdout.txt 2>stderr.txt", line, arguments));
}

Finished strata_into(const std::string& redirections, const std::string& arguments) {
    return run_line(fmt::format(STRATA_BINARY_DIR "/strata {} {}", arguments, redirections));
}

pid_t start(const std::string& program, const std::string& arguments, const std::string& output) {
    std::vector<std::string> words = {program};
    std::istringstream stream(arguments);
    for (std::string word; stream >> word;) words.push_back(word);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder().c_str());
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    // A suite that runs in the background of a script ignores SIGINT, and what it starts would, too.
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &interrupt);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t process = 0;
    EXPECT_EQ(posix_spawnp(&process, pointers[0], &actions, &attributes, pointers.data(), environ), 0) << program;
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return process;
}

int code_of(pid_t process) {
    int status = 0;
    waitpid(process, &status, 0);
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

void PrintTo(const Finished& finished, std::ostream* out) {
    *out << "exit code " << finished.code << "\n" << finished.out << finished.err;
}

testing::Matcher<const Finished&> Refuses(int code, const std::string& id, const std::string& values) {
    return testing::AllOf(testing::Field("exit code", &Finished::code, code),
                          testing::ResultOf(id_and_values, testing::Pair(id, testing::HasSubstr(values))));
}

void expect_refusals(const std::string& verb, std::span<const Refusal> refusals) {
    for (const auto& [arguments, code, id, values] : refusals) {
        const Finished refused = strata("-v " + verb + " " + arguments);
        EXPECT_THAT(refused, Refuses(code, id, values)) << arguments;
        EXPECT_EQ(refused.out, "") << arguments;
    }
}

}  // namespace strata
