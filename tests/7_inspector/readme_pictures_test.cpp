// The pictures of the README are what the scripts beside them make. A script's head has the commands.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/container/whole_file.h"
#include "replay/images/image_io.h"
#include "tests/7_tool/process.h"
#include "tests/support/accept.h"
#include "tests/support/file_text.h"
#include "tests/support/session.h"

namespace strata::ui {
namespace {

const std::filesystem::path kept = STRATA_SOURCE_DIR "/ui/pictures";

/// Runs the commands that a script's head tells people. Without what it measures, which takes minutes, unless all is asked for.
void make(const std::string& name, bool measures = true) {
    std::istringstream script(file_text(kept / (name + ".script")));
    std::ofstream played(folder() / (name + ".script"));
    std::vector<std::string> commands;
    for (std::string line; std::getline(script, line);) {
        if (line.starts_with("# strata ")) commands.push_back(line.substr(std::string_view("# strata ").size()));
        if (measures || line.find("/measure") == std::string::npos) played << line << '\n';
    }
    played.close();
    ASSERT_EQ(commands.size(), 2u) << name;
    for (std::string& command : commands) {
        const std::string_view where = "ui/pictures/";
        if (const auto at = command.find(where); at != std::string::npos) command.erase(at, where.size());
        const Finished made = strata(command);
        ASSERT_EQ(made.code, 0) << command << "\n" << made.err;
    }
}

/// The driver's name stands in the picture.
class ReadmePictures : public testing::Test {
protected:
    void SetUp() override {
        const std::string here = strata("--list-gpus").out, there = file_text(kept / "made_on.txt");
        if (accepting()) must(write_whole_file(kept / "made_on.txt", here));
        else if (here != there) GTEST_SKIP() << "they were made on " << there << "and this is " << here;
    }

    /// Keeps what was made, where that was asked for.
    static void accept(const std::string& name) {
        if (!accepting()) return;
        std::filesystem::copy_file(folder() / (name + ".png"), kept / (name + ".png"),
                                   std::filesystem::copy_options::overwrite_existing);
        ADD_FAILURE() << name << " is kept from now on";
    }
};

struct Rectangle {
    std::uint32_t left = 0, top = 0, right = 0, bottom = 0;
};

/// Whether two pictures are the same in a rectangle: a driver's last bits differ between makers of processors, which moves a few
/// texels by one step.
bool is_same_in(const Rectangle& part, const HostImage& a, const HostImage& b) {
    constexpr double step = 1.01 / 255;
    std::size_t moved = 0;
    for (std::uint32_t y = part.top; y < part.bottom; ++y)
        for (std::uint32_t x = part.left; x < part.right; ++x) {
            const glm::dvec4 difference = glm::abs(texel(a, x, y) - texel(b, x, y));
            if (glm::any(glm::greaterThan(difference, glm::dvec4(step)))) return false;
            moved += difference != glm::dvec4(0);
        }
    return moved <= 4 + std::size_t{part.right - part.left} * (part.bottom - part.top) / 1000;
}

void expect_same(const std::string& name) {
    const HostImage made = must(read_png(folder() / (name + ".png"))), expected = must(read_png(kept / (name + ".png")));
    const Extent& extent = made.shape.extent;
    EXPECT_TRUE(made.shape == expected.shape && is_same_in({0, 0, extent.width, extent.height}, made, expected))
        << name << ".png is another; what was made lies in " << folder() << "; keep it by " << command_that_accepts();
}

TEST_F(ReadmePictures, AProbeIsWhatItsScriptMakes) {
    make("probe");
    accept("probe");
    expect_same("probe");
}

TEST_F(ReadmePictures, AComparisonIsWhatItsScriptMakes) {
    make("compare");
    accept("compare");
    expect_same("compare");
}

Rectangle rectangle_of(const nlohmann::json& widget, const Extent& extent) {
    const auto edge = [&](const char* corner, std::size_t axis, std::uint32_t most) {
        return static_cast<std::uint32_t>(std::clamp(widget[corner][axis].get<double>(), 0.0, static_cast<double>(most)));
    };
    return {edge("from", 0, extent.width), edge("from", 1, extent.height), edge("to", 0, extent.width),
            edge("to", 1, extent.height)};
}

TEST_F(ReadmePictures, AroundAReportIsWhatItsScriptMakes) {
    make("cost", accepting());
    accept("cost");
    const HostImage made = must(read_png(folder() / "cost.png")), expected = must(read_png(kept / "cost.png"));
    ASSERT_EQ(made.shape, expected.shape);
    const auto tree = nlohmann::json::parse(file_text(folder() / "cost.json"));
    std::size_t regions = 0;
    for (const auto& widget : tree["widgets"]) {
        const std::string path = widget["path"];
        if (path.starts_with("Accuracy and cost/") || !widget["visible"].get<bool>()) continue;
        EXPECT_TRUE(is_same_in(rectangle_of(widget, made.shape.extent), made, expected))
            << path << "; keep it by " << command_that_accepts();
        ++regions;
    }
    EXPECT_GT(regions, 40u);
}

}  // namespace
}  // namespace strata::ui
