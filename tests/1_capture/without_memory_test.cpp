// Each allocation in turn fails, or that one and all that follow: what records, reads, imports and exports ends in words or is
// right.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <set>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/1_capture/without_memory/two_frames.h"
#include "tests/support/deep_exr.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

constexpr long never = 0, for_good = 1'000'000'000;

struct Ran {
    int code = 0;  ///< 128 + signal where one ended it
    long allocations = 0;
    std::string said;
};

class WithoutMemory : public testing::TestWithParam<const char*> {
protected:
    const std::string verb = GetParam();
    const TemporaryFile file, out{"out"}, err{"err"};

    /// The program, of which these allocations fail. What hangs is ended.
    Ran run(long first, long last) const {
        const std::string program = STRATA_BINARY_DIR "/without_memory", from = std::to_string(first), to = std::to_string(last);
        const pid_t child = ::fork();
        if (child == 0) {
            constexpr rlimit no_core = {};
            ::setrlimit(RLIMIT_CORE, &no_core);
            ::alarm(10);
            ::setenv("LD_PRELOAD", STRATA_BINARY_DIR "/libfailing_allocations.so", 1);
            if (!std::freopen(out.path().c_str(), "w", stdout) || !std::freopen(err.path().c_str(), "w", stderr)) ::_exit(97);
            ::execl(program.c_str(), program.c_str(), verb.c_str(), file.path().c_str(), from.c_str(), to.c_str(), nullptr);
            ::_exit(97);
        }
        int status = 0;
        ::waitpid(child, &status, 0);
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        return {code, std::atol(file_text(out.path()).c_str()), file_text(err.path())};
    }

    /// The verb's input; for one that writes, the file that lies where it does so.
    void prepare() const {
        constexpr std::string_view old = "old";
        if (verb == "record") std::filesystem::remove(file.path());
        if (verb == "export_gltf") write_file(file.path(), bytes_of(old));
        if (verb == "import_gltf")
            write_file(file.path(), bytes_of(with_image(fmt::format(R"("uri":"data:image/png;base64,{}")", tiny_png), "")));
        DeepSource deep{.width = 3, .height = 2, .pixels = {}};
        for (int i = 0; i < 6; ++i) deep.pixels.push_back({{1, .5f, .25f, .5f, 2}, {0, .5f, .25f, .5f, 3}});
        if (verb == "import_deep") write_file(file.path(), bytes_of(deep_file(deep)));
    }

    void check_file(const Ran& ran) const {
        if (verb == "record" && (ran.code == 0 || std::filesystem::exists(file.path()))) {
            const auto capture = Capture::open(file.path(), ran.code == 0 ? Partial::refused : Partial::allowed);
            ASSERT_TRUE(capture) << capture.error().sentence;
            EXPECT_TRUE(ran.code != 0 || capture->frame_count() == 2);
            for (std::size_t i = 0; i < capture->frame_count(); ++i) {
                const auto frame = capture->frame(i);
                ASSERT_TRUE(frame) << frame.error().sentence;
                EXPECT_EQ(bits_of(*frame), bits_of(two_frames()[i]));
            }
        }
        EXPECT_TRUE(verb != "export_gltf" || file_text(file.path()).substr(0, 4) == (ran.code == 0 ? "glTF" : "old"));
        for (const auto& each : std::filesystem::directory_iterator(file.path().parent_path()))
            EXPECT_FALSE(each.path().string().starts_with(file.path().string() + ".")) << each.path() << " is left";
    }

    void fail_and_check(long first, long last) const {
        SCOPED_TRACE(fmt::format("{}: allocations {} to {} fail", verb, first, last));
        if (verb != "import_gltf" && verb != "import_deep" && verb != "read") prepare();
        const Ran ran = run(first, last);
        EXPECT_THAT(ran.code, testing::AnyOf(0, static_cast<int>(Fault::device_lacks))) << ran.said;
        EXPECT_TRUE(ran.code == 0 || ran.said.find("memory") != ran.said.npos || ran.said.find("thread") != ran.said.npos)
            << ran.said;
        check_file(ran);
    }

    /// How many allocations there are when none fails.
    long count() const {
        prepare();
        if (verb == "read") {
            const auto recorder = std::string(STRATA_BINARY_DIR "/without_memory");
            EXPECT_EQ(std::system(fmt::format("LD_PRELOAD={}/libfailing_allocations.so {} record {} 0 0 >{}", STRATA_BINARY_DIR,
                                              recorder, file.path().string(), out.path().string())
                                      .c_str()),
                      0);
        }
        const Ran ran = run(never, never);
        EXPECT_EQ(ran.code, 0) << ran.said;
        EXPECT_GT(ran.allocations, 5);
        check_file(ran);
        return ran.allocations;
    }
};

TEST_P(WithoutMemory, EndsInWordsOrIsRight) {
    constexpr long samples = 20;
    const long all = count();
    std::set<long> numbers = {1, 2, 3, 4, all - 1, all};
    for (long i = 0; i < samples; ++i) numbers.insert(1 + i * all / samples);
    for (const long number : numbers) {
        fail_and_check(number, number);
        fail_and_check(number, for_good);
    }
}

TEST_P(WithoutMemory, ExhaustiveEndsInWordsOrIsRight) {
    const long all = count();
    for (long number = 1; number <= all; ++number)
        for (const long last : {number, number + 2, for_good}) fail_and_check(number, last);
}

INSTANTIATE_TEST_SUITE_P(Verbs, WithoutMemory,
                         testing::Values("compress", "record", "read", "import_gltf", "import_deep", "export_gltf"),
                         [](const auto& each) { return std::string(each.param); });

}  // namespace
}  // namespace strata
