// Images of a glTF one at a time: what is handed on, what frames keep, and how often an image is decoded.
#include <dlfcn.h>

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture_format/export/png.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/import/gltf.h"
#include "tests/support/errors.h"
#include "tests/support/gltf_text.h"

static int decodings = 0;

/// Stands before stb's own and counts.
extern "C" unsigned char* stbi_load_from_memory(const unsigned char* bytes, int size, int* width, int* height, int* channels,
                                                int wanted) {
    ++decodings;
    using Load = unsigned char*(const unsigned char*, int, int*, int*, int*, int);
    return reinterpret_cast<Load*>(::dlsym(RTLD_NEXT, "stbi_load_from_memory"))(bytes, size, width, height, channels, wanted);
}

namespace strata {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::uint32_t edge = 512;

/// A PNG of one gray, but for a white texel in its corner.
std::string png_of(std::uint8_t gray) {
    std::vector<std::uint8_t> texels(std::size_t{3} * edge * edge, gray);
    texels[0] = texels[1] = texels[2] = 255;
    const auto png = encode_png(edge, edge, 3, std::as_bytes(std::span(texels)));
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

/// A triangle with as many materials as images, each with an emissive texture.
std::string with_images(const std::vector<std::string>& files) {
    std::string images, textures, materials;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const char* comma = i > 0 ? "," : "";
        images += fmt::format(R"({}{{"uri":"data:image/png;base64,{}"}})", comma, base64(files[i]));
        textures += fmt::format(R"({}{{"source":{}}})", comma, i);
        materials += fmt::format(R"({}{{"emissiveTexture":{{"index":{}}}}})", comma, i);
    }
    return Gltf().with_triangle().text(
        showing(triangle, fmt::format(R"(,"images":[{}],"textures":[{}],"materials":[{}])", images, textures, materials)));
}

TEST(GltfTextures, AreTakenWholeAndKeptSmall) {
    const std::string text = with_images({png_of(10), png_of(90)});
    std::vector<Texture> taken;
    GltfOptions options;
    options.take_texture = [&](Texture texture) {
        taken.push_back(std::move(texture));
        return Result<void>();
    };
    const Frame whole = imported(text).frame, small = imported(text, options).frame;
    ASSERT_EQ(taken.size(), 2u);
    ASSERT_EQ(small.textures.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(taken[i].texels, whole.textures[i].texels);
        EXPECT_EQ(taken[i].mips, 10u);
        const Texture& kept = small.textures[i];
        EXPECT_EQ(kept.width, 256u);
        EXPECT_EQ(kept.height, 256u);
        EXPECT_EQ(kept.mips, 9u);
        const auto& all = whole.textures[i].texels;
        EXPECT_EQ(kept.texels, std::vector<std::byte>(all.begin() + 4 * edge * edge, all.end()));
    }
}

TEST(GltfTextures, OneAtATimeIsInMemory) {
    // Whole, three take 24 bytes for each of 3 * 512^2 texels, 18.9 MB; one and the mips that are kept of three, 6.3 + 3 * 2.1.
    const std::string text = with_images({png_of(10), png_of(90), png_of(170)});
    GltfOptions options{.memory_budget = 15'000'000, .take_texture = {}};
    EXPECT_THAT(import_text(text, options), FailsWith("memory.budget", Field("what", "image 2")));
    options.take_texture = [](Texture) { return Result<void>(); };
    EXPECT_TRUE(import_text(text, options));
}

TEST(GltfTextures, WhoDoesNotTakeOneEndsTheImport) {
    GltfOptions options;
    options.take_texture = [](Texture) -> Result<void> { return fail(Fault::bad_input, "disk.full", "the disk is full"); };
    EXPECT_THAT(import_text(with_images({png_of(10)}), options), FailsWith("disk.full"));
}

TEST(GltfTextures, ADamagedImageIsDecodedOnce) {
    std::string damaged = png_of(10);
    const std::size_t data = damaged.find("IDAT");
    ASSERT_NE(data, std::string::npos);
    damaged.replace(data + 8, 8, 8, '\xff');  // within the compressed texels
    decodings = 0;
    const ImportedScene scene = imported(with_images({damaged}));
    EXPECT_EQ(decodings, 1);
    EXPECT_THAT(scene.warnings, Contains(HasSubstr("image 0 is damaged")));
    decodings = 0;
    imported(with_images({png_of(10), png_of(90)}));
    EXPECT_EQ(decodings, 2);
}

}  // namespace
}  // namespace strata
