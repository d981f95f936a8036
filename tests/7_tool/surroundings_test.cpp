// When the file is sound and the world around it is not: outputs, disks, devices, caches.
#include <fstream>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/capability.h"
#include "replay/images/image_io.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/7_tool/forged_captures.h"
#include "tests/7_tool/process.h"
#include "tests/support/gltf_text.h"

namespace strata {
namespace {

using testing::HasSubstr;

/// A command that writes, up to the file or folder that it writes.
struct Writing {
    const char* command;
    const char* target;
};
constexpr Writing writings[] = {
    {"record three_panes -o", "made.strata"},
    {"replay sound.strata --outputs color -o", "out"},
    {"report sound.strata --repeats 1 --techniques weighted -o", "report.txt"},
    {"bench voxel sound.strata --repeats 1 --only two -o", "bench.json"},
    {"bench device sound.strata --repeats 1 -o", "device.json"},
    {"diff sound.strata --use transparency/weighted --limit 1000 --junit", "junit.xml"},
    {"probe sound.strata --at 8,4 --techniques sorted_lists --depths 512 -o", "probed"},
    {"export sound.strata --deep --transmittance mean -o", "deep.exr"},
    {"export sound.strata --gltf -o", "scene.glb"},
    {"export sound.strata --json -o", "frame.json"},
    {"export sound.strata --image color -o", "color.exr"},
};

void write_sound_capture() { write_file(folder() / "sound.strata", sound_capture()); }

/// How many files there are but the capture and what the last run printed.
std::size_t files_made() {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder())) {
        const auto name = entry.path().filename();
        count += entry.is_regular_file() && name != "stdout.txt" && name != "stderr.txt" && name != "sound.strata";
    }
    return count;
}

TEST(Output, ThatCannotBeWrittenIsAUsageErrorWithTheSystemsWords) {
    write_sound_capture();
    for (const Writing& writing : writings) {
        const std::string below_a_file = fmt::format("{} sound.strata/{}", writing.command, writing.target);
        const Finished failed = strata(below_a_file);
        EXPECT_EQ(failed.code, 2) << below_a_file << failed.err;
        EXPECT_THAT(failed.err, testing::AllOf(HasSubstr("sound.strata"), HasSubstr("Not a directory"))) << below_a_file;
    }
    std::filesystem::create_directory(folder() / "made.strata");
    EXPECT_THAT(strata("-v record three_panes -o made.strata"),
                Refuses(2, "file.cannot_write", "file=made.strata reason=\"Is a directory\""));
    EXPECT_THAT(strata("-v replay sound.strata -o sound.strata"), Refuses(2, "file.cannot_make_folder", "folder=sound.strata"));
    EXPECT_EQ(files_made(), 0u);
}

/// What was measured for hours would be lost. A folder that the verb itself makes may be missing.
TEST(Output, ThatCannotBeWrittenIsRefusedBeforeAnythingIsMeasured) {
    write_sound_capture();
    for (const char* command : {"report sound.strata --techniques weighted -o", "bench voxel sound.strata --only splat -o",
                                "spectra sound.strata -o", "diff sound.strata --use transparency/weighted --junit"}) {
        const Finished refused = strata(fmt::format("-v {} nowhere/made", command));
        EXPECT_THAT(refused, Refuses(2, "file.cannot_write", "file=nowhere/made reason=\"No such file or directory\""))
            << command;
        EXPECT_EQ(refused.out, "") << command;
    }
    EXPECT_EQ(strata("diff sound.strata sound.strata --frames 0 -o new/folder --junit new/folder/junit.xml").code, 0);
    EXPECT_EQ(files_made(), 1u);
}

/// A command that reads sound.strata, and a file that it writes.
constexpr Writing inputs_as_outputs[] = {
    {"report sound.strata --repeats 1 --sweep pool=2 -o link.txt", "link.txt"},
    {"bench voxel sound.strata --repeats 1 --only two -o link.json", "link.json"},
    {"spectra sound.strata --modes 3 -o link.json", "link.json"},
    {"diff sound.strata --use transparency/weighted --limit 1000 --junit link.xml", "link.xml"},
    {"export sound.strata --deep --transmittance mean -o link.exr", "link.exr"},
    {"export sound.strata --gltf -o link.glb", "link.glb"},
    {"export sound.strata --json -o link.json", "link.json"},
    {"export sound.strata --image color -o link.png", "link.png"},
    {"isa sound.strata --tiles link.png", "link.png"},
    {"import sound.strata -o link.strata", "link.strata"},
    {"replay sound.strata --frames 0 --outputs color -o out", "out/sound.f0000.exr"},
    {"probe sound.strata --at 8,4 --techniques sorted_lists --depths 16 -o link", "link.csv"},
    {"inspect sound.strata --size 400x300 --script shot.script", "link.png"},
};

TEST(Output, ThatIsAnInputIsRefusedByEveryVerbAlsoThroughLinks) {
    write_sound_capture();
    std::ofstream(folder() / "shot.script") << "shot link.png\n";
    std::filesystem::create_directory(folder() / "out");
    const auto expect_kept = [](const std::string& command) {
        EXPECT_THAT(strata("-v " + command), Refuses(2, "file.is_input", "input=sound.strata")) << command;
        EXPECT_EQ(read_file(folder() / "sound.strata"), sound_capture()) << command;
    };
    for (const auto& [command, output] : inputs_as_outputs) {
        std::filesystem::create_symlink(folder() / "sound.strata", folder() / output);
        expect_kept(command);
        std::filesystem::remove(folder() / output);
        std::filesystem::create_hard_link(folder() / "sound.strata", folder() / output);
        expect_kept(command);
        std::filesystem::remove(folder() / output);
    }
    expect_kept("export sound.strata --json -o sound.strata");
    expect_kept("report sound.strata -o ./sound.strata");
}

// The limit of a file's size is a full disk for one process: a write of more fails.
TEST(Output, OnAFullDiskIsAUsageErrorAndLeavesWhatWasThereBefore) {
    write_sound_capture();
    std::filesystem::create_directory(folder() / "out");
    for (const char* old : {"made.strata", "report.txt", "out/sound.f0000.exr"}) std::ofstream(folder() / old) << "old";
    for (const Writing& writing : writings) {
        const Finished failed = strata_after("ulimit -f 1", fmt::format("{} {}", writing.command, writing.target));
        EXPECT_EQ(failed.code, 2) << writing.command << failed.err;
        EXPECT_THAT(failed.err, HasSubstr("File too large")) << writing.command;
    }
    EXPECT_EQ(files_made(), 3u);
    for (const char* old : {"made.strata", "report.txt", "out/sound.f0000.exr"})
        EXPECT_EQ(std::filesystem::file_size(folder() / old), 3u) << old;
    EXPECT_THAT(strata("record three_panes -o /dev/full").err, HasSubstr("No space left on device"));
}

TEST(Device, WithoutOneEveryVerbThatNeedsItSaysSoAndTheOthersGoOn) {
    write_sound_capture();
    const std::string none = "export VK_ICD_FILENAMES=/nonexistent VK_DRIVER_FILES=/nonexistent";
    for (const char* verb : {"replay sound.strata", "graph sound.strata", "report sound.strata --sweep pool=2",
                             "accept sound.strata", "probe sound.strata --at 8,4", "bench voxel", "isa sound.strata"}) {
        const Finished failed = strata_after(none, verb);
        EXPECT_EQ(failed.code, 4) << verb << failed.err;
        EXPECT_THAT(failed.err, HasSubstr("Vulkan")) << verb;
    }
    for (const char* verb : {"info sound.strata", "validate sound.strata", "list", "record three_panes -o made.strata"})
        EXPECT_EQ(strata_after(none, verb).code, 0) << verb;
    EXPECT_EQ(strata("validate made.strata").code, 0);
    EXPECT_EQ(strata_after(none, "record three_panes --gpu nvidia -o made.strata").code, 4);  // a device that was asked for
}

/// A driver whose hardware is missing fails where devices are listed.
TEST(Device, WithADriverThatHasNoHardwareThereIsNone) {
    const std::filesystem::path radeon = "/usr/share/vulkan/icd.d/radeon_icd.x86_64.json";
    if (!std::filesystem::exists(radeon) || std::filesystem::exists("/dev/dri")) GTEST_SKIP() << "no driver without its hardware";
    write_sound_capture();
    const std::string without = fmt::format("export VK_ICD_FILENAMES={0} VK_DRIVER_FILES={0}", radeon.string());
    EXPECT_THAT(strata_after(without, "-v replay sound.strata"), Refuses(4, "device.cannot_list"));
}

TEST(Device, ThatLacksAFeatureIsNamedWithIt) {
    write_sound_capture();
    for (const char* feature : {"dynamicRendering", "scalarBlockLayout", "independentBlend", "timelineSemaphore"}) {
        const Finished failed = strata(fmt::format("-v replay sound.strata --without {}", feature));
        EXPECT_THAT(failed, Refuses(4, "device.none_can_replay", fmt::format("the feature {}", feature)));
    }
    EXPECT_THAT(strata("-v replay sound.strata --without independantBlend"),
                Refuses(2, "device.unknown_feature", "suggestion=\"; did you mean independentBlend?\""));
    EXPECT_EQ(files_made(), 0u);
}

TEST(Device, WithoutCapabilitiesBeyondTheBaselineTheFrameIsTheSame) {
    write_sound_capture();
    ASSERT_EQ(strata("replay sound.strata --frames 0 -o with").code, 0);
    std::string options;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(Capability::count_); ++i)
        if (const auto capability = static_cast<Capability>(i); capability != Capability::long_loops)
            options += fmt::format(" --without {}", name(capability));
    const Finished without = strata("replay sound.strata --frames 0 --validation -o without" + options);
    ASSERT_EQ(without.code, 0) << without.err;
    EXPECT_EQ(read_file(folder() / "with/sound.f0000.exr"), read_file(folder() / "without/sound.f0000.exr"));
}

TEST(ShaderCache, ThatIsBrokenChangesNothing) {
    write_sound_capture();
    ASSERT_EQ(strata("replay sound.strata --frames 0 -o good").code, 0);
    std::filesystem::create_directories(folder() / "cache/mesa_shader_cache");
    for (const char* file : {"cache/mesa_shader_cache/index", "cache/mesa_shader_cache/marker", "cache/mesa_shader_cache/00"})
        std::ofstream(folder() / file) << std::string(5000, '\xff');
    for (const char* broken : {"$PWD/cache", "$PWD/sound.strata", "/proc/nowhere"}) {
        const Finished replayed = strata_after(fmt::format("export MESA_SHADER_CACHE_DIR={0} XDG_CACHE_HOME={0}", broken),
                                               "replay sound.strata --frames 0 -o broken");
        EXPECT_EQ(replayed.code, 0) << broken << replayed.err;
        EXPECT_EQ(read_file(folder() / "good/sound.f0000.exr"), read_file(folder() / "broken/sound.f0000.exr")) << broken;
    }
}

TEST(Import, OfABlackPictureWarns) {
    const auto write = [](const char* color) {
        const std::string material = fmt::format(
            R"(,"materials":[{{"doubleSided":true,"pbrMetallicRoughness":{{"baseColorFactor":[{}],"roughnessFactor":1}}}}])",
            color);
        std::ofstream(folder() / "wall.gltf")
            << Gltf().with_triangle().text(showing(R"({"attributes":{"POSITION":0},"material":0})", material));
    };
    const char* verb = "import wall.gltf --size 32x18 --eye 0.2,0.2,0.05 --target 0.2,0.2,0";
    write("0,0,0,1");
    EXPECT_THAT(strata(verb).err, HasSubstr("% of the picture is black"));
    write("0.8,0.8,0.8,1");
    EXPECT_THAT(strata(verb).err, Not(HasSubstr("black")));
}

TEST(Memory, OfFilesIsBoundedByABudget) {
    write_file(folder() / "sound.strata", sound_capture());
    std::ofstream(folder() / "scene.gltf") << Gltf().with_triangle().text(showing(triangle));
    ASSERT_TRUE(write_png(folder() / "black.png", Extent{64, 64, 1}, std::vector<std::byte>(64 * 64 * 3)));
    for (const char* verb :
         {"info sound.strata", "validate sound.strata", "replay sound.strata", "export sound.strata --json -o sound.json",
          "import scene.gltf -o scene.strata", "diff black.png black.png"}) {
        EXPECT_THAT(strata(fmt::format("-v {} --memory-budget 300", verb)), Refuses(4, "memory.budget", "budget=\"300 bytes\""))
            << verb;
        EXPECT_EQ(strata(fmt::format("{} --memory-budget 256MiB", verb)).code, 0) << verb;
    }
    EXPECT_EQ(strata("import scene.gltf -o scene.strata --budget 300").code, 4);
}

}  // namespace
}  // namespace strata
