// The verbs that need no device, with one allocation that fails or that and all that follow: they end in words, exit code 4, or
// do what they do.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "capture_format/result.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

struct VerbLine {
    const char *name, *line;
    int code = 0;  ///< with enough memory
};

void PrintTo(const VerbLine& verb, std::ostream* out) { *out << verb.name; }

constexpr VerbLine verbs[] = {
    {"list", "list --scenarios"},
    {"info", "info a.strata"},
    {"validate", "validate a.strata"},
    {"export_gltf", "export a.strata --gltf -o made.glb"},
    {"export_json", "export a.strata --json -o made.json"},
    {"diff_exr", "diff first/a.f0000.exr second/a.f0000.transparency-alpha_blend.exr", 1},
    {"diff_png", "diff first/a.f0000.png second/a.f0000.transparency-alpha_blend.png"},
};

// Static objects are made before main(), in 54 allocations: a program of C++ ends there with 134.
constexpr long before_main = 100, never = 0, for_good = 1'000'000'000;

class FailingAllocations : public testing::TestWithParam<VerbLine> {
protected:
    /// Makes the files that the verbs read.
    static void prepare() {
        ASSERT_EQ(strata("record three_panes -o a.strata --size 32x18").code, 0);
        ASSERT_EQ(strata("replay a.strata -o first").code, 0);
        ASSERT_EQ(strata("replay a.strata --use transparency/alpha_blend -o second").code, 0);
    }

    static Finished run(long from, long to) {
        for (const char* made : {"made.glb", "made.json"}) std::filesystem::remove(folder() / made);
        return strata_after(fmt::format("export LD_PRELOAD={}/libfailing_allocations.so FAIL_ALLOCATIONS='{} {}' "
                                        "COUNTED_ALLOCATIONS=count.txt",
                                        STRATA_BINARY_DIR, from, to),
                            GetParam().line);
    }

    /// With enough memory.
    long count() {
        const Finished ran = run(never, never);
        whole_ = made();
        EXPECT_EQ(ran.code, GetParam().code) << ran.err;
        long allocations = 0;
        std::ifstream(folder() / "count.txt") >> allocations;
        EXPECT_GT(allocations, before_main);
        return allocations;
    }

    /// The file that the verb wrote.
    static std::string made() {
        for (const char* name : {"made.glb", "made.json"})
            if (std::ifstream file(folder() / name, std::ios::binary); file) return {std::istreambuf_iterator<char>(file), {}};
        return "";
    }

    void fail_and_check(long from, long to) {
        SCOPED_TRACE(fmt::format("{}: allocations {} to {} fail", GetParam().name, from, to));
        const Finished ran = run(from, to);
        EXPECT_THAT(ran.code, testing::AnyOf(GetParam().code, static_cast<int>(Fault::device_lacks))) << ran.err;
        if (ran.code == GetParam().code) return;
        EXPECT_THAT(ran.err, testing::AnyOf(testing::HasSubstr("memory"), testing::HasSubstr("thread")));
        EXPECT_THAT(made(), testing::AnyOf("", whole_)) << "a part is left";
        for (const auto& entry : std::filesystem::directory_iterator(folder()))
            EXPECT_NE(entry.path().extension(), ".tmp") << entry.path() << " is left";
    }

private:
    std::string whole_;
};

TEST_P(FailingAllocations, EndInWordsOrAreNotNoticed) {
    prepare();
    const long all = count();
    for (const long number : {before_main, all / 2, all - 1}) {
        fail_and_check(number, number);
        fail_and_check(number, for_good);
    }
}

TEST_P(FailingAllocations, ExhaustiveEndInWordsOrAreNotNoticed) {
    prepare();
    constexpr long samples = 400;
    const long all = count();
    for (long i = 0; i < samples; ++i) {
        const long number = before_main + i * (all - before_main) / samples;
        fail_and_check(number, number);
        fail_and_check(number, for_good);
    }
}

INSTANTIATE_TEST_SUITE_P(Verbs, FailingAllocations, testing::ValuesIn(verbs),
                         [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace strata
