// What a capture says about how it was recorded: followed where it is understood, refused where it is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::HasSubstr, testing::Not;

const std::string replay = "replay x.strata --frames 0 --outputs color -o out ";

void record_with(const std::vector<StageChoice>& choices) { write_file(folder() / "x.strata", capture_recorded_with(choices)); }

TEST(RecordedChoices, ByAnyNameThatUseTakesAreFollowed) {
    for (const char* technique : {"transparency/moments", "moments", "mboit"}) {
        record_with({{"transparency", technique, {{"overestimation", .5}}}});
        EXPECT_THAT(strata(replay).out, HasSubstr("transparency   transparency/moments")) << technique;
        EXPECT_THAT(strata("info x.strata").out, HasSubstr("overestimation=0.5")) << technique;
        EXPECT_EQ(strata("validate x.strata").code, 0) << technique;
    }
}

TEST(RecordedChoices, ThatAreNotUnderstoodAreRefusedByEveryVerbThatReadsThem) {
    struct Case {
        std::vector<StageChoice> choices;
        std::string id, values;
    };
    const Case cases[] = {
        {{{"transparency", "transparency/foo", {}}}, "technique.unknown", "technique=transparency/foo"},
        {{{"transparency", "transparency/momets", {}}}, "technique.unknown", "did you mean transparency/moments"},
        {{{"transparency", "lighting/tiled", {}}}, "technique.of_another_stage", "stage=lighting wanted=transparency"},
        {{{"translucency", "moments", {}}}, "stage.unknown", "stage=translucency"},
        {{{"transparency", "weighted", {{"wieght", .5}}}}, "settings.unknown", "setting=wieght"},
        {{{"transparency", "weighted", {{"weight", std::string("w99")}}}}, "settings.not_a_choice", "value=w99"},
        {{{"transparency", "weighted", {}}, {"oit", "voxel", {}}}, "technique.two_of_a_stage", "technique=weighted other=voxel"},
    };
    for (const auto& [choices, id, values] : cases) {
        record_with(choices);
        for (const std::string& verb : {std::string("validate x.strata"), std::string("info x.strata"), replay,
                                        std::string("report x.strata --stage shadows --defaults --repeats 1")})
            EXPECT_THAT(strata("-v " + verb), Refuses(3, id, values)) << verb;
    }
}

TEST(RecordedChoices, ThatAreNotUnderstoodGiveWayToAnotherTechnique) {
    record_with({{"transparency", "transparency/foo", {}}});
    EXPECT_THAT(strata(replay + "--use weighted").out, HasSubstr("transparency   transparency/weighted"));
    EXPECT_THAT(strata(replay).err, HasSubstr("--use transparency/TECHNIQUE"));
}

TEST(RecordedChoices, CommandNoTerminal) {
    record_with({{"\x1b[2J", "\xff\x1b[2J", {}}});
    for (const std::string& verb : {std::string("validate x.strata"), std::string("info x.strata"), replay}) {
        const Finished refused = strata(verb);
        EXPECT_EQ(refused.code, 3) << verb;
        EXPECT_THAT(refused.err, Not(HasSubstr("\x1b"))) << verb;
    }
}

TEST(RecordedChoices, AreInTheJsonOfInfo) {
    record_with({{"transparency", "weighted", {{"weight", std::string("w7")}}}});
    const auto info = nlohmann::json::parse(strata("info x.strata --json").out, nullptr, false);
    EXPECT_EQ(info["frame"]["recorded_with"],
              nlohmann::json::parse(R"([{"stage": "transparency", "technique": "weighted", "settings": {"weight": "w7"}}])"));
}

}  // namespace
}  // namespace strata
