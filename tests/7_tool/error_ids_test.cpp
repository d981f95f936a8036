// Errors by their ids: with -v on standard error, with --json in the one document on standard output.
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/error_text.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using nlohmann::json;

/// A command that fails, and what is said of it.
struct Failing {
    std::string command;
    int code = 0;
    std::string id, values;
    std::string kind;
    json fields;
    std::string schema = "strata.error";  ///< of the document of --json
};

TEST(ErrorIds, AreSaidForEveryExitCodeInWordsAndInJson) {
    write_file(folder() / "sound.strata", sound_capture());
    ASSERT_EQ(strata("record additive_sparks -o sparks.strata --size 32x24").code, 0);
    const Failing all[] = {
        {"replay sparks.strata --strict --outputs color --use transparency/weighted",
         1,
         "replay.not_supported",
         "frame=0 technique=transparency/weighted feature=",
         "over_tolerance",
         {{"frame", 0}, {"technique", "transparency/weighted"}},
         "strata.replay.list"},
        {"info --halp",
         2,
         "options.unknown",
         "verb=\"strata info\" option=--halp",
         "usage",
         {{"verb", "strata info"}, {"option", "--halp"}, {"suggestion", "; did you mean --help?"}}},
        {"info sound.strata --frame 9", 2, "capture.no_frame", "frame=9 frames=4", "usage", {{"frame", 9}, {"frames", 4}}},
        {"replay sound.strata --tolerance -1",
         2,
         "options.out_of_range",
         "low=0 value=-1 option=--tolerance",
         "usage",
         {{"low", 0}, {"value", "-1"}, {"option", "--tolerance"}}},
        {"validate nowhere.strata",
         3,
         "file.cannot_open",
         "file=nowhere.strata",
         "bad_input",
         {{"file", "nowhere.strata"}},
         "strata.validate"},
        {"info nowhere.strata", 3, "file.cannot_open", "file=nowhere.strata", "bad_input", {{"file", "nowhere.strata"}}},
        {"info sound.strata --memory-budget 300",
         4,
         "memory.budget",
         "budget=\"300 bytes\"",
         "device_lacks",
         {{"budget", "300 bytes"}}},
        {"replay sound.strata --frames 0 --expect --outputs color",
         6,
         "replay.no_expectation",
         "frame=0 command=",
         "expectation_missing",
         {{"frame", 0}},
         "strata.replay.list"},
    };
    for (const Failing& each : all) {
        SCOPED_TRACE(each.command);
        const Finished said = strata("-v " + each.command), printed = strata(each.command + " --json");
        EXPECT_THAT(said, Refuses(each.code, each.id, each.values));
        EXPECT_EQ(printed.code, each.code);
        json document = json::parse(printed.out);
        EXPECT_EQ(document["schema"], each.schema);
        const json& error = document["error"];
        EXPECT_EQ(error["id"], each.id);
        EXPECT_EQ(error["kind"], each.kind);
        EXPECT_EQ(error["exit_code"], each.code);
        EXPECT_THAT(printed.err, testing::HasSubstr(error["sentence"].get<std::string>()));
        for (const auto& [name, value] : each.fields.items()) EXPECT_EQ(error["fields"][name], value) << name;
    }
}

TEST(ErrorIds, AreNotPrintedWhereResultsStandAlready) {
    write_file(folder() / "sound.strata", sound_capture());
    const Finished differs = strata("-v diff sound.strata --frames 0 --use weighted --json");
    EXPECT_THAT(differs, Refuses(1, "diff.over_tolerance", "frame=0 pass=transparency image="));
    EXPECT_EQ(json::parse(differs.out)["schema"], "strata.diff");
}

/// A value of several words is in quotes, so that the line can be taken apart; JSON has no NaN.
TEST(ErrorIds, HaveValuesThatStayOneLineAndJson) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    const Error error = within(fail(Fault::usage, "some.case", "{number} of {limit} in {name} ({reason}{advice})", none, 3u,
                                    "two\n\"words\"", "none", ""),
                               "frame {frame}", -2);
    EXPECT_EQ(id_text(error), R"(some.case: number=nan limit=3 name="two\n\"words\"" reason=none advice="" frame=-2)");
    const nlohmann::ordered_json fields = json_of(error)["fields"];
    EXPECT_EQ(fields.dump(), R"({"number":"nan","limit":3,"name":"two\n\"words\"","reason":"none","advice":"","frame":-2})");
    EXPECT_EQ(id_text(fail(Fault::usage, "some.case", "nothing")), "some.case");
}

}  // namespace
}  // namespace strata
