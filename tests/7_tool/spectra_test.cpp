// strata spectra: the modes it finds, that they replay to the same image, and what it refuses.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passes/registry.h"
#include "passes/technique.h"
#include "replay/spectra/spectra.h"
#include "tests/7_tool/process.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

void record_lights_room() { ASSERT_EQ(strata("record lights_room -o room.strata --size 64x36").code, 0); }

std::string technique() { return std::string(must(technique_of_spectra({}))->name); }

/// "--use TECHNIQUE --set modes=2 ..." of a report.
std::string options_of(const json& report) {
    std::string options = "--use " + report["technique"].get<std::string>();
    for (const json& setting : report["settings"]) options += " --set " + setting.get<std::string>();
    return options;
}

TEST(SpectraVerb, FindsModesThatServeEveryTileForNoMoreThanTheFullOne) {
    record_lights_room();
    const Finished made = strata("spectra room.strata --modes 3 --json --validation");
    ASSERT_EQ(made.code, 0) << made.err;
    const json report = json::parse(made.out);
    EXPECT_EQ(report["schema"], "strata.spectra");
    EXPECT_EQ(report["technique"], technique());
    ASSERT_LE(report["modes"].size(), 3u);
    EXPECT_EQ(report["modes"].back()["bits"], 65535) << "the full mode serves whatever comes";
    std::uint64_t by_modes = 0, by_spectra = 0;
    for (const json& mode : report["modes"]) by_modes += mode["tiles"].get<std::uint64_t>();
    ASSERT_FALSE(report["spectra"].empty());
    for (const json& row : report["spectra"]) {
        by_spectra += row["tiles"].get<std::uint64_t>();
        EXPECT_EQ(row["spectrum"].get<std::uint32_t>() & ~row["mode_features"].get<std::uint32_t>(), 0u);
    }
    EXPECT_EQ(by_modes, by_spectra);
    EXPECT_GT(by_spectra, 0u);
    EXPECT_LE(by_spectra, 4u * 3u) << "tiles of 16 x 16";
    const json& predicted = report["predicted"];
    EXPECT_LT(predicted["modes"], predicted["full"]);
    EXPECT_LE(predicted["ideal"], predicted["modes"]);
    EXPECT_EQ(json::parse(strata("spectra room.strata --modes 1 --json").out)["predicted"]["modes"], predicted["full"]);
}

TEST(SpectraVerb, TheModesItFindsReplayToTheSameImage) {
    record_lights_room();
    const json report = json::parse(strata("spectra room.strata --modes 3 --json").out);
    const std::string full = "--use " + technique() + " --set modes=1 --set mode_0=65535 ";
    ASSERT_EQ(strata("replay room.strata -o a " + full).code, 0);
    ASSERT_EQ(strata("replay room.strata -o b " + options_of(report)).code, 0);
    const Finished compared =
        strata(fmt::format("diff {} {}", only_file(folder() / "a", ".exr").string(), only_file(folder() / "b", ".exr").string()));
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_THAT(compared.out, HasSubstr("same          images: display"));
    // Replayed with them, its tiles are shaded as it said.
    const json again = json::parse(strata("spectra room.strata --modes 3 --json " + options_of(report)).out);
    EXPECT_EQ(again["modes"], report["modes"]);
    EXPECT_DOUBLE_EQ(again["predicted"]["as_replayed"].get<double>(), report["predicted"]["modes"].get<double>());
}

TEST(ExhaustiveSpectraVerb, TimesModesOnSeveralCapturesAndWritesTheJsonBesideTheText) {
    record_lights_room();
    ASSERT_EQ(strata("record lights_room -o other.strata --size 48x27 --frames 2").code, 0);
    const Finished made = strata("spectra room.strata other.strata --cost measured --repeats 2 --aim worst -o spectra.json");
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_THAT(made.out,
                AllOf(HasSubstr("3 frames of 2 captures"), HasSubstr("costs: measured"), HasSubstr("of the worst frame"),
                      HasSubstr("one full mode"), HasSubstr("(1) "), HasSubstr("shading mode"), HasSubstr("--set modes=")));
    std::ifstream file(folder() / "spectra.json");
    const json report = json::parse(file);
    EXPECT_EQ(report["unit"], "ms");
    EXPECT_EQ(report["frames"].size(), 3u);
    EXPECT_FALSE(report["timed"].empty());
    EXPECT_GT(report["predicted"]["full"], 0);
}

TEST(SpectraVerb, WrongRequestsEndWithASentence) {
    record_lights_room();
    ASSERT_EQ(strata("record one_pane -o pane.strata").code, 0);
    std::string other;
    for (const Technique* candidate : techniques_of(must(technique_of_spectra({}))->stage))
        if (candidate->name != technique() && candidate->tables.empty()) other = candidate->name;
    const Refusal wrongs[] = {
        {"", 2, "options.missing", "option=captures"},
        {"nowhere.strata", 3, "file.cannot_open", "file=nowhere.strata"},
        {"room.strata --modes 0", 2, "options.out_of_range", "value=0 option=--modes"},
        {"room.strata --modes 17", 2, "options.out_of_range", "low=1 high=16 value=17 option=--modes"},
        {"room.strata --cost weight", 2, "options.not_a_choice", "value=weight suggestion=\"; did you mean weights?\""},
        {"room.strata --aim best", 2, "options.not_a_choice", "option=--aim"},
        {"room.strata --dispatch -1", 2, "options.out_of_range", "option=--dispatch"},
        {"room.strata --repeats 0", 2, "options.out_of_range", "option=--repeats"},
        {"room.strata --frames 3", 2, "capture.no_frame", "frame=3 frames=1"},
        {"room.strata --use " + other, 2, "technique.is_unable", "technique=" + other},
        {"room.strata --set colr=1", 2, "settings.unknown", "setting=colr"},
        {"pane.strata", 2, "spectra.no_frame", ""},
    };
    expect_refusals("spectra", wrongs);
}

}  // namespace
}  // namespace strata
