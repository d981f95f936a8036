// How many waves a SIMD holds: the tables that the makers of the GPUs publish, and the cases where a compiler's number is
// rounded.
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "replay/isa/isa_report.h"
#include "replay/isa/occupancy.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

const GpuModel& model(std::string_view name) {
    const auto found = find_gpu_model(name);
    return found ? **found : throw std::runtime_error(found.error().sentence);
}

constexpr ShaderResources gcn_group{.group_threads = 256, .wave_lanes = 64};
constexpr ShaderResources rdna_group{.group_threads = 256, .wave_lanes = 32};

double waves(std::string_view gpu, ShaderResources shader, std::uint32_t registers, std::uint32_t lds_bytes = 0) {
    shader.registers = registers;
    shader.lds_bytes = lds_bytes;
    return occupancy(model(gpu), shader).waves_per_simd;
}

using Pairs = std::initializer_list<std::pair<std::uint32_t, double>>;

TEST(Occupancy, OfGcnByVectorRegisters) {
    for (const auto& [registers, expected] : Pairs{{1, 10},
                                                   {24, 10},
                                                   {25, 9},
                                                   {28, 9},
                                                   {32, 8},
                                                   {36, 7},
                                                   {40, 6},
                                                   {48, 5},
                                                   {64, 4},
                                                   {84, 3},
                                                   {128, 2},
                                                   {129, 1},
                                                   {256, 1}})
        for (const char* gpu : {"bonaire", "ps4", "vega10"})
            EXPECT_EQ(waves(gpu, gcn_group, registers), expected) << gpu << ", " << registers << " registers";
}

TEST(Occupancy, OfGcnByLdsOfAGroupOf256) {
    for (const auto& [bytes, expected] :
         Pairs{{0, 10}, {2048, 10}, {6144, 10}, {6145, 9}, {6656, 9}, {8192, 8}, {16384, 4}, {32768, 2}, {49152, 1}, {65536, 1}})
        EXPECT_EQ(waves("bonaire", gcn_group, 8, bytes), expected) << bytes << " bytes";
}

TEST(Occupancy, TwoKibibytesOfAGroupDoNotLimitGcnToEightWaves) {
    ShaderResources shader = gcn_group;
    shader.lds_bytes = 2048;
    const Occupancy found = occupancy(model("ps4"), shader);
    EXPECT_EQ(found.waves_per_simd, 10);
    EXPECT_EQ(found.limit, OccupancyLimit::wave_slots);
    EXPECT_EQ(found.alone[static_cast<std::size_t>(OccupancyLimit::lds)], 32);
    shader.group_threads = 64;  // charged to every wave the same two are eight
    EXPECT_EQ(occupancy(model("ps4"), shader).waves_per_simd, 8);
    EXPECT_EQ(occupancy(model("ps4"), shader).limit, OccupancyLimit::lds);
}

TEST(Occupancy, OfGcnByScalarRegisters) {
    ShaderResources shader = gcn_group;
    shader.registers = 24;
    shader.scalar_registers = 100;  // 104 of 512, and 112 of 800
    EXPECT_EQ(occupancy(model("bonaire"), shader).waves_per_simd, 4);
    EXPECT_EQ(occupancy(model("bonaire"), shader).limit, OccupancyLimit::scalar_registers);
    EXPECT_EQ(occupancy(model("vega10"), shader).waves_per_simd, 7);
    EXPECT_EQ(occupancy(model("navi10"), {.scalar_registers = 128, .group_threads = 256, .wave_lanes = 64}).limit,
              OccupancyLimit::wave_slots);
}

TEST(Occupancy, OfPolarisEndsAtEightWaves) { EXPECT_EQ(waves("polaris10", gcn_group, 8), 8); }

TEST(Occupancy, OfRdnaByVectorRegisters) {
    EXPECT_EQ(waves("navi10", rdna_group, 48), 20);
    EXPECT_EQ(waves("navi10", rdna_group, 72), 14);  // granules of 8 on RDNA 1
    EXPECT_EQ(waves("navi21", rdna_group, 72), 12);  // of 16 on RDNA 2
    for (const auto& [registers, expected] : Pairs{{64, 16}, {80, 12}, {96, 10}, {128, 8}, {256, 4}})
        EXPECT_EQ(waves("navi21", rdna_group, registers), expected) << registers << " registers";
    for (const auto& [registers, expected] : Pairs{{96, 16}, {128, 10}})
        EXPECT_EQ(waves("gfx1100", rdna_group, registers), expected) << registers << " registers";
}

TEST(Occupancy, AWaveOf64TakesTwiceTheRegistersOfAWaveOf32) {
    for (const std::uint32_t registers : {64u, 72u, 96u, 128u})
        EXPECT_EQ(waves("navi21", gcn_group, registers), std::floor(512. / ((registers + 7) / 8 * 8))) << registers;
    EXPECT_EQ(waves("navi21", gcn_group, 8), 16);  // the slots are the same
}

TEST(Occupancy, OfRdnaIsNeverLimitedByTwoKibibytesAndByMoreThanSixteenOnly) {
    for (const std::uint32_t bytes : {2048u, 16384u}) EXPECT_EQ(waves("navi21", rdna_group, 8, bytes), 16) << bytes;
    EXPECT_EQ(waves("navi21", rdna_group, 8, 16385), 14);  // 17 KiB: 7 groups of 128 KiB
    EXPECT_EQ(waves("navi21", rdna_group, 8, 65536), 4);
    ShaderResources two_waves{.registers = 8, .lds_bytes = 4352, .group_threads = 64, .wave_lanes = 32};
    EXPECT_EQ(occupancy(model("navi21"), two_waves).groups, 25u);  // granules of 1 KiB: 5 of 128
    EXPECT_EQ(occupancy(model("navi10"), two_waves).groups, 28u);  // of 512 bytes: 4.5 of 128
    EXPECT_EQ(waves("navi21", rdna_group, 8, 65537), 0) << "no group may have more than 64 KiB";
}

TEST(Occupancy, OfSm90InWarpsOfAMultiprocessor) {
    for (const auto& [registers, expected] : Pairs{{32, 64}, {40, 48}, {64, 32}, {96, 16}, {128, 16}})
        EXPECT_EQ(4 * waves("h200", rdna_group, registers), expected) << registers << " registers";
    EXPECT_EQ(4 * waves("h200", rdna_group, 16, 56 * 1024), 32);  // 57 KiB with what is reserved: 4 of 228
    ShaderResources one_warp{.group_threads = 32, .wave_lanes = 32};
    EXPECT_EQ(occupancy(model("h200"), one_warp).limit, OccupancyLimit::group_slots);  // 32 blocks
    EXPECT_EQ(occupancy(model("h200"), one_warp).waves_per_simd, 8);
}

/// What RADV of Mesa 22.3 said for bonaire and what is true: threads of a group, registers, LDS.
struct Rounded {
    std::uint32_t threads, registers, lds_bytes;
    double is;
    std::uint32_t stated;
    OccupancyLimit limit;
};

TEST(Occupancy, KeepsGroupsWholeWhereRadvRoundsUp) {
    constexpr Rounded cases[] = {
        {64, 8, 12288, 1.25, 2, OccupancyLimit::lds},  {256, 8, 12288, 5, 6, OccupancyLimit::lds},
        {512, 28, 0, 8, 9, OccupancyLimit::registers}, {1024, 8, 0, 8, 10, OccupancyLimit::wave_slots},
        {256, 8, 49152, 1, 2, OccupancyLimit::lds},    {256, 8, 2048, 10, 10, OccupancyLimit::wave_slots}};
    for (const Rounded& c : cases) {
        const ShaderResources shader{
            .registers = c.registers, .lds_bytes = c.lds_bytes, .group_threads = c.threads, .wave_lanes = 64};
        const Occupancy found = occupancy(model("bonaire"), shader);
        EXPECT_EQ(found.waves_per_simd, c.is) << c.threads << " threads";
        EXPECT_EQ(stated_by_radv(model("bonaire"), shader), c.stated) << c.threads << " threads";
        EXPECT_EQ(found.limit, c.limit) << name(found.limit);
        EXPECT_EQ(found.lost_to_whole_groups > 0, c.lds_bytes == 0) << c.threads << " threads";
    }
}

TEST(Occupancy, FragmentsAndVerticesAreLimitedWaveByWave) {
    const Occupancy found = occupancy(model("bonaire"), {.registers = 40, .lds_bytes = 65536, .wave_lanes = 64});
    EXPECT_EQ(found.waves_per_simd, 6);
    EXPECT_TRUE(std::isinf(found.alone[static_cast<std::size_t>(OccupancyLimit::lds)]));
}

TEST(GpuModels, AreFoundByTheirNamesAndByWhatDevicesCallThemselves) {
    EXPECT_EQ(model("Navi21").name, "navi21");
    EXPECT_EQ(model("navi31").name, "gfx1100");
    EXPECT_EQ(gpu_model_of("AMD Radeon RX 6900 XT (RADV NAVI21)"), &model("navi21"));
    EXPECT_EQ(gpu_model_of("Null hardware (RADV BONAIRE)"), &model("bonaire"));
    EXPECT_EQ(gpu_model_of("NVIDIA H200"), &model("h200"));
    EXPECT_EQ(gpu_model_of("llvmpipe (LLVM 15.0.6, 256 bits)"), nullptr);
    const auto wrong = find_gpu_model("navi12");
    ASSERT_THAT(wrong,
                FailsWith("isa.unknown_gpu_model", Field("model", "navi12"), Field("suggestion", testing::HasSubstr("navi1"))));
    EXPECT_EQ(wrong.error().fault, Fault::usage);
}

TEST(ModeledTime, IsWavesOf64TimesCyclesOverSimdsTimesClock) {
    // 14 units of 4 SIMDs at 1 GHz: one wave each of 1000 cycles is a microsecond.
    EXPECT_DOUBLE_EQ(modeled_ms(model("bonaire"), 14 * 4 * 64, 1000), 1e-3);
    EXPECT_DOUBLE_EQ(modeled_ms(model("ps4"), 1920 * 1080, 500), 1920 * 1080 / 64. * 500 / (18 * 4 * 800e6) * 1e3);
}

}  // namespace
}  // namespace strata
