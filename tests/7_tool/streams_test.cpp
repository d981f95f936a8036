// Standard streams that are closed or full, pipes that nobody reads, signals, machines that start no thread: every verb.
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/file_verbs.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::HasSubstr;

void write_sound() { write_file(folder() / "sound.strata", sound_capture()); }

/// What verbs print, by more than their help.
constexpr const char* printing[] = {
    "list",
    "list --json",
    "list --scenarios",
    "list --names",
    "info sound.strata",
    "info sound.strata --json",
    "validate sound.strata",
    "graph sound.strata",
    "graph sound.strata --dot",
    "isa",
    "--list-gpus",
    "",
};

/// The same on a device, which takes longer.
constexpr const char* printing_slowly[] = {
    "replay sound.strata --frames 0 --outputs color -o out",
    "replay sound.strata --frames 0 --outputs color -o out --json",
    "accept sound.strata --frames 0 --dry-run",
    "diff sound.strata --frames 0 --use transparency/weighted --limit 1000",
    "probe sound.strata --at 8,4 --techniques sorted_lists --depths 16 -o probed",
};

void expect_full_output(const std::string& arguments) {
    const Finished full = strata_into(">/dev/full 2>stderr.txt", "-v " + arguments);
    EXPECT_THAT(full, Refuses(2, "stdout.cannot_write", "reason=\"No space left on device\"")) << arguments;
}

void expect_lost_output(const std::string& arguments) {
    expect_full_output(arguments);
    const Finished closed = strata_into(">&- 2>stderr.txt", "-v " + arguments);
    EXPECT_THAT(closed, Refuses(2, "stdout.cannot_write", "reason=\"Bad file descriptor\"")) << arguments;
}

TEST(StandardOutput, ThatTakesNothingIsAnOutputThatCannotBeWrittenForEveryVerb) {
    write_sound();
    for (const char* arguments : printing) expect_lost_output(arguments);
    for (const char* arguments : printing_slowly) expect_full_output(arguments);
    for (const std::string verb : verb_names()) expect_lost_output(verb + " --help");
    EXPECT_EQ(strata_into(">/dev/full 2>stderr.txt", "--version").code, 2);
}

TEST(StandardOutput, ThatTakesNothingDoesNotHideThatExpectationsAreStored) {
    write_sound();
    const Finished full = strata_into(">/dev/full 2>stderr.txt", "-v accept sound.strata --frames 0");
    EXPECT_THAT(full, Refuses(2, "stdout.cannot_write"));
    EXPECT_THAT(full.err, HasSubstr("stored in sound.strata\n"));
    EXPECT_THAT(strata("accept sound.strata --frames 0").out, HasSubstr("nothing changed"));
}

// What the verb found counts, too.
TEST(StandardOutput, ThatTakesNothingDoesNotHideWhatDiffers) {
    write_sound();
    EXPECT_EQ(strata_into(">/dev/full 2>stderr.txt", "diff sound.strata --frames 0 --use transparency/weighted").code, 1);
}

TEST(StandardOutput, ByItsNameIsNoFileWhereItIsClosed) {
    EXPECT_THAT(strata_into(">&- 2>stderr.txt", "-v record three_panes -o /dev/stdout"),
                Refuses(2, "file.cannot_write", "file=/dev/stdout"));
}

// Like every program in a pipeline: 141 is SIGPIPE's.
TEST(StandardOutput, ThatNobodyReadsEndsTheProgramWithoutAWord) {
    const std::string line = "(sleep .2; " STRATA_BINARY_DIR "/strata list 2>stderr.txt; echo $? >code.txt) | true";
    ASSERT_EQ(std::system(fmt::format("cd {} && {}; sleep .1", folder().string(), line).c_str()), 0);
    while (!std::filesystem::exists(folder() / "code.txt")) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::ifstream code(folder() / "code.txt");
    int number = 0;
    code >> number;
    EXPECT_EQ(number, 141);
    EXPECT_EQ(std::filesystem::file_size(folder() / "stderr.txt"), 0u);
}

TEST(StandardError, ThatTakesNothingChangesNoExitCodeOfAnyVerb) {
    for (const FileVerb& verb : file_verbs())
        for (const char* lost : {">stdout.txt 2>/dev/full", ">stdout.txt 2>&-", "<&- >stdout.txt 2>&-"})
            EXPECT_EQ(strata_into(lost, verb.command()).code, 3) << verb.command() << " " << lost;
    for (const std::string verb : verb_names())
        EXPECT_EQ(strata_into(">stdout.txt 2>/dev/full", verb + " --nonsense").code, 2) << verb;
}

/// Of the messages, none is in a file, and no file is left out.
TEST(StandardError, ThatTakesNothingChangesNoFile) {
    write_sound();
    ASSERT_EQ(strata("record three_panes -o with.strata").code, 0);
    ASSERT_EQ(strata("replay sound.strata --outputs color -o with").code, 0);
    for (const char* lost : {">stdout.txt 2>&-", ">stdout.txt 2>/dev/full", "<&- >&- 2>&-"}) {
        const bool prints = std::string(lost).find(">&- 2") == std::string::npos;
        ASSERT_EQ(strata_into(lost, "record three_panes -o without.strata").code, 0) << lost;
        EXPECT_EQ(read_file(folder() / "with.strata"), read_file(folder() / "without.strata")) << lost;
        ASSERT_EQ(strata_into(lost, "replay sound.strata --outputs color -o without").code, prints ? 0 : 2) << lost;
        for (const auto& entry : std::filesystem::directory_iterator(folder() / "with")) {
            if (entry.path().extension() == ".json") continue;  // holds times
            EXPECT_EQ(read_file(entry.path()), read_file(folder() / "without" / entry.path().filename())) << lost << entry.path();
        }
        std::filesystem::remove_all(folder() / "without");
    }
}

TEST(Signals, ThatEndTheProgramLeaveNoTemporary) {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2}) {
        const pid_t process = start(STRATA_BINARY_DIR "/strata", "record three_panes --frames 100000 -o made.strata");
        while (std::filesystem::is_empty(folder())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        kill(process, signal);
        EXPECT_EQ(code_of(process), 128 + signal);
        EXPECT_TRUE(std::filesystem::is_empty(folder())) << signal;
    }
}

TEST(Signals, OfAPipeThatNobodyReadsAreFailedWrites) {
    const pid_t process = start(STRATA_BINARY_DIR "/strata", "record three_panes --frames 20 -o made.strata");
    while (std::filesystem::is_empty(folder())) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(process, SIGPIPE);
    EXPECT_EQ(code_of(process), 0);
    const Finished into_pipe = strata_into(">/dev/null 2>&1 | true", "record three_panes --frames 20 -o other.strata 2>&1");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder()), std::filesystem::directory_iterator()), 2);
}

// A thread's stack takes what the limit of the main thread's says: no machine has 256 TiB of addresses.
TEST(Threads, ThatCannotBeStartedAreASentenceOfEveryVerb) {
    const std::string none = "ulimit -s 274877906944";
    if (std::system((none + " 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "the size of stacks is limited";
    for (const std::string verb : verb_names()) {
        const Finished refused = strata_after(none, "-v " + verb + " --help");
        EXPECT_EQ(refused.code, 4) << verb;
        EXPECT_THAT(refused.err, HasSubstr("machine.no_thread: ")) << verb;
    }
}

// Its distance to the names of commands took 28 s.
TEST(Files, WithAWordOfMegabytesAreRefusedInASentence) {
    write_sound();
    std::ofstream(folder() / "long.script") << std::string(5'000'000, 'x') << "\n";
    const Finished refused = strata("-v inspect sound.strata --script long.script");
    EXPECT_THAT(refused, Refuses(2, "script.unknown_command", "command=xxx"));
    EXPECT_LT(refused.err.size(), 40'000u) << "the sentence and the command that is one of its values";
}

TEST(Files, ThatArePipesOrFoldersAreRefusedByEveryVerbBeforeTheyAreOpened) {
    for (const FileVerb& verb : file_verbs()) {
        ASSERT_EQ(mkfifo((folder() / verb.file()).c_str(), 0600), 0);
        const Finished refused =
            strata_after("true", "--version >/dev/null; timeout 5 " STRATA_BINARY_DIR "/strata -v " + verb.command());
        EXPECT_THAT(refused, Refuses(3, "file.not_a_file", "file=" + verb.file())) << verb.command();
        std::filesystem::remove(folder() / verb.file());
    }
    write_sound();
    std::filesystem::create_directory(folder() / "folder");
    ASSERT_EQ(mkfifo((folder() / "pipe").c_str(), 0600), 0);
    for (const char* script : {"folder", "pipe", "nowhere"}) {
        const Finished refused = strata(fmt::format("-v inspect sound.strata --script {}", script));
        EXPECT_THAT(refused.err, HasSubstr(fmt::format("file={}", script)));
        EXPECT_EQ(refused.code, 3) << script;
    }
    for (const char* second : {"diff sound.strata pipe", "diff a.exr pipe.exr", "diff pipe sound.strata"})
        EXPECT_EQ(strata(second).code, 3) << second;
}

}  // namespace
}  // namespace strata
