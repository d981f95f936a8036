#include "tests/support/accept.h"

#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace strata {

bool accepting() {
    const char* accept = std::getenv("STRATA_ACCEPT");
    return accept && std::string_view(accept) == "1";
}

std::string command_that_accepts() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
    return fmt::format("STRATA_ACCEPT=1 {} --gtest_filter={}.{}", program, test.test_suite_name(), test.name());
}

}  // namespace strata
