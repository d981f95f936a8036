// Tables as files and on standard output: -o follows the file's ending, --csv and --json are of every verb that prints a table.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char *one_row_report = "report sound.strata --repeats 1 --techniques weighted",
                     *report_csv_head = "capture,technique,settings,";

void write_tabled_capture() { write_file(folder() / "sound.strata", sound_capture()); }

TEST(TableOutput, OfAnEndingThatIsNoFormatIsRefusedBeforeAnythingIsMeasured) {
    write_tabled_capture();
    for (const char* verb : {one_row_report, "report --hard-cases", "bench voxel", "bench device", "spectra sound.strata"})
        for (const std::string_view file : {"made.htm", "made.svg", "made.png", "made.JSON"}) {
            if (file == "made.svg" && verb == one_row_report) continue;  // its plot
            const Finished refused = strata(fmt::format("{} -o {} -v", verb, file));
            EXPECT_EQ(refused.code, 2) << verb;
            EXPECT_THAT(refused.err, testing::AllOf(HasSubstr("output.unknown_ending"), HasSubstr(".json, .csv, .md or .txt")))
                << verb;
            EXPECT_FALSE(std::filesystem::exists(folder() / file)) << verb;
        }
    for (const char* contradiction : {"--json -o made.csv", "--csv -o made.md", "--csv -o made.json"}) {
        const Finished refused = strata(fmt::format("{} {} -v", one_row_report, contradiction));
        EXPECT_EQ(refused.code, 2) << contradiction;
        EXPECT_THAT(refused.err, HasSubstr("output.ending_contradicts")) << contradiction;
    }
}

TEST(TableOutput, FollowsTheEndingOfTheFile) {
    write_tabled_capture();
    for (const char* ending : {"json", "csv", "md", "txt"}) {
        const Finished made =
            strata_after("export SOURCE_DATE_EPOCH=86400", fmt::format("{} -o made.{}", one_row_report, ending));
        ASSERT_EQ(made.code, 0) << made.err;
        EXPECT_EQ(made.out, "") << ending;
    }
    const auto text_of = [](const char* ending) { return file_text(folder() / fmt::format("made.{}", ending)); };
    const json made = json::parse(text_of("json"));
    EXPECT_EQ(made["date"], "1970-01-02T00:00:00Z");
    EXPECT_EQ(made["capture_name"], "sound.strata");
    EXPECT_EQ(made["capture_id"], made["capture"]);
    EXPECT_THAT(text_of("csv"), StartsWith(report_csv_head));
    EXPECT_THAT(text_of("md"),
                testing::AllOf(StartsWith("```\ntransparency of sound.strata"), HasSubstr("\n|  | transparency and settings |")));
    EXPECT_THAT(text_of("txt"), StartsWith("transparency of sound.strata"));
}

TEST(TableOutput, WithoutAnEndingIsWhatTheOptionsAskFor) {
    write_tabled_capture();
    EXPECT_THAT(strata(fmt::format("{} --csv -o /dev/stdout", one_row_report)).out, StartsWith(report_csv_head));
    EXPECT_THAT(strata(fmt::format("{} -o /dev/stdout", one_row_report)).out, StartsWith("transparency of sound.strata"));
}

TEST(TableOutput, AsCommaSeparatedValuesAndAsJsonIsOfEveryVerbThatPrintsATable) {
    write_tabled_capture();
    const std::pair<const char*, const char*> verbs[] = {
        {one_row_report, report_csv_head},
        {"bench voxel sound.strata --repeats 1 --only two", "technique,name,scene,frame,ratio,ratio_mad,published,"},
        {"bench device sound.strata --repeats 1", "scope,name,ms,ms_mad,declared_bytes,"},
        {"isa", "name,units,unit,"},
        {"probe sound.strata --at 8,4 --techniques sorted_lists --depths 16 -o probed",
         "table,number,depth,submission,alpha,t_r,"},
        {"diff sound.strata --frames 0 --use transparency/weighted --limit 1000", "frame,pass,image,verdict,"},
        {"replay sound.strata --frames 0 --time 1 --no-expect", "frame,index,scope,name,gpu_ms,gpu_ms_mad"}};
    for (const auto& [verb, head] : verbs) {
        const Finished csv = strata(fmt::format("{} --csv", verb));
        EXPECT_EQ(csv.code, 0) << verb << csv.err;
        EXPECT_THAT(csv.out, StartsWith(head)) << verb;
        const json made = json::parse(strata(fmt::format("{} --json", verb)).out);
        for (const char* key : {"schema", "schema_version", "date", "program"})
            EXPECT_TRUE(made.contains(key)) << verb << " " << key;
        EXPECT_THAT(made["schema"].get<std::string>(), HasSubstr("strata.")) << verb;
    }
}

}  // namespace
}  // namespace strata
