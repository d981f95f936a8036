// Every command of the README files at the top runs, in order, with the captures that commands before it made. Small: what is
// shown there at 320 x 180 or more runs at 64 x 36. tests/1_consumer runs those of "Record your own renderer".
#include <algorithm>
#include <fstream>
#include <regex>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"
#include "tests/support/gltf_text.h"
#include "tests/support/readme_blocks.h"

namespace strata {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path source = STRATA_SOURCE_DIR;

std::vector<ReadmeCommand> commands_in(const fs::path& readme) {
    std::vector<ReadmeCommand> all;
    for (const ReadmeBlock& block : blocks_of(file_text(readme)))
        for (ReadmeCommand& command : commands_of(block, {"strata"})) all.push_back(std::move(command));
    return all;
}

/// The file or folder that a command writes, a file perhaps without extension; empty for commands that only print.
std::string output_of(const std::string& command) {
    static const std::regex option(" (?:-o|--tiles) ([^ ]+)"), capture("^strata (?:record|import) ([a-z0-9_]+)");
    std::smatch match;
    if (std::regex_search(command, match, option)) return match[1];
    return std::regex_search(command, match, capture) ? std::string(match[1]) + ".strata" : "";
}

bool is_there(const std::string& output) {
    for (const char* extension : {"", ".svg"})
        if (const fs::path path = folder() / (output + extension); fs::exists(path))
            return fs::is_directory(path) ? !fs::is_empty(path) : fs::file_size(path) > 0;
    return false;
}

/// The same command on a small frame, and timing once what it times.
std::string small(std::string command) {
    static const std::regex makes("^strata (record [a-z_]+|import [a-z_]+\\.glb)"), times("^strata (report|bench) [^-]"),
        size("--size [0-9]+x[0-9]+"), at("--at 160,90"), repeats(" --repeats [0-9]+");
    if (std::regex_search(command, makes))
        command =
            std::regex_search(command, size) ? std::regex_replace(command, size, "--size 64x36") : command + " --size 64x36";
    if (std::regex_search(command, times)) command = std::regex_replace(command, repeats, "") + " --repeats 1";
    if (command.starts_with("strata bench voxel --")) command += " --size 64x36";  // without a capture: of scenarios
    return std::regex_replace(command, at, "--at 32,18");
}

/// Takes more than some seconds of CPU at any extent.
bool is_slow(const std::string& command) {
    static const std::regex slow("^strata (report|bench|probe|inspect [a-z_.]+ --script|spectra .*measured|isa .*--tiles)");
    return std::regex_search(command, slow);
}

/// Opens a window; tests/7_inspector_window does that.
bool needs_a_display(const std::string& command) {
    return command.starts_with("strata inspect") && command.find("--script") == std::string::npos;
}

/// 0, or the code after "exits with" in what a README says beside the command.
int code_of_line(const fs::path& readme, std::size_t line) {
    std::ifstream file(readme);
    std::string text;
    for (std::size_t i = 0; i < line; ++i) std::getline(file, text);
    const std::size_t at = text.find("exits with ");
    return at == std::string::npos ? 0 : std::stoi(text.substr(at + 11));
}

/// Files of other programs that a reader has: a scene, one that moves, a closed room, a deep image.
void write_inputs() {
    const std::string triangle_scene = Gltf().with_triangle().text(showing(triangle));
    for (const char* name : {"scene.glb", "city.glb"}) std::ofstream(folder() / name) << triangle_scene;
    Gltf moving;
    moving.with_triangle();
    moving.floats({0, 2}, "SCALAR", 1);
    moving.floats({0, 0, 0, 4, 0, 0}, "VEC3", 3);
    std::ofstream(folder() / "robot.glb") << moving.text(showing(
        triangle,
        R"(,"animations":[{"samplers":[{"input":1,"output":2}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])"));
    ASSERT_EQ(strata("record lights_room -o made.strata --size 64x36").code, 0);
    ASSERT_EQ(strata("export made.strata --gltf -o room.glb").code, 0);
    ASSERT_EQ(strata("record three_panes -o made.strata").code, 0);
    ASSERT_EQ(strata("export made.strata --deep -o explosion.exr").code, 0);
    fs::remove(folder() / "made.strata");
    fs::create_directories(folder() / "ui");
    fs::create_directory_symlink(source / "ui/pictures", folder() / "ui/pictures");
}

/// Runs the commands of a README but those that are left out. Returns how many.
std::size_t run_all(const fs::path& readme, bool (*left_out)(const std::string&)) {
    std::size_t ran = 0;
    for (const ReadmeCommand& shown : commands_in(readme)) {
        if (needs_a_display(shown.text) || left_out(shown.text)) continue;
        const std::string command = small(shown.text), output = output_of(command);
        if (fs::is_regular_file(folder() / output)) fs::remove(folder() / output);
        const Finished run = strata(command.substr(std::string("strata ").size()));
        EXPECT_EQ(run.code, code_of_line(readme, shown.line)) << readme.string() << ":" << shown.line << ": " << command << "\n"
                                                              << run.err;
        EXPECT_TRUE(output.empty() || is_there(output))
            << readme.string() << ":" << shown.line << ": no " << output << " of " << command;
        ++ran;
    }
    return ran;
}

TEST(ReadmeCommands, RunInOrderOnSmallFrames) {  // 25 s of CPU: most verbs once, as a reader types them
    write_inputs();
    EXPECT_GT(run_all(source / "README.md", is_slow), 34u);
}

TEST(ExhaustiveReadmeCommands, RunInOrderOnSmallFrames) {
    write_inputs();
    EXPECT_GT(run_all(source / "README.md", [](const std::string&) { return false; }), 50u);
}

/// Costs are those of one version of Mesa, as the pictures are.
TEST(ExhaustiveReadmeCommands, PrintWhatTheReadmeShows) {
    const std::string here = strata("--list-gpus").out, there = file_text(source / "ui/pictures/made_on.txt");
    if (here != there) GTEST_SKIP() << "it was printed on " << there << "and this is " << here;
    std::size_t lines = 0;
    for (const ReadmeBlock& block : blocks_of(file_text(source / "README.md"))) {
        if (!block.lines.front().starts_with("$ ")) continue;
        for (const ReadmeCommand& shown : commands_of(block, {"strata"})) {
            if (shown.text.starts_with("strata report")) continue;  // times
            const Finished run = strata(shown.text.substr(std::string("strata ").size()));
            EXPECT_EQ(run.code, 0) << shown.text << "\n" << run.err;
            for (const std::string& line : shown.output) {
                if (line.find_first_not_of(" .") == std::string::npos) continue;  // "..."
                EXPECT_THAT(run.out, HasSubstr(line)) << "README.md:" << shown.line << ": " << shown.text;
                ++lines;
            }
        }
    }
    EXPECT_GT(lines, 10u);
}

/// Asks the device what it compiled, which lavapipe does not tell.
bool asks_the_device(const std::string& command) {
    return command.starts_with("strata isa ") && command.find("--gpu-model") == std::string::npos && command.ends_with(".strata");
}

/// What made the picture of a technique's README, among others.
TEST(ExhaustiveReadmeCommands, OfEveryOtherFolderRunToo) {
    std::size_t ran = 0;
    for (const char* top : {"capture_format", "passes", "replay", "ui", "captures", "tests", "docs"})
        for (const auto& entry : fs::recursive_directory_iterator(source / top))
            if (entry.path().filename() == "README.md") ran += run_all(entry.path(), asks_the_device);
    EXPECT_GT(ran, 50u);
}

TEST(ReadmeCommands, EveryLineOfTheReadmesBlocksIsACommandOfAProgramThatATestRuns) {
    for (const ReadmeBlock& block : blocks_of(file_text(source / "README.md"))) {
        if (!block.language.empty() || block.lines.front().starts_with("$ ")) continue;
        for (std::size_t i = 0; i < block.lines.size(); ++i)
            EXPECT_THAT(block.lines[i], testing::ContainsRegex("^(strata|build/strata|cmake|out/engine/engine|\\./build\\.sh) ?"))
                << "README.md:" << block.line + i;
    }
}

TEST(ReadmeCommands, OfItsPicturesAreThoseOfTheScriptsThatMakeThem) {
    std::string scripts;
    for (const auto& entry : fs::directory_iterator(source / "ui/pictures"))
        if (entry.path().extension() == ".script") scripts += file_text(entry.path());
    std::size_t pictures = 0;
    for (const ReadmeBlock& block : blocks_of(file_text(source / "README.md"))) {
        if (block.section != "The inspector") continue;
        for (const std::string& line : block.lines) {
            EXPECT_THAT(scripts, HasSubstr("# " + line + "\n"));
            ++pictures;
        }
    }
    EXPECT_EQ(pictures, 6u);
}

}  // namespace
}  // namespace strata
