// Shaders that are read where memory ends: the library that parses them does not look at what malloc returns.
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <map>
#include <new>
#include <string>
#include <utility>

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "passes/graph/shader.h"

namespace strata {
namespace {

/// Takes all that the allocator has, or a gigabyte, and lets the process grow no more: how much that is depends on what ran
/// before and on the size of pages. Leaves one block of so many bytes.
void leave_memory(std::size_t bytes) {
    mallopt(M_MMAP_THRESHOLD, 32 << 20);
    mallopt(M_TRIM_THRESHOLD, -1);
    void* volatile left = std::malloc(bytes);  // the compiler may leave out what is only freed
    const rlimit none{1, RLIM_INFINITY};
    setrlimit(RLIMIT_AS, &none);
    void** last = nullptr;
    std::size_t taken = 0;
    for (std::size_t size = 64u << 20; size >= sizeof(last); size /= 2)
        while (taken < std::size_t{1} << 30) {
            const auto next = static_cast<void**>(std::malloc(size));
            if (!next) break;
            *next = std::exchange(last, next);
            taken += size;
        }
    std::free(left);
}

/// Reads the code in a process that has memory for so many bytes, and ends it with 0, or with 4 for std::bad_alloc.
int exit_code_of_reading(const EmbeddedShader& embedded, std::size_t bytes) {
    const pid_t child = fork();
    if (child == 0) {
        const rlimit no_core{0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        leave_memory(bytes);
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
    std::map<int, int> count_of_code;
    for (std::size_t kibibytes = 0; kibibytes < 32768 && count_of_code[0] < 8; kibibytes += 128) {
        const int code = exit_code_of_reading(largest, kibibytes << 10);
        EXPECT_TRUE(code == 0 || code == 4) << kibibytes << " KiB: " << code;
        count_of_code[code]++;
    }
    EXPECT_GE(count_of_code[4], 8);
    EXPECT_EQ(count_of_code[0], 8);
}

}  // namespace
}  // namespace strata
