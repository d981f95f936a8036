// What the command line refuses: numbers that are none, and options that would be ignored.
#include <regex>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/file_verbs.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"

namespace strata {
namespace {

using testing::HasSubstr;

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

void expect_no_number(const std::string& verb, const std::string& option, const std::string& value) {
    const Finished refused = strata(fmt::format("{} {}={}", verb, option, value));
    EXPECT_EQ(refused.code, 2) << verb << " " << option << "=" << value;
    EXPECT_THAT(refused.err, HasSubstr("strata: " + option)) << verb << " " << value;
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
        {"x --at 1,1 --depths 99999999999", 2, "--depths: takes a number from 2 to 8192, not 99999999999"},
        {"x --at 1,1 --depths 1", 2, "--depths: takes a number from 2 to 8192, not 1"},
        {"x --at 1,1 --sample 4", 2, "--sample: takes a number from 0 to 3, not 4"},
        {"x --at 1,1 --to 0", 2, "--to: takes a number above 0, not 0"},
        {"x --at 1,1 --from -1e-9", 2, "--from: takes a number above 0, not -1e-9"}};
    expect_refusals("probe", refusals);
    EXPECT_THAT(strata("diff x x --ppd 0.5").err, HasSubstr("--ppd: takes a number from 1 to 1000, not 0.5"));
    EXPECT_THAT(strata("help diff").out, HasSubstr("--ppd FLOAT:1 to 1000"));
}

TEST(Options, ThatSayTwoThingsOrNothingAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    const std::pair<const char*, const char*> refusals[] = {
        {"replay sound.strata --use weighted --set weight=w9 --set weight=w8",
         "--set gives weight twice: weight=w9 and weight=w8"},
        {"record three_panes -o ''", "a file's name is empty"},
        {"info ''", "a file's name is empty"},
        {"export sound.strata --json -o -", "/dev/stdout"},
        {"replay sound.strata --tolerance -1", "takes a number of 0 or more, not -1"}};
    for (const auto& [command, sentence] : refusals) {
        const Finished refused = strata(command);
        EXPECT_EQ(refused.code, 2) << command;
        EXPECT_THAT(refused.err, HasSubstr(sentence)) << command;
    }
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

/// A command and what its sentence names.
struct Ignored {
    std::string command;
    const char* says;
};

TEST(Options, ThatWouldBeIgnoredAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    write_file(folder() / "x.exr", {});
    ASSERT_EQ(strata("replay sound.strata --frames 0 -o out").code, 0);
    const std::string images = "diff out/sound.f0000.exr out/sound.f0000.exr",
                      mixed = "diff sound.strata out/sound.f0000.exr --frames 0";
    const Ignored all[] = {
        {"record three_panes --gpu nosuch", "no device is called 'nosuch'"},
        {"replay sound.strata --use weighted --use transparency/voxel", "two techniques of one stage"},
        {"diff sound.strata --use weighted --use-b voxel", "two techniques of one stage"},
        {"report sound.strata --csv --json", "--csv"},
        {"report --hard-cases --csv", "--csv"},
        {"report --hard-cases --stage shadows", "--stage"},
        {"report --hard-cases --use weighted", "--use"},
        {"report sound.strata --points", "--points"},
        {"list --scenarios shadows", "--scenarios"},
        {"list --names --json", "--names"},
        {"bench voxel --allow-partial", "--allow-partial"},
        {"export sound.strata --json --sample 0 -o x.json", "--sample"},
        {"export sound.strata --image color --transmittance mean -o x.exr", "--transmittance"},
        {"export sound.strata --gltf --use weighted -o x.glb",
         "--use does not apply: --gltf exports the frame as it was recorded"},
        {"export sound.strata --json --samples 1 -o x.json", "--samples does not apply"},
        {"import x.exr --deep --fps 3", "--fps"},
        {"import x.gltf --window 0,0,4,4", "--window"},
        {"import x.exr --deep --window 0,0,-4,4", "--window"},
        {"import x.exr --deep --gpu 0", "--gpu does not apply: a deep image is imported without a device"},
        {images + " --frames 0", "--frames does not apply"},
        {images + " --use-a weighted", "--use-a does not apply"},
        {images + " --gpu nosuch", "--gpu does not apply"},
        {mixed + " --use weighted", "--use does not apply: B is an image"},
        {"diff sound.strata sound.strata --warn-percent 3", "--warn-percent"},
        {"isa --no-run", "--no-run does not apply"},
        {"spectra sound.strata --repeats 3", "--repeats does not apply: --cost is weights"},
        {"spectra sound.strata --cost measured --gpu-model navi21", "--gpu-model does not apply"},
        {"replay sound.strata --samples 0", "--samples"},
        {"replay sound.strata --expect --until combine", "--until does not apply"},
        {"replay sound.strata --tolerance 1 --until combine", "--until does not apply"},
        {"replay sound.strata --tolerance 1 --no-expect", "--no-expect does not apply"},
        {"report sound.strata --methods weighted --defaults", "--methods cannot be combined with --defaults"},
        {"isa sound.strata --gpu-model navi21,navi21", "--gpu-model gives 'navi21' twice"},
        {"replay sound.strata --samples 1 --samples 4", "--samples is given 2 times; give it once"},
        {"replay sound.strata --tolerance 1 --eye pan=1", "--eye does not apply"},
        {"replay sound.strata --eye pan=1,tilt=0,pan=2", "--eye gives pan twice"},
    };
    for (const auto& [command, says] : all) {
        const Finished refused = strata(command);
        EXPECT_EQ(refused.code, 2) << command << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(says)) << command;
    }
    EXPECT_EQ(strata(mixed).code, 0);
}

/// An empty value once counted as none given.
TEST(Options, WhoseValueIsEmptyAreRefused) {
    write_file(folder() / "sound.strata", sound_capture());
    for (const char* given : {"replay sound.strata --frames ''", "replay sound.strata --until ''", "replay sound.strata --eye ''",
                              "replay sound.strata --shaders ''", "replay sound.strata --gpu ''", "replay sound.strata --gpu ' '",
                              "replay sound.strata -o ''", "list ''", "list --stage ''", "bench voxel --only ''"}) {
        const Finished refused = strata(given);
        EXPECT_EQ(refused.code, 2) << given;
        EXPECT_THAT(refused.err, HasSubstr("is given an empty value")) << given;
    }
}

TEST(Options, OfTheProgramStandWithoutAVerb) {
    for (const char* given : {"--list-gpus list", "--version --json", "--version list", "list -- --version", "list --version"}) {
        const Finished refused = strata(given);
        EXPECT_EQ(refused.code, 2) << given << refused.out;
        EXPECT_EQ(refused.out, "") << given;
    }
    EXPECT_EQ(strata("--version").code, 0);
}

TEST(Options, ThatCannotBeFollowedAreASentence) {
    write_file(folder() / "sound.strata", sound_capture());
    const auto whole = sound_capture();
    write_file(folder() / "cut.strata", std::span(whole).first(whole.size() - 1));
    write_file(folder() / "x.exr", std::as_bytes(std::span("\x76\x2f\x31\x01")));
    const Ignored all[] = {
        {"replay sound.strata --repeat 1", "--repeat"},
        {"replay sound.strata --samples 4294967297", "takes 1 or 4, not 4294967297"},
        {"replay sound.strata --frames 0 --until gbuffer --outputs display", "frame 0 has no 'display': --until gbuffer ends"},
        {"replay sound.strata --frames 0 --until gbuffer --outputs gbuffer0,display -o out", "frame 0 has no 'display'"},
        {"replay sound.strata --eye foo=1", "--eye takes dolly, truck, "},
        {"replay sound.strata -o", "--output needs a value"},
        {"probe sound.strata --at 1,1 --axis lin", "--axis: takes log or linear, not 'lin'"},
        {"accept sound.strata --allow-partial", "accept has no option --allow-partial"},
        {"replay sound.strata -- --json", "arguments after -- are file names"},
        {"record smoke", "did you mean smoke_"},
        {"replay sound.strata --set weight=w9", "transparency/weighted has it: pass --use transparency/weighted instead"},
        {"import x.exr", "is an OpenEXR image: pass --deep"},
        {"report sound.strata --sweep weight=w7,w99 --methods weighted", "--sweep weight=w99: transparency/weighted"},
        {"report sound.strata --methods weighted,alpha_blend,weighted", "give the row 'transparency/weighted' twice"},
        {"report sound.strata --methods 'sorted_lists,sorted_lists pool=2'", "the row 'transparency/sorted_lists pool=2' twice"},
        {"report sound.strata --sweep weight=w7,w7 --methods weighted", "the row 'transparency/weighted weight=w7' twice"},
        {"probe sound.strata --at 1,1 --methods weighted,weighted", "--methods gives 'transparency/weighted' twice"},
        {"replay sound.strata --frames 0,0", "--frames lists frame 0 twice in '0,0'"},
        {"replay sound.strata --frames 0,", "--frames takes a list like 0,4-8, not '0,'"},
        {"export sound.strata --image color --caption -o x.exr", "--caption is for a .png"},
        {"export sound.strata --deep --sample 4294967295 -o x.exr", "takes a number from 0 to 3, not 4294967295"},
        {"report --flicker sound.strata", "a number of positions from 2 to 10000, not 'sound.strata'; captures stand before it"},
        {"report sound.strata --use weighted", "choose them with --methods weighted"},
        {"report sound.strata --set pool=3", "give it to one row with --methods 'sorted_lists pool=3'"},
        {"report sound.strata --set weighted:weight=w8", "transparency/weighted:weight=w8 cannot be given to every row"},
        {"replay sound.strata --set sorted_lists:weight=w9", "transparency/sorted_lists has no parameter 'weight'"},
        {"replay sound.strata --set weihgt=w9", "no technique has a parameter 'weihgt'"},
    };
    for (const auto& [command, says] : all) {
        const Finished refused = strata(command);
        EXPECT_EQ(refused.code, 2) << command << refused.err;
        EXPECT_THAT(refused.err, HasSubstr(says)) << command;
    }
    EXPECT_TRUE(std::filesystem::exists(only_file(folder() / "out", ".exr")));  // the outputs that are there are written
    EXPECT_THAT(strata("replay sound.strata --frames 0 --outputs color").err, HasSubstr("pass -o FOLDER"));
    EXPECT_THAT(strata("list weighted").out, HasSubstr("--set weight"));
    EXPECT_THAT(strata("replay cut.strata").err, HasSubstr("pass --allow-partial"));
    for (const char* accept : {"accept cut.strata", "accept cut.strata --dry-run"}) {
        const Finished refused = strata(accept);
        EXPECT_EQ(refused.code, 3) << accept;
        EXPECT_THAT(refused.err, HasSubstr("appended to the end of a complete capture")) << accept;
    }
}

TEST(Options, OfTheFramingCameraAreRefusedWhereAnotherOneIsUsed) {
    write_file(folder() / "sound.strata", sound_capture());
    ASSERT_EQ(strata("export sound.strata --gltf -o own.glb").code, 0);
    const Refusal refusals[] = {{"own.glb --fov 30", 2, "the glTF's own camera is used"},
                                {"own.glb --azimuth 30", 2, "the glTF's own camera is used"},
                                {"own.glb --fov 0", 2, "a field of view has 1 to 170 degrees"},
                                {"own.glb --inside --elevation 30", 2, "--inside places another"},
                                {"own.glb --eye 0,1,5 --azimuth 30", 2, "--eye places another"},
                                {"own.glb --eye 1e308,0,0", 2, "takes a number from -1000000000000 to 1000000000000, not 1e308"},
                                {"own.glb --azimuth 361", 2, "--azimuth takes -360 to 360 degrees"},
                                {"own.glb --fps 3", 2, "ask for more with --frames"},
                                {"own.glb --frames 2 --fps 3", 2, "the glTF has no animation"},
                                {"own.glb --gpu no_such_device --size 16x9", 2, "no device is called 'no_such_device'"}};
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
    EXPECT_THAT(strata(replay + "--use weigthed").err, HasSubstr("no technique weigthed; did you mean weighted?"));
}

}  // namespace
}  // namespace strata
