// strata report --needs: what frames make and how much of it is read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include <nlohmann/json.hpp>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::ContainsRegex;
using testing::HasSubstr;

std::string scenario(const std::string& name) {
    const std::string file = name + ".strata";
    EXPECT_EQ(strata("record " + name + " --size 48x27 -o " + file).code, 0);
    return file;
}

const json& row(const json& rows, const std::string& key, const std::string& value) {
    return *std::ranges::find_if(rows, [&](const json& row) { return row[key] == value; });
}

TEST(NeedsVerb, ShowsWhatAFrameMakesAndHowMuchOfItIsRead) {
    const std::string rooms = scenario("two_rooms");
    const Finished text = strata("report --needs --repeats 1 " + rooms);
    ASSERT_EQ(text.code, 0) << text.err;
    EXPECT_THAT(text.out, HasSubstr("48 x 27"));
    EXPECT_THAT(text.out, ContainsRegex("shadow_maps +shadows +6\\.000"));
    const Finished made = strata("report --needs --repeats 2 --json --eye pan=3.14 " + rooms);
    ASSERT_EQ(made.code, 0) << made.err;
    const json needs = json::parse(made.out);
    EXPECT_EQ(needs["schema"], "strata.needs");
    ASSERT_EQ(needs["frames"].size(), 1u);
    const json& frame = needs["frames"][0];
    EXPECT_EQ(frame["eye"], "pan=3.14");
    const json& display = row(frame["products"], "product", "display");
    EXPECT_EQ(display["made_bytes"], 48 * 27 * 8);
    EXPECT_EQ(display["read_bytes"], display["made_bytes"]);
    EXPECT_EQ(display["readers"], "the picture");
    EXPECT_EQ(display["ms"]["repeats"], 2);
    const json& grid = row(frame["products"], "product", "light grid 0");
    EXPECT_EQ(grid["left_out"], "nothing in view is in it");
    EXPECT_FALSE(grid.contains("made_bytes"));
    const json& indirect = row(frame["stages"], "stage", "indirect");
    EXPECT_GT(indirect["steps_left_out"], 0);
}

TEST(NeedsVerb, HasARowForEachFrameInFiles) {
    const std::string rain = scenario("roof_in_rain");
    const Finished shown = strata("report --needs --repeats 1 --csv " + rain + " " + rain);
    ASSERT_EQ(shown.code, 0) << shown.err;
    EXPECT_THAT(shown.out, testing::StartsWith("capture,frame,product,stage"));
    const std::string line = "\n\"roof_in_rain.strata\",\"0\",\"rain map\",\"rain\"";
    EXPECT_NE(shown.out.find(line), shown.out.npos);
    EXPECT_NE(shown.out.find(line), shown.out.rfind(line));
    ASSERT_EQ(strata("report --needs --repeats 1 -o needs.md " + rain).code, 0);
    EXPECT_THAT(file_text(folder() / "needs.md"), HasSubstr("| rain map |"));
}

TEST(NeedsVerb, RefusesWhatComparesTechniques) {
    const std::string rooms = scenario("two_rooms");
    EXPECT_THAT(strata("-v report --needs --stage shadows " + rooms), Refuses(2, "options.not_applicable", "option=--stage"));
    EXPECT_EQ(strata("report --needs --hard-cases").code, 2);
    EXPECT_EQ(strata("report --eye pan=1 " + rooms).code, 2);
    EXPECT_EQ(strata("report --needs -o page.html " + rooms).code, 2);
    EXPECT_THAT(strata("-v report --needs"), Refuses(2, "options.missing", "option=capture"));
}

}  // namespace
}  // namespace strata
