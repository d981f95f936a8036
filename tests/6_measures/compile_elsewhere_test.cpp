// The compiler's process: which driver it is given, and what becomes of it when it fails.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/isa/compile_elsewhere.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

namespace files = std::filesystem;
using testing::HasSubstr;

/// A folder of its own with a driver's description in it, and an environment that leads there.
struct DriverFolder {
    files::path folder;
    std::vector<std::string> variables;
    std::vector<const char*> environment;

    explicit DriverFolder(const std::string& driver) {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder = files::path(testing::TempDir()) / "strata_isa" / test->name();
        files::remove_all(folder);
        files::create_directories(folder / "vulkan/icd.d");
        if (!driver.empty()) std::ofstream(folder / "vulkan/icd.d" / driver) << "{}";
        lead_to({"XDG_DATA_DIRS=" + folder.string(), "XDG_CONFIG_DIRS=" + folder.string() + "/none"});
    }
    void lead_to(std::vector<std::string> made) {
        variables = std::move(made);
        environment.clear();
        for (const std::string& variable : variables) environment.push_back(variable.c_str());
        environment.push_back(nullptr);
    }
    /// A program that stands in for the compiler's process.
    files::path program(const std::string& lines) const {
        const files::path path = folder / "program";
        std::ofstream(path) << "#!/bin/sh\n" << lines << "\n";
        files::permissions(path, files::perms::owner_all);
        return path;
    }
    Result<Compilation> compile(std::string_view gpu, const std::string& lines) const {
        return compile_elsewhere({},
                                 {.model = *find_gpu_model(gpu), .program = program(lines), .environment = environment.data()});
    }
};

constexpr const char* radv = "radeon_icd.x86_64.json";
constexpr const char* empty_answer = R"(echo '{"device":"'$RADV_FORCE_FAMILY'","driver":"'$VK_ICD_FILENAMES'","pipelines":[]}')";

TEST(CompileElsewhere, FindsRadvWhereTheLoaderWould) {
    DriverFolder place(radv);
    const auto found = find_radv(place.environment.data());
    ASSERT_TRUE(found) << found.error().sentence;
    EXPECT_THAT(*found, HasSubstr((place.folder / "vulkan/icd.d" / radv).string()));
    place.lead_to({"XDG_DATA_DIRS=/nowhere", "XDG_CONFIG_DIRS=/nowhere", "VK_ICD_FILENAMES=/a/lvp_icd.json:/b/radeon_icd.json"});
    const auto named = find_radv(place.environment.data());
    ASSERT_TRUE(named) << named.error().sentence;
    EXPECT_EQ(*named, "/b/radeon_icd.json");
}

TEST(CompileElsewhere, WithoutRadvNamesThePackageToInstall) {
    const DriverFolder place("lvp_icd.x86_64.json");
    const auto made = place.compile("bonaire", empty_answer);
    ASSERT_THAT(made, FailsWith("isa.no_radv"));
    EXPECT_EQ(made.error().fault, Fault::device_lacks);
    EXPECT_THAT(made.error().sentence, HasSubstr("mesa-vulkan-drivers"));
}

TEST(CompileElsewhere, GivesTheProcessTheFamilyAndTheDriver) {
    const DriverFolder place(radv);
    const auto made = place.compile("ps4", empty_answer);
    ASSERT_TRUE(made) << made.error().sentence;
    EXPECT_EQ(made->device, "bonaire");
    EXPECT_THAT(made->driver, HasSubstr(radv));
}

TEST(CompileElsewhere, ACrashIsASentenceWithWhatItSaidLast) {
    const DriverFolder place(radv);
    const auto made = place.compile("bonaire", "echo first >&2; echo 'out of luck' >&2; kill -SEGV $$");
    ASSERT_THAT(made, FailsWith("isa.compiler_crashed", Field("target", "bonaire"), Field("signal", "Segmentation fault"),
                                Field("reason", "out of luck")));
    EXPECT_EQ(made.error().fault, Fault::device_failed);
}

TEST(CompileElsewhere, AFamilyThatALaterMesaRenamedIsTriedByItsLaterName) {
    const DriverFolder place(radv);
    const auto made = place.compile(
        "gfx1100",
        std::string("[ $RADV_FORCE_FAMILY = navi31 ] || { echo 'radv: Unknown family' >&2; kill -ABRT $$; }\n") + empty_answer);
    ASSERT_TRUE(made) << made.error().sentence;
    EXPECT_EQ(made->device, "navi31");
}

TEST(CompileElsewhere, AFailureKeepsItsKindAndItsSentence) {
    const DriverFolder place(radv);
    const auto made = place.compile("bonaire", "echo 'strata: it lacks everything' >&2; exit 4");
    ASSERT_THAT(made, FailsWith("isa.compiler_failed", Field("target", "bonaire"), Field("reason", "it lacks everything")));
    EXPECT_EQ(made.error().fault, Fault::device_lacks);
    EXPECT_EQ(place.compile("bonaire", "echo nonsense").error().fault, Fault::bad_input);
}

TEST(CompileElsewhere, ACompilationIsTheSameAfterItsWay) {
    const Compilation there{
        .device = "a",
        .driver = "b",
        .pipelines = {{.failure = "no luck"},
                      {.executables = {{"compute", 64, {{"VGPRs", 24}, {"Latency", 1.5}}, {{"Assembly", "s_endpgm\n\xff"}}}}}}};
    const auto here = compilation_from_json(as_json(there));
    ASSERT_TRUE(here) << here.error().sentence;
    EXPECT_EQ(here->pipelines[0].failure, "no luck");
    const Executable& made = here->pipelines[1].executables[0];
    EXPECT_EQ(made.statistic({"Registers", "VGPRs"}), 24);
    EXPECT_EQ(made.statistic({"Registers"}), std::nullopt);
    EXPECT_EQ(made.wave_lanes, 64u);
    EXPECT_THAT(made.code()->text, testing::StartsWith("s_endpgm\n"));
}

TEST(CompileElsewhere, WithoutADisassemblerTheCompilersLastFormIsTheCode) {
    const Executable made{.texts = {{"NIR Shader(s)", "nir"},
                                    {"ACO IR", "aco"},
                                    {"Assembly", "Shader disassembly is not supported in the current configuration.\n"}}};
    ASSERT_TRUE(made.code());
    EXPECT_EQ(made.code()->text, "aco");
    EXPECT_EQ(Executable{}.code(), nullptr);
}

}  // namespace
}  // namespace strata
