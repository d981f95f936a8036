// Runs a program's tests and lists those that took more than 5 s of CPU: each of them is a decision, and belongs to the
// exhaustive suite unless nothing cheaper notices what it notices.
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include <sys/resource.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace strata {
namespace {

constexpr double dear_seconds = 5;

double seconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

/// Of all threads of the process, the driver's included, and of the processes it has waited for.
double cpu_seconds() {
    double sum = 0;
    for (const int whose : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(whose, &used);
        sum += seconds(used.ru_utime) + seconds(used.ru_stime);
    }
    return sum;
}

class CpuSeconds : public testing::EmptyTestEventListener {
    struct Row {
        std::string name;
        double cpu = 0;
    };

    void OnTestStart(const testing::TestInfo&) override { start_ = cpu_seconds(); }

    void OnTestEnd(const testing::TestInfo& test) override {
        const double cpu = cpu_seconds() - start_;
        total_ += cpu;
        if (cpu > dear_seconds) dear_.push_back({std::string(test.test_suite_name()) + "." + test.name(), cpu});
    }

    void OnTestProgramEnd(const testing::UnitTest&) override {
        std::ranges::sort(dear_, std::ranges::greater(), &Row::cpu);
        if (dear_.empty()) return;
        std::printf("%.0f s of CPU, of which tests over %.0f s:\n", total_, dear_seconds);
        for (const Row& row : dear_) std::printf("%7.1f s  %s\n", row.cpu, row.name.c_str());
    }

    double start_ = 0, total_ = 0;
    std::vector<Row> dear_;
};

}  // namespace
}  // namespace strata

int main(int count, char** arguments) {
    // Signals that a shell's & or nohup lets this program ignore, and with it the programs that it starts: tests send them to
    // both.
    for (const int signal : {SIGINT, SIGQUIT, SIGHUP}) std::signal(signal, SIG_DFL);
    testing::InitGoogleMock(&count, arguments);
    testing::UnitTest::GetInstance()->listeners().Append(new strata::CpuSeconds);  // GoogleTest deletes it
    return RUN_ALL_TESTS();
}
