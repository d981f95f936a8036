// strata isa: what RADV makes of a frame's pipelines for GPUs that are not there, against our own arithmetic.
#include <algorithm>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/7_tool/process.h"
#include "tests/support/file_text.h"

namespace strata {
namespace {

using nlohmann::json;
using testing::HasSubstr;

void record_panes() { ASSERT_EQ(strata("record three_panes -o panes.strata").code, 0); }

json isa_json(const std::string& arguments) {
    const Finished made = strata("isa panes.strata --json " + arguments);
    EXPECT_EQ(made.code, 0) << made.err;
    return made.code == 0 ? json::parse(made.out) : json();
}

TEST(Isa, CompilesEveryPipelineOfTheFrameForEveryGpu) {
    record_panes();
    const json report = isa_json("--no-run --gpu-model polaris10,navi21,gfx1100");
    EXPECT_EQ(report["schema"], "strata.isa");
    ASSERT_EQ(report["gpus"].size(), 3u);
    for (const json& gpu : report["gpus"]) {
        EXPECT_GE(gpu["programs"].size(), 8u) << gpu["name"];
        EXPECT_EQ(gpu["notes"], json::array()) << gpu["name"];
        for (const json& program : gpu["programs"]) {
            for (const char* number : {"vector_registers", "instructions", "latency_cycles", "inverse_throughput_cycles"})
                EXPECT_GT(program[number].get<double>(), 0) << number << " of " << program;
            EXPECT_EQ(program["spilled_registers"], 0) << program;
            EXPECT_GE(program["occupancy"]["waves_per_simd"], 1) << program;
        }
        // Every pass is one of a pipeline that was compiled.
        for (const json& pass : gpu["steps"])
            EXPECT_TRUE(std::ranges::any_of(gpu["programs"], [&](const json& p) { return p["pipeline"] == pass["pipeline"]; }))
                << pass;
    }
}

TEST(Isa, TheCompilersOwnWavesAreWhatItsRuleGivesAndOursWhereGroupsStayWhole) {
    record_panes();
    const json report = isa_json("--no-run --gpu-model bonaire,vega10,navi10");
    std::size_t compared = 0;
    for (const json& gpu : report["gpus"])
        for (const json& program : gpu["programs"]) {
            if (program["stage"] != "compute") continue;
            EXPECT_EQ(program["stated_by_compiler"], program["stated_by_rule"]) << gpu["name"] << program;
            // What is rounded up where groups do not fill a unit, or where they share LDS, is tested in tests/6_measures.
            if (program["occupancy"]["lost_to_whole_groups"] > 0 || program["lds_bytes"] > 0) continue;
            const bool counts_halves = gpu["model"]["unit"] == "work group processor";  // a wave of 64 as two
            const double stated = program["stated_by_compiler"].get<double>() / (counts_halves ? 2 : 1);
            EXPECT_EQ(program["occupancy"]["waves_per_simd"], stated) << gpu["name"] << program;
            ++compared;
        }
    EXPECT_GE(compared, 9u);
}

TEST(Isa, ModelsTimesOfWhatIsCountedAndSaysThatItDoes) {
    record_panes();
    const json gpu = isa_json("--gpu-model navi21")["gpus"][0];
    const double cycles_per_ms = gpu["model"]["units"].get<double>() * gpu["model"]["simds_per_unit"].get<double>() *
                                 gpu["model"]["clock_mhz"].get<double>() * 1e3;
    double sum = 0;
    std::size_t modeled = 0;
    for (const json& pass : gpu["steps"]) {
        if (pass["modeled_ms"].is_null()) continue;
        const auto program = std::ranges::find_if(
            gpu["programs"], [&](const json& p) { return p["pipeline"] == pass["pipeline"] && p["stage"] != "vertex"; });
        const double expected =
            pass["invocations"].get<double>() / 64 * program->at("inverse_throughput_cycles").get<double>() / cycles_per_ms;
        EXPECT_NEAR(pass["modeled_ms"].get<double>(), expected, 1e-9 * expected) << pass;
        sum += pass["modeled_ms"].get<double>();
        ++modeled;
    }
    EXPECT_GE(modeled, 4u);
    EXPECT_NEAR(gpu["modeled_ms"].get<double>(), sum, 1e-12);
    EXPECT_THAT(strata("isa panes.strata --gpu-model navi21").out, HasSubstr("modeled, not measured"));
}

TEST(Isa, AFullScreenOfThreadsIsCountedByItsDispatch) {
    record_panes();  // 64 x 36: five rows of groups of 8 x 8, whose last is half empty
    std::size_t whole_screens = 0;
    const json report = isa_json("--no-run --gpu-model bonaire");
    for (const json& pass : report["gpus"][0]["steps"]) {
        EXPECT_EQ(pass["counted_by"] == "unknown", pass["invocations"].is_null()) << pass;
        whole_screens += pass["invocations"] == 64 * 40;
    }
    EXPECT_GE(whole_screens, 2u);
}

TEST(Isa, OneShaderWithOtherConstantsIsARowOfItsOwn) {
    record_panes();
    const auto labels = [](const std::string& arguments) {
        std::vector<std::string> found;
        const json report = isa_json("--no-run --gpu-model bonaire " + arguments);
        for (const json& program : report["gpus"][0]["programs"]) found.push_back(program["label"]);
        return found;
    };
    const std::vector<std::string> plain = labels(""), forced = labels("--force all");
    EXPECT_THAT(plain, testing::Contains(HasSubstr("has_surfaces=1")));
    EXPECT_NE(plain, forced);
}

TEST(Isa, DumpsTheDisassemblyAndWhereThereIsNoneTheCompilersLastForm) {
    record_panes();
    const Finished made = strata("isa panes.strata --no-run --gpu-model bonaire,navi21 --dump code");
    ASSERT_EQ(made.code, 0) << made.err;
    std::size_t assembly = 0, ir = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / "code")) {
        const std::string text = file_text(entry.path());
        EXPECT_GT(text.size(), 200u) << entry.path();
        if (entry.path().extension() == ".s") {
            EXPECT_THAT(text, HasSubstr("s_endpgm")) << entry.path();
            ++assembly;
        } else {
            EXPECT_THAT(text, HasSubstr("ACO shader stage")) << entry.path();
            ++ir;
        }
    }
    EXPECT_GE(assembly, 8u);
    EXPECT_TRUE(ir == 0 || made.err.find("no disassembler for bonaire") != std::string::npos) << made.err;
}

TEST(Isa, RefusesAFolderThatTakesNoFilesBeforeItCompiles) {
    record_panes();
    std::ofstream(folder() / "file").put(' ');
    EXPECT_THAT(strata("-v isa panes.strata --dump file/code"), Refuses(2, "file.cannot_make_folder", "folder=file/code"));
    EXPECT_THAT(strata("-v isa panes.strata --dump /proc"), Refuses(2, "file.cannot_write", "file=/proc/tried"));
}

TEST(Isa, WithoutACaptureListsTheGpusThatAreKnown) {
    const Finished listed = strata("isa");
    EXPECT_EQ(listed.code, 0) << listed.err;
    for (const char* name : {"bonaire", "ps4", "polaris10", "navi10", "navi21", "gfx1100"})
        EXPECT_THAT(listed.out, HasSubstr(name));
    const json models = json::parse(strata("isa --json").out);
    EXPECT_EQ(models["schema"], "strata.gpu_models");
    for (const json& model : models["gpus"]) EXPECT_THAT(listed.out, HasSubstr(model["board"].get<std::string>()));
    EXPECT_EQ(static_cast<std::ptrdiff_t>(models["gpus"].size()), std::ranges::count(listed.out, '\n') - 2) << listed.out;
}

TEST(Isa, WrongRequestsAreUsageErrorsWithASentence) {
    record_panes();
    const Refusal wrongs[] = {
        {"--gpu-model nav21", 2, "isa.unknown_gpu_model", "did you mean navi21?"},
        {"--gpu-model h200", 2, "isa.model_not_in_radv", "model=h200"},
        {"--gpu-model bonaire --frame 9", 2, "capture.no_frame", "frame=9 frames=1"},
        {"--gpu-model bonaire --use nothing/here", 2, "technique.unknown", "technique=nothing/here"},
        {"--gpu-model bonaire --no-run --dump panes.strata", 2, "file.cannot_make_folder", "folder=panes.strata"},
    };
    expect_refusals("isa panes.strata", wrongs);
}

TEST(Isa, WithoutRadvItSaysWhatToInstall) {
    record_panes();
    const Finished failed = strata_after(
        "export XDG_DATA_DIRS=/nonexistent VK_ICD_FILENAMES=/usr/share/vulkan/icd.d/lvp_icd.x86_64.json "
        "VK_DRIVER_FILES=/usr/share/vulkan/icd.d/lvp_icd.x86_64.json",
        "-v isa panes.strata --gpu-model bonaire");
    EXPECT_THAT(failed, Refuses(4, "isa.no_radv"));
    EXPECT_THAT(failed.err, HasSubstr("install mesa-vulkan-drivers"));
}

TEST(Isa, ADeviceThatDoesNotSayWhatItCompiledIsNamed) {
    record_panes();
    EXPECT_THAT(strata("-v isa panes.strata --gpu llvmpipe"),
                Refuses(4, "isa.compiler_failed", "VK_KHR_pipeline_executable_properties"));
}

TEST(Isa, ItsCompilersVerbIsNoPartOfTheHelp) {
    const std::string help = strata("help").out;
    EXPECT_THAT(help, testing::Not(HasSubstr("isa-compile")));
    EXPECT_THAT(help, HasSubstr("\n  replay"));
    EXPECT_EQ(help, strata("--help").out);
}

}  // namespace
}  // namespace strata
