// Reports read back from their JSON: every key that is missing or wrong is a sentence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/report/pooled.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/6_measures/stored_reports.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::ElementsAre;

Report small_report() {
    Report report = report_with({{"transparency/k_buffer", .001, {3, 4, 5}, 12}, {"transparency/weighted", .02, {1, 1, 2}}});
    report.rows[1].settings = "weight=w9";
    Measurement other{.technique = "transparency/other", .has_other_truth = true}, unable{.technique = "transparency/unable"};
    other.accuracy.technique_errors = {{display_rmse, "of white", .5}};
    unable.accuracy.not_supported = "chromatic";
    report.rows.push_back(other);
    report.rows.push_back(unable);
    return report;
}

json small_document() { return json::parse(as_json(small_report())); }

Result<StoredReport> read(const json& document) { return parse_report(document.dump(), "folder/a.json"); }

TEST(StoredReport, HasWhatTheReportHas) {
    const Result<StoredReport> read_back = read(small_document());
    ASSERT_TRUE(read_back) << read_back.error().sentence;
    const StoredReport& report = *read_back;
    EXPECT_EQ(report.file, "folder/a.json");
    EXPECT_EQ(report.stage, "transparency");
    EXPECT_EQ(report.error_at, "stage");
    EXPECT_EQ(report.ranked_by.name, "display rmse");
    EXPECT_TRUE(report.ranked_by.is_of_white);
    EXPECT_EQ(report.driver, "its driver 1.2");
    EXPECT_EQ(report.capture_id, "09831f90");
    EXPECT_EQ(report.width, 64u);
    EXPECT_EQ(report.with_other_truth, 1u);
    EXPECT_EQ(report.not_supported, 1u);
    ASSERT_EQ(report.rows.size(), 2u);
    EXPECT_EQ(report.rows[0].error, .001);
    EXPECT_THAT(report.rows[0].repeats_ms, ElementsAre(3, 4, 5));
    EXPECT_THAT(report.rows[0].baseline_repeats_ms, ElementsAre(2, 2, 2));
    EXPECT_EQ(report.rows[0].bytes_per_pixel, 8);
    EXPECT_EQ(report.rows[0].counters.at("overflowed"), 12u);
    EXPECT_EQ(report.rows[1].settings, "weight=w9");
}

TEST(StoredReport, ThatIsNoReportOfOneCaptureIsRefused) {
    EXPECT_THAT(parse_report("", "a.json"), FailsWith("compare.not_json", Field("file", "a.json")));
    EXPECT_THAT(parse_report("{} {}", "a.json"), FailsWith("compare.not_json"));
    EXPECT_THAT(read(json::array()), FailsWith("compare.no_schema"));
    EXPECT_THAT(read({{"schema", 1}}), FailsWith("compare.no_schema"));
    EXPECT_THAT(read({{"schema", "strata.replay"}}), FailsWith("compare.other_schema", Field("schema", "strata.replay")));
    const std::vector<Report> two{small_report(), small_report()};
    EXPECT_THAT(parse_report(as_json(two, pooled(two)), "a.json"), FailsWith("compare.several_captures"));
    json newer = small_document();
    newer["schema_version"] = 2;
    EXPECT_THAT(read(newer), FailsWith("compare.newer_schema", Field("version", 2), Field("known", 1)));
}

TEST(StoredReport, WithoutTimesOrRankedRowsIsRefused) {
    Report stopped = small_report();
    stopped.stopped = "stopped after the errors of 2 rows";
    stopped.is_timed = false;
    EXPECT_THAT(parse_report(as_json(stopped), "a.json"), FailsWith("compare.not_timed"));
    Report empty = small_report();
    empty.rows.erase(empty.rows.begin(), empty.rows.begin() + 2);
    EXPECT_THAT(parse_report(as_json(empty), "a.json"), FailsWith("compare.no_ranked_row"));
    Report twice = small_report();
    twice.rows[1] = twice.rows[0];
    EXPECT_THAT(parse_report(as_json(twice), "a.json"), FailsWith("compare.row_twice", Field("row", "transparency/k_buffer")));
}

TEST(StoredReport, OfAnOlderProgramIsRefusedWithWhatItLacks) {
    for (const char* key : {"ranking_error", "repeats_ms"}) {
        json document = small_document();
        document["rows"][1].erase(key);
        EXPECT_THAT(read(document), FailsWith("compare.older_report", Field("key", key)));
    }
}

TEST(StoredReport, LeavesOutRowsWhoseErrorIsNoNumber) {
    Report report = small_report();
    report.rows[1].accuracy.technique_errors.front().value = NAN;
    const Result<StoredReport> read_back = parse_report(as_json(report), "a.json");
    ASSERT_TRUE(read_back) << read_back.error().sentence;
    EXPECT_EQ(read_back->rows.size(), 1u);
    EXPECT_EQ(read_back->without_finite_error, 1u);
}

/// Calls visit(pointer) for every value of a document.
template <typename Visit>
void for_every_value(const json& value, const json::json_pointer& at, const Visit& visit) {
    if (!at.empty()) visit(at);
    if (value.is_object())
        for (const auto& [key, inner] : value.items()) for_every_value(inner, at / key, visit);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) for_every_value(value[i], at / i, visit);
}

TEST(StoredReport, LacksEachKeyInTurn) {
    const json whole = small_document();
    std::vector<std::string> refused;
    for_every_value(whole, json::json_pointer(), [&](const json::json_pointer& at) {
        json document = whole;
        json& around = document[at.parent_pointer()];
        if (!around.is_object()) return;
        around.erase(at.back());
        const auto read_back = read(document);
        if (read_back) return;
        EXPECT_EQ(read_back.error().fault, Fault::bad_input) << at;
        if (read_back.error().id == "compare.missing_key") {
            EXPECT_THAT(read_back, HasField("key", at.to_string().substr(1)));
            refused.push_back(at.to_string().substr(1));
        }
    });
    EXPECT_THAT(refused, testing::UnorderedElementsAre(
                             "schema_version", "program", "device", "device/name", "device/driver", "device/driver_version",
                             "capture_id", "capture_name", "truth", "frame", "extent", "samples", "stage", "error_at",
                             "time_unit", "ranked_by", "rows", "rows/0/technique", "rows/0/settings",
                             "rows/0/baseline_repeats_ms", "rows/0/bytes_per_pixel", "rows/0/counters", "rows/1/technique",
                             "rows/1/settings", "rows/1/baseline_repeats_ms", "rows/1/bytes_per_pixel", "rows/1/counters",
                             "rows/2/technique", "rows/2/settings", "rows/3/technique", "rows/3/settings"));
}

TEST(StoredReport, WithAnyValueInThePlaceOfAnyOtherIsReadOrRefusedInASentence) {
    const json whole = small_document();
    std::size_t refused = 0;
    for (const json& wrong : {json(), json("x"), json(-1), json(.5), json(1e300), json(true), json::array(), json::object(),
                              json::array({"x"}), json::array({1, -1})})
        for_every_value(whole, json::json_pointer(), [&](const json::json_pointer& at) {
            json document = whole;
            document[at] = wrong;
            const auto read_back = read(document);
            if (read_back) return;
            ++refused;
            EXPECT_EQ(read_back.error().fault, Fault::bad_input) << at << wrong;
            EXPECT_FALSE(read_back.error().sentence.empty());
        });
    EXPECT_GT(refused, 300u);
    const auto with = [&](const char* at, const json& wrong) {
        json document = whole;
        document[json::json_pointer(at)] = wrong;
        return read(document);
    };
    EXPECT_THAT(with("/rows/0/ranking_error", -1), FailsWith("compare.wrong_value", Field("key", "rows/0/ranking_error")));
    EXPECT_THAT(with("/rows/0/repeats_ms", json::array()), FailsWith("compare.wrong_value", Field("key", "rows/0/repeats_ms")));
    EXPECT_THAT(with("/rows/0/repeats_ms/1", -1e-9), FailsWith("compare.wrong_value", Field("key", "rows/0/repeats_ms")));
    EXPECT_THAT(with("/rows/0/baseline_repeats_ms", json::array({1})), FailsWith("compare.wrong_value"));
    EXPECT_THAT(with("/rows/0/baseline_repeats_ms/0", 0), FailsWith("compare.wrong_value"));
    EXPECT_THAT(with("/rows/0/counters/overflowed", -1),
                FailsWith("compare.wrong_value", Field("key", "rows/0/counters/overflowed")));
    EXPECT_THAT(with("/extent/1", -1), FailsWith("compare.wrong_value", Field("key", "extent")));
    EXPECT_THAT(with("/device", "x"), FailsWith("compare.wrong_value", Field("key", "device")));
}

TEST(StoredReport, CutShortOrWithANumberBeyondEveryDoubleIsNoJson) {
    const std::string text = small_document().dump();
    for (std::size_t length = 0; length < text.size(); length += text.size() / 50)
        EXPECT_THAT(parse_report(text.substr(0, length), "a.json"), FailsWith("compare.not_json")) << length;
    EXPECT_THAT(parse_report(R"({"schema":"strata.report","frame":1e400})", "a.json"), FailsWith("compare.not_json"));
    EXPECT_THAT(parse_report(std::string(100'000, '['), "a.json"), FailsWith("compare.not_json"));
    EXPECT_THAT(parse_report(std::string(100'000, '[') + std::string(100'000, ']'), "a.json"), FailsWith("compare.no_schema"));
}

TEST(StoredReport, IsNotReadWithoutItsMemory) {
    const TemporaryFile file("a.json");
    std::ofstream(file.path()) << small_document().dump();
    MemoryBudget small(1000), large;
    EXPECT_THAT(read_report(file.path(), small), FailsWith("memory.budget"));
    EXPECT_TRUE(read_report(file.path(), large));
    EXPECT_THAT(read_report("nowhere.json", large), FailsWith("file.cannot_open"));
}

}  // namespace
}  // namespace strata
