// Pictures that claim more than the memory budget holds are refused before they are decoded, by number.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "replay/images/image_io.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

using testing::HasSubstr;
constexpr std::uint64_t mib = std::uint64_t{1} << 20;

std::filesystem::path file_named(const std::string& name) { return std::filesystem::path(testing::TempDir()) / name; }

HostImage gray(std::uint32_t edge) {
    HostImage image{{.extent = {edge, edge, 1}, .format = Format::r32f}, {}};
    image.texels.resize(bytes(image.shape));
    return image;
}

TEST(ImageBudget, HoldsAPngAgainstItBeforeItIsDecoded) {
    std::string png(33, '\0');  // a header that claims 16384 x 16384, and nothing behind it
    png.replace(0, 16, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16));
    png.replace(16, 10, std::string("\0\0\x40\0\0\0\x40\0\x08\x06", 10));
    const auto path = file_named("strata_bomb.png");
    std::ofstream(path, std::ios::binary) << png;
    MemoryBudget budget(256 * mib);
    const auto image = read_png(path, budget);
    ASSERT_THAT(image, FailsWith("memory.budget", Field("what", HasSubstr("strata_bomb.png")), Field("size", "3072.0 MiB")));
    EXPECT_EQ(image.error().fault, Fault::device_lacks);
    std::filesystem::remove(path);
}

TEST(ImageBudget, IsSharedByThePartsOfAnExr) {
    const auto path = file_named("strata_parts.exr");
    ASSERT_TRUE(write_exr(path, {{"a", gray(512)}, {"b", gray(512)}, {"c", gray(512)}}, {}));
    MemoryBudget enough(8 * mib), little(5 * mib);
    EXPECT_TRUE(read_exr(path, enough));
    const auto image = read_exr(path, little);
    ASSERT_THAT(image, FailsWith("memory.budget", Field("what", HasSubstr("part 2")), Field("size", "2.0 MiB")));
    EXPECT_EQ(image.error().fault, Fault::device_lacks);
    std::filesystem::remove(path);
}

TEST(ImageBudget, IsSharedByTheFilesThatAreReadWithIt) {
    const auto path = file_named("strata_twice.png");
    ASSERT_TRUE(write_png(path, Extent{512, 512, 1}, std::vector<std::byte>(512 * 512 * 3)));
    MemoryBudget budget(7 * mib / 2);
    EXPECT_TRUE(read_png(path, budget));
    EXPECT_EQ(read_png(path, budget).error().fault, Fault::device_lacks) << "one image is held, decoding takes three";
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace strata
