// Verbs with one allocation that fails or that and all that follow: they end in words, exit code 4, or do what they do. Of verbs
// that use a device the program's own allocations fail, not those of drivers.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "capture_format/result.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

struct VerbLine {
    const char* name;
    const char* line;
    int code = 0;  ///< with enough memory
    bool uses_device = false;
};

constexpr VerbLine verbs[] = {
    {"list", "list --scenarios"},
    {"info", "info a.strata"},
    {"validate", "validate a.strata"},
    {"export_gltf", "export a.strata --gltf -o made.glb"},
    {"export_json", "export a.strata --json -o made.json"},
    {"diff_exr", "diff first/a.f0000.exr second/a.f0000.transparency-alpha_blend.exr", 1},
    {"diff_png", "diff first/a.f0000.png second/a.f0000.transparency-alpha_blend.png"},
    {.name = "replay", .line = "replay a.strata -o made", .uses_device = true},
    {.name = "report",
     .line = "report a.strata --stage transparency --techniques weighted --repeats 1 -o report.csv",
     .uses_device = true},
};

/// Files that the verbs write, but for those that hold times.
constexpr const char* made_files[] = {"made.glb", "made.json", "made/a.f0000.exr", "made/a.f0000.png"};

// Static objects are made before main(), in 54 allocations: a program of C++ ends there with 134.
constexpr long before_main = 100, never = 0, for_good = 1'000'000'000;

/// Puts the files there that the verbs read.
void prepare() {
    ASSERT_EQ(strata("record three_panes -o a.strata --size 32x18").code, 0);
    ASSERT_EQ(strata("replay a.strata -o first").code, 0);
    ASSERT_EQ(strata("replay a.strata --use transparency/alpha_blend -o second").code, 0);
}

/// A verb, what it writes and how often it allocates.
class Starved {
public:
    /// Runs the verb with enough memory.
    explicit Starved(const VerbLine& verb) : verb_(verb) {
        const Finished ran = run(never, never);
        whole_ = made();
        EXPECT_EQ(ran.code, verb.code) << ran.err;
        std::ifstream(folder() / "count.txt") >> allocations_;
        EXPECT_GT(allocations_, before_main);
        testing::Test::RecordProperty(std::string(verb.name) + "_allocations", std::to_string(allocations_));
    }

    long allocations() const { return allocations_; }

    /// This allocation fails; then it and all after it.
    void fail_and_check(long number) const {
        fail_and_check(number, number);
        fail_and_check(number, for_good);
    }

private:
    void fail_and_check(long from, long to) const {
        SCOPED_TRACE(fmt::format("{}: allocations {} to {} fail", verb_.name, from, to));
        const Finished ran = run(from, to);
        EXPECT_THAT(ran.code, testing::AnyOf(verb_.code, static_cast<int>(Fault::device_lacks))) << ran.err;
        if (ran.code == verb_.code) return;
        EXPECT_THAT(ran.err, testing::AnyOf(testing::HasSubstr("memory"), testing::HasSubstr("thread")));
        for (const auto& [path, bytes] : made()) EXPECT_EQ(bytes, whole_.at(path)) << path << " is damaged";
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder()))
            EXPECT_NE(entry.path().extension(), ".tmp") << entry.path() << " is left";
    }

    Finished run(long from, long to) const {
        for (const char* path : made_files) std::filesystem::remove(folder() / path);
        return strata_after(fmt::format("export LD_PRELOAD={}/libfailing_allocations.so FAIL_ALLOCATIONS='{} {}' "
                                        "COUNTED_ALLOCATIONS=count.txt{}",
                                        STRATA_BINARY_DIR, from, to, verb_.uses_device ? " FAIL_IN_PROGRAM=yes" : ""),
                            verb_.line);
    }

    /// The files that the verb wrote.
    static std::map<std::string, std::string> made() {
        std::map<std::string, std::string> files;
        for (const char* path : made_files)
            if (std::ifstream file(folder() / path, std::ios::binary); file)
                files[path] = {std::istreambuf_iterator<char>(file), {}};
        return files;
    }

    VerbLine verb_;
    std::map<std::string, std::string> whole_;
    long allocations_ = 0;
};

TEST(FailingAllocations, EndEveryVerbInWordsOrAreNotNoticed) {
    prepare();
    for (const VerbLine& verb : verbs) {
        const Starved starved(verb);
        starved.fail_and_check(starved.allocations() / 2);
        if (verb.uses_device) continue;  // 2 s of CPU a pair of runs
        starved.fail_and_check(before_main);
        starved.fail_and_check(starved.allocations() - 1);
    }
}

TEST(ExhaustiveFailingAllocations, EndEveryVerbInWordsOrAreNotNoticed) {
    prepare();
    constexpr long samples = 400;
    for (const VerbLine& verb : verbs) {
        const Starved starved(verb);
        for (long i = 0; i < samples; ++i)
            starved.fail_and_check(before_main + i * (starved.allocations() - before_main) / samples);
    }
}

}  // namespace
}  // namespace strata
