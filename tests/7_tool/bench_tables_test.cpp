// strata bench --tables: what it measures of the tables that talks print, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "captures/scenarios.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// The table of that title on a small frame, every row and column of it with a number or a reason.
void expect_filled(const json& table, const PublishedTable& stated) {
    EXPECT_EQ(table["title"], stated.title);
    ASSERT_EQ(table["rows"].size(), stated.rows.size() * stated.columns.size());
    for (std::size_t i = 0; i < table["rows"].size(); ++i) {
        const json& cell = table["rows"][i];
        const TableRow& row = stated.rows[i % stated.rows.size()];
        EXPECT_EQ(cell["row"], row.label);
        EXPECT_EQ(cell["column"], stated.columns[i / stated.rows.size()].title);
        EXPECT_NE(cell.contains("measured"), cell.contains("not_measured")) << cell;
        EXPECT_EQ(cell.contains("published"), row.cells[i / stated.rows.size()].published.has_value()) << cell;
        if (i % stated.rows.size() != 0) continue;  // what follows is of the first row
        EXPECT_TRUE(!cell.contains("published") || cell["published_multiple"] == 1) << cell;
        if (!cell.contains("multiple")) continue;
        EXPECT_EQ(cell["multiple"].is_object() ? cell["multiple"]["median"] : cell["multiple"], 1) << cell;
    }
}

json tables_of(const std::string& arguments) {
    const Finished made = strata(fmt::format("bench {} --tables --size 64x36 --repeats 1 --json", arguments));
    EXPECT_EQ(made.code, 0) << made.err;
    return made.code == 0 ? json::parse(made.out) : json{{"tables", json::array()}};
}

void expect_every_table_filled(const Technique& technique) {
    const json made = tables_of(std::string(technique.name));
    EXPECT_EQ(made["schema"], "strata.bench_tables");
    EXPECT_FALSE(made["device"]["name"].get<std::string>().empty());
    ASSERT_EQ(made["tables"].size(), technique.claims.tables.size());
    for (std::size_t i = 0; i < technique.claims.tables.size(); ++i) expect_filled(made["tables"][i], technique.claims.tables[i]);
}

TEST(BenchTables, OfASmallFrameHaveANumberOrAReasonInEveryCell) {
    for (const char* technique : {"lighting/tiled", "shadows/min_max", "gbuffer/packed"})
        expect_every_table_filled(**find_technique(technique));
}

TEST(ExhaustiveBenchTables, OfASmallFrameHaveANumberOrAReasonInEveryCell) {  // a minute: techniques of transparency
    for (const Technique& technique : techniques())
        if (!technique.claims.tables.empty()) expect_every_table_filled(technique);
}

TEST(BenchTables, AreMeasuredOnScenariosThatExist) {
    for (const Technique& technique : techniques())
        for (const PublishedTable& table : technique.claims.tables) EXPECT_TRUE(find_scenario(table.scenario)) << table.title;
}

TEST(BenchTables, HoldTheTimesOfEverySplatBesideTheTalks) {
    const json table = tables_of("voxel --only 'splat types'")["tables"][0];
    EXPECT_EQ(table["scene"], "ash_storm");
    EXPECT_EQ(table["extent"], json({64, 36}));
    EXPECT_TRUE(table["witness"]["happened"].get<bool>()) << table["witness"];
    ASSERT_EQ(table["rows"].size(), 5u);
    for (const json& row : table["rows"]) EXPECT_GT(row["measured"]["median"], 0) << row;
    ASSERT_EQ(table["variants"].size(), 5u);
    for (const json& variant : table["variants"]) EXPECT_GT(variant["stage_bytes"], 0);
    EXPECT_EQ(table["variants"][0]["counters"]["atomics"], 0) << "multiplication needs none";
    EXPECT_GT(table["variants"][1]["counters"]["atomics"], 0);
}

TEST(BenchTables, CountTheBitsOfGbufferLayoutsAsTheTalkDoes) {
    const json table = tables_of("gbuffer")["tables"][0];
    EXPECT_EQ(table["rows"][0]["measured"], 160);
    EXPECT_EQ(table["rows"][1]["measured"], 96);
    EXPECT_EQ(table["rows"][1]["published"], 96);
    EXPECT_EQ(table["rows"][3]["measured"], 64);
}

TEST(BenchTables, PutTheWavesOfLdsAloneBesideTheTalks) {
    const json table = tables_of("tiled")["tables"][0];
    EXPECT_EQ(table["rows"][0]["measured"], 512);
    EXPECT_EQ(table["rows"][1]["measured"], 1280);
    EXPECT_LE(table["rows"][2]["measured"], 2048);
    EXPECT_EQ(table["rows"][3]["measured"], 10);
    EXPECT_EQ(table["rows"][3]["published"], 8);
    EXPECT_EQ(table["rows"][3]["derived"], 8);
}

TEST(BenchTables, WithoutAVariantHaveTheReasonAndThePublishedNumber) {
    const json table = tables_of("voxel --only 1060")["tables"][0];
    EXPECT_FALSE(table.contains("scene")) << "nothing is run";
    EXPECT_EQ(table["rows"][0]["published"], 2.22);
    EXPECT_THAT(table["rows"][0]["not_measured"].get<std::string>(), HasSubstr("published only"));
}

TEST(BenchTables, TakeACaptureAndSayWhatTheyAreMeasuredOn) {
    ASSERT_EQ(strata("record one_pane -o pane.strata").code, 0);
    const Finished made = strata("bench voxel pane.strata --tables --only splat --repeats 1 -o tables.csv");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out, AllOf(HasSubstr("splat types, splat in ms; measured on pane.strata, 64 x 36, 1 sample per pixel"),
                                HasSubstr("published"), HasSubstr("x first"), HasSubstr("witness: overflowed > 0: no")));
    EXPECT_TRUE(std::filesystem::exists(folder() / "tables.csv"));
}

TEST(BenchTables, WrongRequestsEndWithASentence) {
    const Refusal wrongs[] = {
        {"device --tables", 2, "options.not_applicable", "option=--tables"},
        {"voxel --tables --only nothing_like_it", 2, "bench.unknown_table", "only=nothing_like_it"},
        {"alpha_blend --tables", 2, "bench.no_tables", "technique=alpha_blend"},
        {"voxels --tables", 2, "technique.unknown", "did you mean voxel"},
    };
    expect_refusals("bench", wrongs);
}

}  // namespace
}  // namespace strata
