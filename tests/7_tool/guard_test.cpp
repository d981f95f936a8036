// docs/examples/guard/guard.sh, the recipe of docs/guard.md: what it prints and writes, and its exit codes.
#include <algorithm>
#include <fstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

using testing::HasSubstr;

class Guard : public testing::Test {
protected:
    void SetUp() override {
        for (const char* made : {"golden", "new"}) std::filesystem::create_directory(folder() / made);
        for (const char* scenario : {"three_panes", "three_cards"})
            ASSERT_EQ(strata(fmt::format("record {0} -o golden/{0}.strata --size 32x18", scenario)).code, 0);
        for (const char* scenario : {"three_panes", "three_cards"})
            std::filesystem::copy(folder() / "golden" / (std::string(scenario) + ".strata"), folder() / "new");
    }
    static Finished guard(const std::string& options = "") {
        return shell("STRATA=" STRATA_BINARY_DIR "/strata " STRATA_SOURCE_DIR "/docs/examples/guard/guard.sh golden new out " +
                     options);
    }
    static bool exists(const std::string& name) { return std::filesystem::exists(folder() / name); }
};

TEST_F(Guard, PassesWhereNothingChanged) {
    const Finished run = guard();
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("three_panes.strata                       passes\n"));
    EXPECT_THAT(file_text(folder() / "out/three_panes.strata.xml"), HasSubstr("failures=\"0\""));
    EXPECT_FALSE(exists("out/three_panes.strata.html"));
}

TEST_F(Guard, NamesWhatDiffersAndWritesItsPage) {
    std::filesystem::copy(folder() / "golden/three_cards.strata", folder() / "new/three_panes.strata",
                          std::filesystem::copy_options::overwrite_existing);
    const Finished run = guard("--images display --limit .02 --percent .1 --region 25");
    EXPECT_EQ(run.code, 1) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("display: percent of pixels over 0.02: "));
    EXPECT_THAT(run.out, HasSubstr("see " + (folder() / "out/three_panes.strata.html\n").string()));
    EXPECT_THAT(run.out, HasSubstr("three_cards.strata                       passes\n"));
    EXPECT_THAT(file_text(folder() / "out/three_panes.strata.html"), HasSubstr("<h1>Over tolerance: "));
    EXPECT_THAT(file_text(folder() / "out/three_panes.strata.xml"), HasSubstr("failures=\"1\""));
    std::filesystem::copy(folder() / "golden/three_panes.strata", folder() / "new/three_panes.strata",
                          std::filesystem::copy_options::overwrite_existing);
    EXPECT_EQ(guard().code, 0);
    EXPECT_FALSE(exists("out/three_panes.strata.html")) << "an outdated page";
}

TEST_F(Guard, WhatIsMissingNewOrDamagedIsNoPass) {
    std::filesystem::rename(folder() / "new/three_panes.strata", folder() / "new/other.strata");
    const Finished run = guard();
    EXPECT_EQ(run.code, 2);
    EXPECT_THAT(run.out, HasSubstr("is missing in the new folder\n"));
    EXPECT_THAT(run.out, HasSubstr("has no golden one; to accept it: cp " + (folder() / "new/other.strata ").string()));
    std::filesystem::rename(folder() / "new/other.strata", folder() / "new/three_panes.strata");
    std::filesystem::resize_file(folder() / "new/three_panes.strata", 100);
    EXPECT_EQ(guard().code, 2);
    EXPECT_THAT(guard().out, HasSubstr("three_panes.strata                       exit code 3: strata: "));
    EXPECT_THAT(file_text(folder() / "out/three_panes.strata.xml"), HasSubstr("<error message=\"exit code 3: "));
    EXPECT_FALSE(exists("out/other.strata.xml")) << "of an earlier run";
    for (const char* emptied : {"golden", "new"}) std::filesystem::remove_all(folder() / emptied);
    for (const char* made : {"golden", "new"}) std::filesystem::create_directory(folder() / made);
    EXPECT_THAT(guard().out, HasSubstr("holds nothing to compare\n"));
    EXPECT_EQ(guard().code, 2);
}

/// Names are those of a shell's worst day; images have no name that --images could choose.
TEST_F(Guard, TakesFoldersCapitalsAndOddNamesAndImagesBesideCaptures) {
    ASSERT_EQ(strata("replay golden/three_panes.strata --outputs display -o picture").code, 0);
    const std::filesystem::path png = only_file(folder() / "picture", ".png");
    std::filesystem::create_directories(folder() / "golden/a b");
    std::filesystem::create_directories(folder() / "new/a b");
    for (const char* name : {"-x.png", "BIG.PNG", "a b/it's \"<&>\".png"})
        for (const char* in : {"golden", "new"}) std::filesystem::copy(png, folder() / in / name);
    std::ofstream(folder() / "golden/.gitattributes") << "hidden";
    const Finished same = guard("--images display --limit .02");
    EXPECT_EQ(same.code, 0) << same.out << same.err;
    EXPECT_EQ(std::ranges::count(same.out, '\n'), 5);
    std::ofstream(folder() / "new/a b/it's \"<&>\".png") << "cut";
    EXPECT_EQ(guard().code, 2);
    EXPECT_THAT(file_text(folder() / "out/a b/it's \"<&>\".png.xml"), HasSubstr("name=\"a b/it's &quot;&lt;&amp;>&quot;.png\""));
    std::ofstream(folder() / "golden/notes.jpg") << "no image that is known";
    EXPECT_THAT(guard().out, HasSubstr("notes.jpg                                is no capture, .exr or .png\n"));
}

TEST_F(Guard, SaysWhereAFolderIsMissingOrCannotBeWritten) {
    std::ofstream(folder() / "out") << "a file";
    EXPECT_THAT(guard(), testing::Field("code", &Finished::code, 2));
    EXPECT_THAT(guard().err, HasSubstr("out cannot be written\n"));
    std::filesystem::remove(folder() / "out");
    std::filesystem::remove_all(folder() / "new");
    EXPECT_THAT(guard(), testing::Field("code", &Finished::code, 2));
    EXPECT_THAT(guard().err, HasSubstr("new is no folder\n"));
}

TEST_F(Guard, KeepsThePageOfAWarning) {
    std::filesystem::copy(folder() / "golden/three_cards.strata", folder() / "new/three_panes.strata",
                          std::filesystem::copy_options::overwrite_existing);
    const Finished run = guard("--images display --limit 1 --warn-limit .02");
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("three_panes.strata                       passes with a warning; see "));
    EXPECT_TRUE(exists("out/three_panes.strata.html"));
}

}  // namespace
}  // namespace strata
