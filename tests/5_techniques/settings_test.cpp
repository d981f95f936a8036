// A parameter is one row: option, range, help and the place of its value in the struct that C++ and GLSL share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/technique.h"

namespace strata {
namespace {

struct Block {
    float falloff;
    std::int32_t shift;
    std::uint32_t quality;
};

constexpr std::string_view qualities[] = {"low", "medium", "high"};

const std::vector<Param>& params() {
    static const std::vector<Param> rows = {
        param<&Block::falloff>({.name = "falloff", .low = 0.1, .high = 500, .fallback = 20, .help = "metres"}),
        param<&Block::shift>({.name = "shift", .low = -4, .high = 4, .fallback = -2, .help = "texels"}),
        param<&Block::quality>({.name = "quality", .fallback = 1, .help = "of what", .choices = qualities}),
    };
    return rows;
}

TEST(Settings, BeginWithTheFallbacksAndFillTheStruct) {
    const Block block = Settings(params()).as<Block>();
    EXPECT_EQ(block.falloff, 20.0f);
    EXPECT_EQ(block.shift, -2);
    EXPECT_EQ(block.quality, 1u);
}

TEST(Settings, AreWrittenAsTheCommandLineAcceptsThem) {
    EXPECT_THAT(Settings(params()).lines(), testing::ElementsAre("falloff=20", "shift=-2", "quality=medium"));
}

TEST(Settings, AcceptAChoiceByNameOrNumber) {
    Settings settings(params());
    EXPECT_TRUE(settings.set("quality", "high"));
    EXPECT_EQ(settings.get("quality"), 2);
    EXPECT_TRUE(settings.set("quality", "0"));
    EXPECT_EQ(settings.lines().back(), "quality=low");
}

TEST(Settings, RefuseWhatIsOutOfRangeWithTheRange) {
    Settings settings(params());
    EXPECT_EQ(settings.set("falloff", "0").error().sentence, "falloff is from 0.1 to 500, not 0");
    EXPECT_EQ(settings.set("shift", "1.5").error().sentence, "shift is a whole number from -4 to 4, not 1.5");
    EXPECT_EQ(settings.set("falloff", "nan").error().sentence, "falloff is from 0.1 to 500, not nan");
    EXPECT_EQ(settings.set("falloff", "2m").error().sentence, "falloff is a number from 0.1 to 500, not '2m'");
    EXPECT_EQ(settings.get("falloff"), 20);
}

TEST(Settings, RefuseWhatIsUnknownWithTheNearestName) {
    Settings settings(params());
    EXPECT_EQ(settings.set("fallof", 1.0).error().sentence, "no parameter fallof; did you mean falloff?");
    EXPECT_EQ(settings.set("quality", "hihg").error().sentence,
              "quality is one of low, medium, high, not hihg; did you mean high?");
}

}  // namespace
}  // namespace strata
