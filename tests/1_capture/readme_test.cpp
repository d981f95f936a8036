// The README's way to record compiles and works: its code is here, word for word.
#include <sstream>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "capture_format/recorder.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/1_capture/temporary_file.h"

namespace strata {
namespace {

constexpr std::uint64_t frames = 3;
const View view = triangle_frame().view;
const Mesh ship = triangle_frame().meshes[0];
const Material red = triangle_frame().materials[0];
const Light lamp = {.name = "lamp"};

double time_of(std::uint64_t frame) { return static_cast<double>(frame) / 60; }
Material pulsing(std::uint64_t frame) { return {.name = "red", .roughness = 1 / static_cast<float>(frame + 1)}; }
glm::dmat4 placed(std::uint64_t frame) {
    glm::dmat4 to_world(1);
    to_world[3].x = static_cast<double>(frame + 1);
    return to_world;
}

Result<void> record_as_the_readme_says() {
    auto recorder = strata::Recorder::create("frames.strata");
    if (!recorder) return recorder.error();
    const std::uint32_t mesh = recorder->add_mesh(ship);  // resources stay until they are updated
    const std::uint32_t paint = recorder->add_material(red);
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
        recorder->begin_frame(view, time_of(frame), frame, 0);
        recorder->update_material(paint, pulsing(frame));
        recorder->draw({.mesh = mesh, .material = paint, .to_world = placed(frame), .previous_to_world = placed(frame - 1)});
        recorder->light(lamp);
        if (const auto done = recorder->end_frame(); !done) return done;  // hands over; a thread of its own writes
    }
    return recorder->finish();
}

TEST(Readme, ItsCodeIsTheCodeOfThisTest) {
    const std::filesystem::path source = STRATA_SOURCE_DIR;
    const std::string readme = file_text(source / "README.md"), here = file_text(source / "tests/1_capture/readme_test.cpp");
    const std::size_t begin = readme.find("```cpp\n", readme.find("## Record your own renderer")) + 7;
    std::istringstream lines(readme.substr(begin, readme.find("```\n", begin) - begin));
    std::string indented;
    for (std::string line; std::getline(lines, line);) indented += "    " + line + "\n";
    EXPECT_GT(indented.size(), 500u);
    EXPECT_NE(here.find(indented), std::string::npos) << indented;
}

TEST(Readme, ItsCodeRecords) {
    const auto before = std::filesystem::current_path();
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "strata.readme";
    std::filesystem::create_directories(folder);
    std::filesystem::current_path(folder);
    const auto done = record_as_the_readme_says();
    const auto capture = Capture::open("frames.strata");
    std::filesystem::current_path(before);
    ASSERT_TRUE(done && capture);
    ASSERT_EQ(capture->frame_count(), frames);
    EXPECT_EQ(capture->frame(2)->materials[0].roughness, 1 / 3.f);
    EXPECT_EQ(capture->frame(2)->draws[0].previous_to_world[3].x, 2);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace strata
