// Deep images that are damaged or lie about themselves: refused with a sentence, and nothing allocated on their word.
#include <cstring>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/import/deep.h"
#include "tests/1_capture/temporary_file.h"
#include "tests/support/deep_exr.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

Result<ImportedDeep> imported_deep_text(std::string_view file, const DeepOptions& options = {}) {
    return import_deep(bytes_of(file), "test.exr", options);
}

std::string small_image(DeepLayout layout, DeepPacking packing) {
    DeepSource source{.width = 6, .height = 5, .layout = layout, .packing = packing};
    source.pixels.assign(30, {{.5f, .5f, .5f, .5f, 3}, {.5f, .5f, .5f, .5f, 4}});
    return deep_file(source);
}

/// Where the first block of an image of so many lines begins: behind the table of their offsets.
std::size_t first_block(const std::string& file, std::size_t lines) {
    std::uint64_t offset = 0;
    for (std::size_t at = 8; at + 8 <= file.size(); ++at) {
        std::memcpy(&offset, file.data() + at, 8);
        if (offset == at + 8 * lines) return offset;
    }
    return 0;
}

TEST(DeepImportOfDamage, RefusesWhatIsNoDeepImage) {
    EXPECT_THAT(imported_deep_text(""), FailsWith("import.deep.not_openexr", Field("file", "test.exr")));
    EXPECT_THAT(imported_deep_text("this is no picture at all, whatever its name says"), FailsWith("import.deep.not_openexr"));
    EXPECT_THAT(imported_deep_text(flat_file(4, 4)), FailsWith("import.deep.no_deep_part"));
}

TEST(DeepImportOfDamage, RefusesAnImageWithoutDepth) {
    DeepSource source{.channels = {"A", "left.Z"}};
    source.pixels = {{{1, 2}}};
    EXPECT_THAT(imported_deep_text(deep_file(source)), FailsWith("import.deep.no_depth", Field("channels", "A left.Z")));
}

TEST(DeepImportOfDamage, RefusesAFileCutShortWhereverItIsCut) {
    for (const DeepLayout layout : {DeepLayout::lines, DeepLayout::tiles}) {
        const std::string whole = small_image(layout, DeepPacking::zips);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const auto result = imported_deep_text(std::string_view(whole).substr(0, size));
            ASSERT_FALSE(result) << size << " of " << whole.size() << " bytes";
            EXPECT_EQ(result.error().fault, Fault::bad_input);
        }
    }
}

TEST(DeepImportOfDamage, SurvivesEveryByteOverwritten) {
    for (const DeepPacking packing : {DeepPacking::none, DeepPacking::rle, DeepPacking::zips}) {
        const std::string whole = small_image(DeepLayout::lines, packing);
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const char byte : {'\0', '\x7f', '\xff'}) {
                std::string damaged = whole;
                damaged[at] = byte;
                const auto result = imported_deep_text(damaged, {.most_samples = 10000});
                if (!result) {
                    EXPECT_THAT(result.error(), HasField("file", "test.exr"));
                }
            }
    }
}

TEST(DeepImportOfDamage, RefusesMoreSamplesThanItMayRead) {
    const auto result = imported_deep_text(small_image(DeepLayout::lines, DeepPacking::zips), {.most_samples = 59});
    EXPECT_THAT(result, FailsWith("import.deep.too_many_samples", Field("samples", 60), Field("most", 59)));
}

TEST(DeepImportOfDamage, RefusesCountsThatTheBlockCannotHold) {
    std::string file = small_image(DeepLayout::lines, DeepPacking::none);
    const std::size_t block = first_block(file, 5);
    ASSERT_NE(block, 0u);
    // Line, bytes of the table, bytes of the samples packed and unpacked, then running sums: 2, 4, ... 12.
    const std::uint32_t many = 0x01000000;
    std::memcpy(file.data() + block + 28 + 5 * 4, &many, 4);
    EXPECT_THAT(imported_deep_text(file), FailsWith("import.deep.claimed_bytes", Field("samples", 16777216),
                                                    Field("sample_bytes", 20), Field("bytes", 240)));
    const std::uint64_t claim = std::uint64_t{many} * 20;
    std::memcpy(file.data() + block + 20, &claim, 8);
    EXPECT_THAT(imported_deep_text(file), FailsWith("import.deep.too_many_samples", Field("samples", 16777264)));
    EXPECT_THAT(imported_deep_text(file, {.most_samples = std::uint64_t{1} << 40}),
                FailsWith("import.deep.expansion", Field("bytes", 335544320), Field("packed_bytes", 240)));
}

TEST(DeepImportOfDamage, RefusesVolumesThatOverlapTooOften) {
    DeepSource source{.channels = {"A", "Z", "ZBack"}};
    auto& pixel = source.pixels.emplace_back();
    for (int i = 0; i < 40000; ++i) pixel.push_back({.001f, 1 + float(i), 1e9f});
    EXPECT_THAT(imported_deep_text(deep_file(source)), FailsWith("import.deep.overlap"));
}

}  // namespace
}  // namespace strata
