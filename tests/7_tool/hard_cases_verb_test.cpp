// strata report --hard-cases: a matrix that brings its own frames.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "captures/hard_cases.h"
#include "passes/registry.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(ExhaustiveHardCasesVerb, WritesWhatEveryTechniqueMakesOfEveryCase) {
    const Finished made = strata("report --hard-cases --json");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["schema"], "strata.hard_cases");
    ASSERT_EQ(report["rows"].size(), techniques_of(Stage::transparency).size());
    for (const json& row : report["rows"]) {
        EXPECT_EQ(row["settings"], "");
        ASSERT_EQ(row["cases"].size(), hard_cases().size());
        for (const json& one : row["cases"]) {
            const auto verdict = one["verdict"].get<std::string>();
            EXPECT_TRUE(verdict == "holds" || verdict == "documented failure" || verdict == "not applicable") << one;
        }
    }
}

TEST(HardCasesVerb, TakesNoCaptureAndAReportWithoutItDoes) {
    EXPECT_THAT(strata("-v report"), Refuses(2, "options.missing", "option=capture"));
    EXPECT_EQ(strata("report --hard-cases panes.strata").code, 2);
    EXPECT_EQ(strata("report --variants panes.strata").code, 2);  // a report has them anyway
}

}  // namespace
}  // namespace strata
