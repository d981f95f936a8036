// What was released stays readable. `flatc --conform` accepts a dropped field, so frozen captures are opened as well.
#include <sys/wait.h>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "capture_format/codec/upgrade.h"
#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/frame_fields.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

const fs::path source = STRATA_SOURCE_DIR;
const fs::path schema = source / "capture_format/schema/capture.fbs";
const fs::path released_captures = source / "captures/released";

std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

/// Exit code of `flatc --conform released schema`.
int conform(const fs::path& released, const fs::path& current) {
    const std::string command = fmt::format("flatc --conform '{}' '{}' > /dev/null 2>&1", released.string(), current.string());
    return WEXITSTATUS(std::system(command.c_str()));
}

TEST(Evolution, TheSchemaConformsToEveryReleasedOne) {
    const auto released = files_in(source / "capture_format/schema/released");
    ASSERT_GE(released.size(), 1u);
    ASSERT_LE(released.size(), format_version) << "one frozen schema per released version";
    for (const fs::path& frozen : released) EXPECT_EQ(conform(frozen, schema), 0) << frozen;
}

TEST(Evolution, AChangedTypeIsNoticed) {
    const TemporaryFile changed("changed.fbs");
    std::string text = file_text(schema);
    text.replace(text.find("mips:uint"), 9, "mips:long");
    write_file(changed.path(), bytes_of(text));
    EXPECT_NE(conform(source / "capture_format/schema/released/capture_1.fbs", changed.path()), 0);
}

TEST(Evolution, EveryFieldHasAnId) {
    std::ifstream lines(schema);
    bool in_table = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("table ")) in_table = true;
        if (line.starts_with("}")) in_table = false;
        const bool declares = in_table && line.starts_with(" ") && line.find(':') < line.find("//");
        if (declares) {
            EXPECT_THAT(line, HasSubstr("(id: "));
        }
    }
}

TEST(Evolution, EveryFrozenCaptureOpens) {
    ASSERT_EQ(files_in(released_captures).size(), files_in(source / "capture_format/schema/released").size())
        << "one folder of frozen captures per released version";
    for (const fs::path& version : files_in(released_captures)) {
        for (const fs::path& file : files_in(version)) {
            const auto capture = Capture::open(file);
            ASSERT_TRUE(capture) << capture.error().sentence;
            EXPECT_EQ(std::to_string(capture->summary().format_version), version.filename());
            for (std::size_t i = 0; i < capture->frame_count(); ++i) EXPECT_TRUE(capture->frame(i)) << file << " frame " << i;
        }
    }
}

TEST(Evolution, TheFirstFrozenCaptureHoldsWhatWasRecorded) {
    const auto capture = Capture::open(released_captures / "1/something_of_everything.strata");
    ASSERT_TRUE(capture) << capture.error().sentence;
    EXPECT_EQ(capture->summary().notes, "one frame with something of everything");
    Frame recorded = rich_frame();
    // Fields that are younger than the capture.
    for (Light& light : recorded.lights) {
        light.shadow.soft = false;
        light.window = RangeWindow::squared_quartic;
    }
    for (Texture& texture : recorded.textures) {
        texture.magnify = texture.minify = TexelFilter::linear;
        texture.between_mips = MipFilter::linear;
    }
    recorded.fog.path = FogPath::view_depth;
    EXPECT_EQ(bits_of(*capture->frame(0)), bits_of(recorded));
}

/// Wrote the frozen capture; a released file is never written again. Run with --gtest_also_run_disabled_tests for a new version.
TEST(Evolution, DISABLED_FreezeACaptureOfThisVersion) {
    const fs::path path = released_captures / std::to_string(format_version) / "something_of_everything.strata";
    ASSERT_FALSE(fs::exists(path)) << "it is frozen";
    fs::create_directories(path.parent_path());
    auto recorder = Recorder::create(path, "one frame with something of everything");
    ASSERT_TRUE(recorder && recorder->record(rich_frame()) && recorder->finish());
}

TEST(Evolution, ThereIsOneStepBetweenTwoVersions) { EXPECT_EQ(upgrade_steps().size() + 1, format_version); }

TEST(Evolution, AFrameOfVersionNGoesThroughEveryStepFromNOn) {
    const UpgradeStep steps[] = {{"time is doubled",
                                  [](Frame frame) {
                                      frame.time *= 2;
                                      return frame;
                                  }},
                                 {"time is shifted", [](Frame frame) {
                                      frame.time += 1;
                                      return frame;
                                  }}};
    Frame frame;
    frame.time = 5;
    EXPECT_EQ(upgrade(frame, 1, steps).time, 11);
    EXPECT_EQ(upgrade(frame, 2, steps).time, 6);
    EXPECT_EQ(upgrade(frame, 3, steps).time, 5);
}

TEST(Evolution, ANewerFrameIsRefusedWithASentence) {
    EXPECT_TRUE(check_format_version(format_version));
    EXPECT_THAT(check_format_version(format_version + 1),
                FailsWith("capture.frame.version", Field("version", format_version + 1)));
    EXPECT_FALSE(check_format_version(0));
}

}  // namespace
}  // namespace strata
