// Every bad file through every verb that reads one: the right exit code, a sentence that names the file, nothing written.
#include <algorithm>
#include <fstream>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/file_verbs.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

/// The files of the folder but what a run prints, with what is in them.
std::map<std::string, Bytes> files() {
    std::map<std::string, Bytes> found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
        const std::string name = entry.path().lexically_relative(folder()).string();
        if (entry.is_regular_file() && name != "stdout.txt" && name != "stderr.txt") found[name] = read_file(entry.path());
    }
    return found;
}

/// Runs the verb on the bad file that is there: refused as bad input with a sentence that names it, with this id.
void expect_refused(const FileVerb& verb, const std::string& id) {
    const auto before = files();
    const Finished refused = strata("-v " + verb.command());
    EXPECT_EQ(refused.code, 3) << refused.err;
    EXPECT_THAT(refused.err, testing::AllOf(HasSubstr(verb.file()), HasSubstr("\nstrata: " + id)));
    EXPECT_EQ(refused.out, "");
    EXPECT_TRUE(files() == before) << "something was written";
}

class BadFile : public testing::TestWithParam<FileVerb> {};

TEST_P(BadFile, EmptyMissingOrAFolderIsRefused) {
    expect_refused(GetParam(), "");
    std::filesystem::create_directory(folder() / GetParam().file());
    expect_refused(GetParam(), "");
    std::filesystem::remove(folder() / GetParam().file());
    write_file(folder() / GetParam().file(), {});
    expect_refused(GetParam(), "");
}

TEST_P(BadFile, RandomBytesAreRefused) {
    std::mt19937 random(1);
    for (const std::size_t size : std::initializer_list<std::size_t>{1, 15, 16, 4096, 100000}) {
        Bytes bytes(size);
        std::ranges::generate(bytes, [&] { return static_cast<std::byte>(random()); });
        write_file(folder() / GetParam().file(), bytes);
        expect_refused(GetParam(), "");
    }
}

std::string verb_test_name(const testing::TestParamInfo<FileVerb>& info) { return std::string(info.param.name); }

INSTANTIATE_TEST_SUITE_P(Verbs, BadFile, testing::ValuesIn(file_verbs()), verb_test_name);

// Every verb reads captures with the same code: one of them meets every lie and every cut, the others a part.
class BadCapture : public testing::TestWithParam<FileVerb> {
protected:
    static bool meets_all() { return GetParam().name == "info"; }

    static void expect_lies_refused(std::size_t first, std::size_t step) {
        static const std::vector<ForgedCapture> forged = forged_captures();
        for (std::size_t i = first; i < forged.size(); i += step) {
            SCOPED_TRACE(forged[i].name);
            write_file(folder() / GetParam().file(), forged[i].bytes);
            expect_refused(GetParam(), forged[i].id);
        }
    }
};

TEST_P(BadCapture, ThatLiesBehindRightChecksumsIsRefusedWithSectionAndOffset) {
    const std::vector<FileVerb> verbs = capture_verbs();
    const auto place = std::ranges::find(verbs, GetParam().name, &FileVerb::name) - verbs.begin();
    if (meets_all()) expect_lies_refused(0, 1);
    else expect_lies_refused(static_cast<std::size_t>(place), verbs.size());
}

TEST_P(BadCapture, ExhaustiveThatLiesBehindRightChecksumsIsRefusedWithSectionAndOffset) { expect_lies_refused(0, 1); }

// The first of the frames, which are of 16 x 9 pixels, lies in the second quarter.
TEST_P(BadCapture, ThatIsCutIsRefusedOrReadUpToTheCutWhenAllowed) {
    const Bytes good = sound_capture();
    std::vector<std::size_t> sizes = {good.size() * 3 / 4, good.size() / 4};
    if (meets_all()) sizes.insert(sizes.end(), {good.size() - 1, 16, 3});
    for (const std::size_t size : sizes) {
        SCOPED_TRACE(size);
        write_file(folder() / GetParam().file(), std::span(good).first(size));
        expect_refused(GetParam(), "");
        if (!GetParam().takes_partial) continue;
        const Finished partial = strata(GetParam().command() + " --allow-partial");
        EXPECT_EQ(partial.code, size > good.size() / 2 ? 0 : 3) << partial.err;
        EXPECT_THAT(partial.err, HasSubstr(size > good.size() / 2 ? "left out" : GetParam().file()));
        for (const auto& made : files())
            if (made.first != GetParam().file()) std::filesystem::remove(folder() / made.first);
    }
}

TEST_P(BadCapture, OfTheFutureWhoseTextIsNoUtf8OrCommandsATerminalIsReadAndShownWithoutThat) {
    write_file(folder() / GetParam().file(), capture_with_unknown_section());
    for (const std::string more : {"", " --json"}) {
        const Finished read = strata(GetParam().command() + more);
        if (read.code == 2 && !more.empty()) continue;  // a verb without --json
        EXPECT_EQ(read.code, 0) << read.err;
        EXPECT_THAT(read.err, testing::AllOf(HasSubstr("(unknown)"), HasSubstr("type 77")));
        EXPECT_EQ((read.out + read.err).find_first_of("\x1b\x07\x9b\xff"), std::string::npos) << read.out << read.err;
    }
}

TEST_P(BadCapture, AFrameThatDoesNotExistIsAUsageError) {
    write_file(folder() / GetParam().file(), sound_capture());
    for (const char* option :
         {" --frame 4", " --frame 99999999999999999999", " --frames 4", " --frames 0-18446744073709551615"}) {
        const Finished refused = strata(GetParam().command() + option);
        EXPECT_EQ(refused.code, 2) << option << refused.err;
        EXPECT_FALSE(refused.err.empty());
    }
    EXPECT_EQ(files().size(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Verbs, BadCapture, testing::ValuesIn(capture_verbs()), verb_test_name);

}  // namespace
}  // namespace strata
