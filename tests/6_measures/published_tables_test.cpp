// Tables that talks print: complete, as printed, of variants that exist; and what formats make of one.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "capture_format/frame/frame.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/bench/published_tables.h"
#include "replay/isa/gpu_models.h"
#include "replay/report/variants.h"
#include "replay/session/choices.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using Numbers = std::vector<std::optional<double>>;
constexpr auto none = std::nullopt;

const PublishedTable& table_of(std::string_view technique, std::string_view title) {
    const auto& tables = must(find_technique(technique))->claims.tables;
    const auto found = std::ranges::find(tables, title, &PublishedTable::title);
    return found != tables.end() ? *found : throw std::runtime_error(fmt::format("no table {}", title));
}

/// Row by row.
Numbers published(const PublishedTable& table) {
    Numbers numbers;
    for (const TableRow& row : table.rows)
        for (const TableCell& cell : row.cells) numbers.push_back(cell.published);
    return numbers;
}

/// Empty if there is such a variant.
std::string fault_of(const Technique& stating, std::string_view variant) {
    const auto made = variant_of(stating, variant, {});
    if (!made) return made.error().sentence;
    const auto chosen = choose(Frame{}, made->request.choices);
    return chosen ? "" : chosen.error().sentence;
}

template <typename Check>
void for_every_table(Check check) {
    for (const Technique& technique : techniques())
        for (const PublishedTable& table : technique.claims.tables) {
            SCOPED_TRACE(fmt::format("{}: {}", technique.name, table.title));
            check(technique, table);
        }
}

TEST(PublishedTables, OfVoxelTransparencyHaveTheRowsAndColumnsOfTheTalk) {
    const std::map<std::string_view, std::pair<std::size_t, std::size_t>> rows_and_columns = {
        {"splat types", {5, 1}},
        {"splat formats", {4, 1}},
        {"point and linear splats", {4, 1}},
        {"clear and integrate", {2, 4}},
        {"quads against depth export", {2, 3}},
        {"early-out at zero transmittance", {3, 6}},
        {"memory of mono functions", {3, 3}},
        {"memory of RGB functions", {3, 3}},
        {"RGB multipliers", {3, 6}},
        {"techniques by step", {5, 7}},
        {"RGB in practice", {4, 1}},
        {"PS4", {4, 3}},
        {"GTX 1060", {2, 1}},
    };
    const auto& tables = must(find_technique("transparency/voxel"))->claims.tables;
    EXPECT_EQ(tables.size(), rows_and_columns.size());
    for (const PublishedTable& table : tables) {
        ASSERT_TRUE(rows_and_columns.contains(table.title)) << table.title;
        EXPECT_EQ(std::pair(table.rows.size(), table.columns.size()), rows_and_columns.at(table.title)) << table.title;
    }
}

TEST(PublishedTables, PrintTheNumbersOfTheTalk) {
    constexpr std::string_view voxel = "transparency/voxel";
    EXPECT_EQ(published(table_of(voxel, "splat types")), (Numbers{.75, .91, .89, 1.95, .91}));
    EXPECT_EQ(published(table_of(voxel, "splat formats")), (Numbers{.75, .81, .91, .95}));
    EXPECT_EQ(published(table_of(voxel, "clear and integrate")), (Numbers{.153, .2, .353, 66.5, .01, .04, .05, none}));
    EXPECT_EQ(published(table_of(voxel, "quads against depth export")), (Numbers{.004, .01, .014, none, none, .2}));
    EXPECT_EQ(published(table_of(voxel, "early-out at zero transmittance")),
              (Numbers{none, none, 2.035, 1.98, 21276176, 2759432, none, none, 1.78, 1.742, 18922855, 1867980, none, none, 1.73,
                       1.73, none, none}));
    EXPECT_EQ(
        published(table_of(voxel, "techniques by step")),
        (Numbers{.001, .196, none,  none, 5.4,  .108, 5.705, .001, .199, none,  none, 5.6,  .108, 5.908, .013, .204, none, .025,
                 5.2,  .108, 5.667, .013, .204, .006, .025,  4.5,  .108, 4.967, none, none, none, none,  4.4,  none, 4.4}));
    EXPECT_EQ(published(table_of(voxel, "RGB in practice")), (Numbers{2.8, 2.95, 3.02, 3.11}));
    EXPECT_EQ(published(table_of(voxel, "PS4")), (Numbers{3.31, 3.34, 6.65, 3.04, 3.12, 6.16, 2.11, 2.91, 5.03, 1.8, 2.72, 4.5}));
    EXPECT_EQ(published(table_of("lighting/tiled", "LDS and waves of culling")), (Numbers{512, 1280, none, 8}));
    EXPECT_EQ(published(table_of("gbuffer/packed", "layouts")), (Numbers{160, none, 96, none, none, none, none, none}));
}

TEST(PublishedTables, HaveACellForEveryRowAndColumnAndASource) {
    for_every_table([](const Technique& technique, const PublishedTable& table) {
        EXPECT_FALSE(table.source.empty());
        EXPECT_EQ(std::ranges::count(technique.claims.tables, table.title, &PublishedTable::title), 1);
        EXPECT_EQ(table.witness.counter.empty(), table.witness.otherwise.empty());
        bool is_derived = false;
        for (const TableRow& row : table.rows) {
            EXPECT_EQ(row.cells.size(), table.columns.size()) << row.label;
            EXPECT_TRUE(row.variant || !row.not_measured.empty()) << row.label;
            for (const TableCell& cell : row.cells) {
                EXPECT_FALSE(cell.published && !cell.printed.empty()) << row.label << ": printed in two ways";
                is_derived |= cell.derived.has_value();
            }
        }
        EXPECT_EQ(is_derived, !table.derivation.empty()) << "a derived number says how it comes about";
    });
}

TEST(PublishedTables, NameSettingsCountersStagesAndGpusThatExist) {
    for_every_table([](const Technique& technique, const PublishedTable& table) {
        std::set<std::string_view> counted;
        for (const Technique* one : techniques_of(technique.stage))
            for (const Counter& counter : one->counters) counted.insert(counter.name);
        for (const std::string_view counter : table.counters) EXPECT_TRUE(counted.contains(counter)) << counter;
        EXPECT_TRUE(table.witness.counter.empty() || counted.contains(table.witness.counter));
        for (const TableRow& row : table.rows)
            for (const auto& variant : {row.variant, row.against})
                EXPECT_EQ(fault_of(technique, variant.value_or("")), "") << row.label;
        for (const TableValueColumn& column : table.columns) {
            EXPECT_TRUE(column.value != TableValue::invocations || find_stage(column.parts.front()));
            EXPECT_TRUE(column.value != TableValue::waves || find_gpu_model(column.parts.front()));
            const auto is_counted = [&](std::string_view counter) { return counted.contains(counter); };
            EXPECT_TRUE(column.value != TableValue::counter || std::ranges::all_of(column.parts, is_counted));
        }
    });
}

TEST(PublishedTables, RefuseSettingsThatTheTechniqueDoesNotHave) {
    const Technique& voxel = *must(find_technique("transparency/voxel"));
    EXPECT_EQ(fault_of(voxel, "splat=multiply channels=mono"), "");
    EXPECT_NE(fault_of(voxel, "splat=multiplied"), "");
    EXPECT_NE(fault_of(voxel, "splats=multiply"), "");
    EXPECT_NE(fault_of(voxel, "moment kind=power4"), "");
}

/// A table of two rows and two columns, of which the second row was not measured in the second column.
const PublishedTable small{.title = "a small table",
                           .source = "a talk",
                           .columns = {{.title = "draw"}, {.title = "read", .unit = "MB", .value = TableValue::megabytes}},
                           .rows = {{"first", "", {{2.}, {.printed = "1-4"}}}, {"second", "", {{3.}, {.derived = 7.5}}}},
                           .witness = {"zero tiles", "nothing happens"},
                           .derivation = "by hand"};

PublishedTables measured_small() {
    const Technique& technique = *must(find_technique("transparency/voxel"));
    const auto& [first, second] = std::tie(small.rows[0].cells, small.rows[1].cells);
    const Spread one{.median = 1, .mad = 0, .low = 1, .high = 1, .repeats = 3};
    const Spread twice{.median = 2.5, .mad = .25, .low = 2, .high = 3, .repeats = 3};
    MeasuredTable table{.claim = {.technique = &technique, .table = &small, .base = {}, .scene = "a scenario"},
                        .width = 64,
                        .height = 36,
                        .samples = 1,
                        .cells = {{"first", "draw", "ms", &first[0], twice, one, 1.},
                                  {"second", "draw", "ms", &second[0], twice, twice, 1.5},
                                  {"first", "read", "MB", &first[1], 12.25, 1.},
                                  {"second", "read", "MB", &second[1], {}, {}, {}, "no such variant"}},
                        .rows = {{"first", "voxel", "", 1 << 20, {{"transparency/voxel", "drawn", 39106}}}},
                        .is_witnessed = false};
    return {.device = {.name = "a device", .driver = "its driver"}, .repeats = 3, .tables = {table}};
}

TEST(PublishedTables, SayInTextWhatIsMeasuredPublishedDerivedAndMissing) {
    const std::string text = as_text(measured_small());
    EXPECT_THAT(
        text,
        AllOf(HasSubstr("a small table; measured on a scenario, 64 x 36, 1 sample per pixel"), HasSubstr("published: a talk"),
              HasSubstr("draw, ms: second"), HasSubstr("2.5 +-0.25"), HasSubstr("1-4"), HasSubstr("7.5"), HasSubstr("1.50"),
              HasSubstr("not measured (no such variant): read, MB: second"), HasSubstr("derived, not published: by hand"),
              HasSubstr("witness: zero tiles > 0: no; nothing happens"), HasSubstr("first: voxel: 1.00 MiB, drawn 39106")));
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

TEST(PublishedTables, AreRowsOfJsonAndCsv) {
    const json made = json::parse(as_json(measured_small()));
    EXPECT_EQ(made["schema"], "strata.bench_tables");
    const json& table = made["tables"][0];
    EXPECT_EQ(table["title"], "a small table");
    EXPECT_EQ(table["extent"], json({64, 36}));
    EXPECT_EQ(table["witness"]["happened"], false);
    EXPECT_EQ(table["variants"][0]["counters"]["drawn"], 39106);
    ASSERT_EQ(table["rows"].size(), 4u);
    EXPECT_EQ(table["rows"][1]["measured"]["median"], 2.5);
    EXPECT_EQ(table["rows"][1]["published"], 3);
    EXPECT_EQ(table["rows"][1]["published_multiple"], 1.5);
    EXPECT_EQ(table["rows"][2]["published_text"], "1-4");
    EXPECT_FALSE(table["rows"][2].contains("published"));
    EXPECT_EQ(table["rows"][3]["not_measured"], "no such variant");
    EXPECT_FALSE(table["rows"][3].contains("measured"));
    EXPECT_FALSE(table["rows"][3].contains("published")) << "what is derived is not published";
    EXPECT_EQ(table["rows"][3]["derived"], 7.5);
    const std::string csv = as_csv(measured_small());
    EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
    EXPECT_THAT(csv, HasSubstr("\"a small table\",\"a scenario\",\"second\",\"draw\",\"ms\",2.5,0.25,3,"));
    EXPECT_THAT(csv, Not(HasSubstr("measured_text")));
}

}  // namespace
}  // namespace strata
