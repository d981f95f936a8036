// Shaders that are read where memory ends: the library that parses them does not look at what malloc returns.
#include <algorithm>
#include <cstddef>
#include <fstream>
#include <new>
#include <set>
#include <string>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/shader.h"

namespace strata {
namespace {

/// Reads the code in a process whose address space may grow by so many bytes, and ends it with 0, or with 4 for std::bad_alloc.
int exit_code_of_reading(const EmbeddedShader& embedded, rlim_t more) {
    const pid_t child = fork();
    if (child == 0) {
        std::size_t pages = 0;
        std::ifstream("/proc/self/statm") >> pages;
        const rlimit limit{pages * sysconf(_SC_PAGESIZE) + more, RLIM_INFINITY}, no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        setrlimit(RLIMIT_AS, &limit);
        try {
            _exit(reflect(std::string(embedded.name), embedded.code) ? 0 : 1);
        } catch (const std::bad_alloc&) {
            _exit(4);
        }
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(Reflection, WithoutMemoryIsAnExceptionWhereverItEnds) {
    const EmbeddedShader& largest =
        *std::ranges::max_element(embedded_shaders(), {}, [](const auto& s) { return s.code.size(); });
    std::set<int> codes;
    for (rlim_t kibibytes = 0; kibibytes <= 32768; kibibytes += 256) {
        const int code = exit_code_of_reading(largest, kibibytes << 10);
        EXPECT_TRUE(code == 0 || code == 4) << kibibytes << " KiB more: " << code;
        codes.insert(code);
    }
    EXPECT_THAT(codes, testing::ElementsAre(0, 4));
}

}  // namespace
}  // namespace strata
