// What the command line refuses: numbers that are none, and options that would be ignored.
#include <regex>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "replay/cli/renamed_options.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/file_verbs.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::ContainsRegex, testing::HasSubstr;

struct NumericOption {
    std::string name, type;
};

/// Of a verb, as its help names them.
std::vector<NumericOption> numeric_options(const std::string& verb) {
    const std::string help = strata("help " + verb).out;
    const std::regex pattern("(--[a-z-]+)(?:,--[a-z-]+)* (FLOAT|UINT:SIZE|UINT|INT)");
    std::vector<NumericOption> found;
    for (auto match = std::sregex_iterator(help.begin(), help.end(), pattern); match != std::sregex_iterator(); ++match)
        found.push_back({(*match)[1], (*match)[2]});
    return found;
}

std::vector<std::string> some_no_numbers(const std::string& type) {
    if (type == "FLOAT") return {"nan", "inf"};
    return {type == "INT" ? "nan" : "-1", "18446744073709551616"};
}

std::vector<std::string> no_numbers(const std::string& type) {
    if (type == "FLOAT") return {"nan", "-nan", "NaN", "inf", "-inf", "infinity", "1e999", "0x1p3", "1x", "''", "true"};
    std::vector<std::string> none = {"nan",  "inf", "18446744073709551616", "99999999999999999999", "0x10", "1.5", "1e3",
                                     "true", "''"};
    if (type != "INT") none.push_back("-1");
    if (type == "UINT:SIZE")
        none.insert(none.end(), {"0", "0MiB", "-1MiB", "16777216TiB", "18446744073709551615KiB", "MiB", "1xB"});
    return none;
}

/// An empty value counts as none.
void expect_no_number(const std::string& verb, const std::string& option, const std::string& value) {
    const Finished refused = strata(fmt::format("-v {} {}={}", verb, option, value));
    EXPECT_EQ(refused.code, 2) << verb << " " << option << "=" << value;
    EXPECT_THAT(refused.err, ContainsRegex("strata: options[.](not_a_number|not_a_size|no_value): .*option=" + option + "[ \n]"))
        << verb << " " << value;
}

TEST(RenamedOptions, AreRefusedWithTheNameThatTheyHaveNow) {
    for (const std::string verb : verb_names()) {
        const std::string help = strata("help " + verb).out;
        const auto has = [&](std::string_view option) {
            return std::regex_search(help, std::regex(std::string(option) + "\\b"));
        };
        for (const auto& [before, now] : renamed_options) {
            if (!has(now) || has(before)) continue;
            const Finished refused = strata(fmt::format("{} {} 2", verb, before));
            EXPECT_EQ(refused.code, 2) << verb << " " << before;
            EXPECT_THAT(refused.err, HasSubstr(std::string(now))) << verb << " " << before;
        }
    }
}

TEST(Numbers, EveryNumericOptionOfEveryVerbRefusesWhatIsNoNumber) {
    std::size_t options = 0;
    for (const std::string verb : verb_names())
        for (const NumericOption& option : numeric_options(verb)) {
            ++options;
            for (const std::string& value : some_no_numbers(option.type)) expect_no_number(verb, option.name, value);
        }
    EXPECT_GT(options, 40u);
}

/// CLI11 says "Could not convert" of a number that its variable cannot hold.
TEST(Numbers, ThatDoNotFitAreRefusedWithTheRange) {
    for (const std::string verb : verb_names())
        for (const NumericOption& option : numeric_options(verb)) {
            if (option.type == "FLOAT") continue;
            const bool is_signed = option.type == "INT";
            for (const std::string value : {"4294967296", is_signed ? "-2147483649" : "18446744073709551616"}) {
                const Finished refused = strata(fmt::format("{} {}={}", verb, option.name, value));
                EXPECT_THAT(refused.err, Not(HasSubstr("Could not convert"))) << verb << " " << option.name << "=" << value;
            }
        }
    const Refusal refusals[] = {
        {"x --at 1,1 --depths 99999999999", 2, "options.out_of_range", "low=2 high=8192 value=99999999999 option=--depths"},
        {"x --at 1,1 --depths 1", 2, "options.out_of_range", "low=2 high=8192 value=1 option=--depths"},
        {"x --at 1,1 --sample 4", 2, "options.out_of_range", "low=0 high=3 value=4 option=--sample"},
        {"x --at 1,1 --to 0", 2, "options.out_of_range", "low=0 value=0 option=--to"},
        {"x --at 1,1 --from -1e-9", 2, "options.out_of_range", "low=0 value=-1e-9 option=--from"}};
    expect_refusals("probe", refusals);
    EXPECT_THAT(strata("-v diff x x --ppd 0.5"), Refuses(2, "options.out_of_range", "low=1 high=1000 value=0.5 option=--ppd"));
    EXPECT_THAT(strata("help diff").out, HasSubstr("--ppd FLOAT:1 to 1000"));
}

TEST(Options, ThatSayTwoThingsOrNothingAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    const Refusal refusals[] = {
        {"replay sound.strata --use weighted --set weight=w9 --set weight=w8", 2, "settings.given_twice", "weight=w9"},
        {"record three_panes -o ''", 2, "options.empty_value", "option=--output"},
        {"info ''", 2, "options.empty_value", "option=capture"},
        {"export sound.strata --image color -o -", 2, "output.is_dash", ""},
        {"replay sound.strata --tolerance -1", 2, "options.out_of_range", "low=0 value=-1 option=--tolerance"}};
    expect_refusals("", refusals);
    EXPECT_FALSE(std::filesystem::exists(folder() / "-"));
    EXPECT_EQ(
        strata("replay sound.strata --use weighted --set transparency/weighted:weight=w9 --set shadows/pcf:kernel=2x2").code, 0);
}

TEST(Numbers, AreWrittenInDecimals) {
    const std::pair<const char*, NumericOption> of_every_type[] = {{"diff", {"--limit", "FLOAT"}},
                                                                   {"record", {"--seed", "UINT"}},
                                                                   {"import", {"--camera", "INT"}},
                                                                   {"replay", {"--memory-budget", "UINT:SIZE"}}};
    for (const auto& [verb, option] : of_every_type)
        for (const std::string& value : no_numbers(option.type)) expect_no_number(verb, option.name, value);
}

TEST(Numbers, ASizeMayHaveAUnitAndANumberZerosBeforeIt) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const char* size : {"268435456", "256MiB", "256mb", "'256 MiB'", "0256MiB", "1GiB"}) {
        const Finished replayed =
            strata(fmt::format("replay sound.strata --frames 00 --outputs color -o out --memory-budget {}", size));
        EXPECT_EQ(replayed.code, 0) << size << replayed.err;
    }
    ASSERT_EQ(strata("record three_panes --seed 010 -o ten.strata").code, 0);
    EXPECT_THAT(strata("info ten.strata").out, HasSubstr("seed 10"));
}

TEST(Options, ThatWouldBeIgnoredAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    write_file(folder() / "x.exr", {});
    ASSERT_EQ(strata("replay sound.strata --frames 0 -o out").code, 0);
    const std::string images = "diff out/sound.f0000.exr out/sound.f0000.exr",
                      mixed = "diff sound.strata out/sound.f0000.exr --frames 0";
    const Refusal all[] = {
        {"record three_panes --gpu nosuch", 2, "device.unknown", "device=nosuch"},
        {"replay sound.strata --use weighted --use transparency/voxel", 2, "technique.two_of_a_stage",
         "technique=transparency/weighted other=transparency/voxel"},
        {"diff sound.strata --use weighted --use-b voxel", 2, "technique.two_of_a_stage",
         "technique=transparency/weighted other=transparency/voxel"},
        {"report sound.strata --csv --json", 2, "options.excluded", "--csv"},
        {"replay sound.strata --csv", 2, "options.needs", "option=--csv"},
        {"report sound.strata --json -o report.csv", 2, "output.ending_contradicts",
         "file=report.csv ending=.json option=--json"},
        {"report --hard-cases --stage shadows", 2, "options.not_applicable", "option=--stage"},
        {"report --hard-cases --use weighted", 2, "options.not_applicable", "option=--use"},
        {"report sound.strata --variants", 2, "options.needs", "option=--variants"},
        {"list --scenarios shadows", 2, "options.excluded", "--scenarios"},
        {"list --names --json", 2, "options.excluded", "--names"},
        {"bench voxel --allow-partial", 2, "options.needs", "option=--allow-partial"},
        {"export sound.strata --json --sample 0 -o x.json", 2, "options.needs", "option=--sample"},
        {"export sound.strata --image color --transmittance mean -o x.exr", 2, "options.needs", "option=--transmittance"},
        {"export sound.strata --gltf --use weighted -o x.glb", 2, "options.not_applicable", "option=--use reason=\"--gltf"},
        {"export sound.strata --json --samples 1 -o x.json", 2, "options.not_applicable", "option=--samples"},
        {"import x.exr --deep --fps 3", 2, "options.not_applicable", "option=--fps"},
        {"import x.gltf --window 0,0,4,4", 2, "options.needs", "option=--window"},
        {"import x.exr --deep --window 0,0,-4,4", 2, "options.out_of_range", "option=--window width=-4 height=4"},
        {"import x.exr --deep --gpu 0", 2, "options.not_applicable", "option=--gpu"},
        {images + " --frames 0", 2, "options.not_applicable", "option=--frames"},
        {images + " --use-a weighted", 2, "options.not_applicable", "option=--use-a"},
        {images + " --gpu nosuch", 2, "options.not_applicable", "option=--gpu"},
        {mixed + " --use weighted", 2, "options.not_applicable", "option=--use reason=\"B is an image"},
        {"diff sound.strata sound.strata --warn-percent 3", 2, "options.needs", "option=--warn-percent other=--warn-limit"},
        {"isa --no-run", 2, "options.not_applicable", "option=--no-run"},
        {"spectra sound.strata --repeats 3", 2, "options.not_applicable", "option=--repeats reason=\"--cost is weights"},
        {"spectra sound.strata --cost measured --gpu-model navi21", 2, "options.not_applicable", "option=--gpu-model"},
        {"replay sound.strata --samples 0", 2, "options.not_a_choice", "value=0 option=--samples"},
        {"replay sound.strata --expect --until combine", 2, "options.not_applicable", "option=--until"},
        {"replay sound.strata --tolerance 1 --until combine", 2, "options.not_applicable", "option=--until"},
        {"replay sound.strata --tolerance 1 --no-expect", 2, "options.not_applicable", "option=--no-expect"},
        {"report sound.strata --techniques weighted --defaults", 2, "options.excluded", "--defaults"},
        {"isa sound.strata --gpu-model navi21,navi21", 2, "options.value_twice", "option=--gpu-model value=navi21"},
        {"replay sound.strata --samples 1 --samples 4", 2, "options.repeated", "option=--samples times=2"},
        {"replay sound.strata --tolerance 1 --eye pan=1", 2, "options.not_applicable", "option=--eye"},
        {"replay sound.strata --eye pan=1,tilt=0,pan=2", 2, "eye.axis_given_twice", "axis=pan"},
    };
    for (const auto& [command, code, id, values] : all)
        EXPECT_THAT(strata("-v " + command), Refuses(code, id, values)) << command;
    EXPECT_EQ(strata(mixed).code, 0);
}

/// An empty value once counted as none given.
TEST(Options, WhoseValueIsEmptyAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const char* given : {"replay sound.strata --frames ''", "replay sound.strata --until ''", "replay sound.strata --eye ''",
                              "replay sound.strata --shaders ''", "replay sound.strata --gpu ''", "replay sound.strata --gpu ' '",
                              "replay sound.strata -o ''", "list ''", "list --stage ''", "bench voxel --only ''"}) {
        EXPECT_THAT(strata(fmt::format("-v {}", given)), Refuses(2, "options.empty_value")) << given;
    }
}

TEST(Options, OfTheProgramStandWithoutAVerb) {
    for (const char* given :
         {"--list-gpus list", "--version --list-gpus", "--version list", "list -- --version", "list --version"}) {
        const Finished refused = strata(given);
        EXPECT_EQ(refused.code, 2) << given << refused.out;
        EXPECT_EQ(refused.out, "") << given;
    }
    EXPECT_EQ(strata("--version").code, 0);
    const Finished in_json = strata("--version --json");
    EXPECT_EQ(in_json.code, 2);
    EXPECT_EQ(nlohmann::json::parse(in_json.out)["error"]["id"], "options.excluded") << in_json.out;
}

TEST(Options, ThatCannotBeFollowedAreASentence) {
    write_file(folder() / "sound.strata", sound_capture());
    const auto whole = sound_capture();
    write_file(folder() / "cut.strata", std::span(whole).first(whole.size() - 1));
    write_file(folder() / "x.exr", std::as_bytes(std::span("\x76\x2f\x31\x01")));
    const Refusal all[] = {
        {"replay sound.strata --repeats 1", 2, "options.out_of_range", "low=2 high=100000 value=1 option=--repeats"},
        {"replay sound.strata --samples 4294967297", 2, "options.not_a_choice", "value=4294967297 option=--samples"},
        {"replay sound.strata --frames 0 --until gbuffer --outputs display", 2, "frame.no_output",
         "frame=0 output=\"'display': --until gbuffer ends"},
        {"replay sound.strata --frames 0 --until gbuffer --outputs gbuffer0,display -o out", 2, "frame.no_output",
         "frame=0 output=\"'display'"},
        {"replay sound.strata --eye foo=1", 2, "eye.unknown_axis", "axis=foo"},
        {"replay sound.strata -o", 2, "options.no_value", "option=--output"},
        {"probe sound.strata --at 1,1 --axis lin", 2, "options.not_a_choice", "choices=\"log or linear\" value=lin"},
        {"accept sound.strata --allow-partial", 2, "options.unknown", "verb=\"strata accept\" option=--allow-partial"},
        {"replay sound.strata -- --json", 2, "options.after_separator", "verb=replay"},
        {"record smoke", 2, "scenario.unknown", "did you mean smoke_"},
        {"replay sound.strata --set weight=w9", 2, "settings.of_another_technique", "technique=transparency/weighted"},
        {"import x.exr", 2, "import.needs_deep", "file=x.exr"},
        {"report sound.strata --sweep weight=w7,w99 --techniques weighted", 2, "settings.not_a_choice",
         "setting=weight value=w99 technique=transparency/weighted"},
        {"report sound.strata --techniques weighted,alpha_blend,weighted", 2, "report.row_given_twice",
         "row=transparency/weighted"},
        {"report sound.strata --techniques 'sorted_lists,sorted_lists pool=2'", 2, "report.row_given_twice",
         "row=\"transparency/sorted_lists pool=2\""},
        {"report sound.strata --sweep weight=w7,w7 --techniques weighted", 2, "report.row_given_twice",
         "row=\"transparency/weighted weight=w7\""},
        {"probe sound.strata --at 1,1 --techniques weighted,weighted", 2, "report.technique_given_twice",
         "variant=transparency/weighted"},
        {"replay sound.strata --frames 0,0", 2, "options.value_twice", "option=--frames value=0"},
        {"replay sound.strata --frames 0,", 2, "options.malformed", "option=--frames value=0,"},
        {"export sound.strata --image color --caption -o x.exr", 2, "options.not_applicable", "option=--caption"},
        {"export sound.strata --deep --sample 4294967295 -o x.exr", 2, "options.out_of_range", "value=4294967295"},
        {"report --flicker sound.strata", 2, "options.out_of_range", "low=2 high=10000 value=sound.strata option=--flicker"},
        {"report sound.strata --use weighted", 2, "report.use_of_measured_stage", "variant=weighted"},
        {"report sound.strata --set pool=3", 2, "report.setting_of_some_rows", "variant=\"sorted_lists pool=3\""},
        {"report sound.strata --set weighted:weight=w8", 2, "report.setting_of_some_rows",
         "setting=transparency/weighted:weight=w8"},
        {"replay sound.strata --set sorted_lists:weight=w9", 2, "settings.unknown",
         "technique=transparency/sorted_lists setting=weight"},
        {"replay sound.strata --set weihgt=w9", 2, "settings.unknown", "setting=weihgt"},
    };
    for (const auto& [command, code, id, values] : all)
        EXPECT_THAT(strata("-v " + command), Refuses(code, id, values)) << command;
    EXPECT_TRUE(std::filesystem::exists(only_file(folder() / "out", ".exr")));  // the outputs that are there are written
    EXPECT_THAT(strata("replay sound.strata --frames 0 --outputs color").err, HasSubstr("pass -o FOLDER"));
    EXPECT_THAT(strata("list weighted").out, HasSubstr("--set weight"));
    EXPECT_THAT(strata("replay cut.strata").err, HasSubstr("pass --allow-partial"));
    for (const char* accept : {"accept cut.strata", "accept cut.strata --dry-run"})
        EXPECT_THAT(strata(fmt::format("-v {}", accept)), Refuses(3, "capture.section.cut", "kind=directory")) << accept;
}

TEST(Options, OfTheFramingCameraAreRefusedWhereAnotherOneIsUsed) {
    write_file(folder() / "sound.strata", sound_capture());
    ASSERT_EQ(strata("export sound.strata --gltf -o own.glb").code, 0);
    const Refusal refusals[] = {
        {"own.glb --fov 30", 2, "import.gltf.view_unused", ""},
        {"own.glb --azimuth 30", 2, "import.gltf.view_unused", ""},
        {"own.glb --fov 0", 2, "import.gltf.fov_range", "fov=0"},
        {"own.glb --inside --elevation 30", 2, "import.gltf.two_cameras", "other=--inside"},
        {"own.glb --eye 0,1,5 --azimuth 30", 2, "import.gltf.two_cameras", "other=--eye"},
        {"own.glb --eye 1e308,0,0", 2, "options.out_of_range", "low=-1000000000000 high=1000000000000 value=1e308 option=--eye"},
        {"own.glb --azimuth 361", 2, "import.gltf.orbit_range", "azimuth=361"},
        {"own.glb --fps 3", 2, "options.not_applicable", "option=--fps"},
        {"own.glb --frames 2 --fps 3", 2, "import.gltf.fps_unused", ""},
        {"own.glb --gpu no_such_device --size 16x9", 2, "device.unknown", "device=no_such_device"}};
    expect_refusals("import", refusals);
    EXPECT_NE(strata("replay sound.strata --frames 0 --tolerance=-0").code, 2) << "-0 is 0";
    EXPECT_EQ(strata("import own.glb --eye 0,1,5 --fov 30 --size 16x9").code, 0);
}

TEST(Techniques, OfAStageThatIsLeftOutAreNamedOnceWithTheOptionThatRunsThem) {
    write_file(folder() / "sound.strata", sound_capture());
    const std::string lens =
        "strata: lens/camera and bloom=off have no effect in frame 0: its stage is left out (the frame has no lens "
        "effects); --force bloom or --force auto_exposure or --force depth_of_field or --force lens_distortion runs it all the "
        "same\n";
    const Finished made = strata("replay sound.strata --use lens/camera --set bloom=off");
    EXPECT_EQ(made.code, 0);
    ASSERT_THAT(made.err, HasSubstr(lens));
    EXPECT_THAT(made.err.substr(made.err.find(lens) + lens.size()), Not(HasSubstr("no effect")));
    EXPECT_THAT(strata("graph sound.strata --use all_samples").err, HasSubstr("edges/all_samples has no effect in frame 0"));
    EXPECT_THAT(strata("graph sound.strata --use all_samples").err, HasSubstr("--samples 4 runs it all the same"));
    for (const char* verb : {"bench voxel sound.strata --only splat --repeats 1", "bench device sound.strata --repeats 1",
                             "isa sound.strata --no-run", "spectra sound.strata"})
        EXPECT_THAT(strata(fmt::format("{} --use lens/camera --set bloom=off", verb)).err, HasSubstr(lens)) << verb;
    for (const char* runs : {"--use lens/camera --force bloom", "--use all_samples --samples 4", "--use weighted"})
        EXPECT_EQ(strata(fmt::format("graph sound.strata {}", runs)).err, "") << runs;
}

TEST(Techniques, NeedTheirStageOnlyWhereSeveralHaveOneOfThatName) {
    write_file(folder() / "sound.strata", sound_capture());
    const std::string replay = "replay sound.strata --frames 0 --outputs color -o out ";
    EXPECT_THAT(strata(replay + "--use weighted --set weighted:scale=2").out, HasSubstr("transparency   transparency/weighted"));
    EXPECT_THAT(strata("-v " + replay + "--use weigthed"),
                Refuses(2, "technique.unknown", "technique=weigthed suggestion=\"; did you mean weighted?\""));
}

}  // namespace
}  // namespace strata
