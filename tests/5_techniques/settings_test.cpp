// A parameter is one row: option, range, help and the place of its value in the struct that C++ and GLSL share.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/result.h"
#include "passes/settings.h"
#include "tests/support/errors.h"

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
        param<&Block::falloff>({.name = "falloff", .low = 0.1, .high = 500, .fallback = 20, .help = "meters"}),
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
    const auto falloff = [](std::string id, auto value) {
        return FailsWith(id, Field("setting", "falloff"), Field("low", .1), Field("high", 500), Field("value", value));
    };
    EXPECT_THAT(settings.set("falloff", "0"), falloff("settings.out_of_range", 0));
    EXPECT_THAT(settings.set("falloff", "nan"), falloff("settings.out_of_range", "nan"));
    EXPECT_THAT(settings.set("falloff", "2m"), falloff("settings.not_a_number", "2m"));
    EXPECT_THAT(settings.set("shift", "1.5"), FailsWith("settings.not_whole", Field("setting", "shift"), Field("low", -4),
                                                        Field("high", 4), Field("value", 1.5)));
    EXPECT_THAT(settings.set("shift", 5.0), FailsWith("settings.out_of_range", Field("setting", "shift"), Field("value", 5)));
    EXPECT_EQ(settings.get("falloff"), 20);
}

TEST(Settings, RefuseWhatIsUnknownWithTheNearestName) {
    Settings settings(params());
    using testing::HasSubstr;
    EXPECT_THAT(settings.set("fallof", 1.0),
                FailsWith("settings.unknown", Field("setting", "fallof"), Field("suggestion", HasSubstr("falloff"))));
    EXPECT_THAT(settings.set("quality", "hihg"), FailsWith("settings.not_a_choice", Field("choices", "low, medium, high"),
                                                           Field("value", "hihg"), Field("suggestion", HasSubstr("high"))));
    EXPECT_THAT(settings.set("quality", "3"), FailsWith("settings.not_a_choice", Field("setting", "quality"), Field("value", 3)));
}

}  // namespace
}  // namespace strata
