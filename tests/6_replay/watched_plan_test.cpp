// What is made and read, against counts by hand: shaders written here read and write texels and words that are easily counted.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "passes/graph/watch/watched_plan.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {

void PrintTo(const ProductUse& use, std::ostream* out) {
    *out << use.name << ": made " << use.made << ", read " << use.read << " of " << use.units;
}

namespace {

using testing::IsEmpty;

/// Writes all of an image or a buffer of 64 words.
constexpr const char* fill_image = R"(
    layout(local_size_x = 8, local_size_y = 8) in;
    layout(set = 0, binding = 0, r32f) writeonly uniform image2DArray target;
    void main() {
        const ivec3 at = ivec3(gl_GlobalInvocationID);
        if (all(lessThan(at, imageSize(target)))) imageStore(target, at, vec4(1));
    })";

struct WatchedFrame : TestFrame {
    WatchedFrame() {
        shader("fill.comp", fill_image);
        enter("maker");
    }
    void enter(const std::string& technique) { graph.enter({ScopeKind::pass, Stage::lighting, Stage::lighting, technique}); }
    Image filled(const std::string& name, Shape shape) {
        Image image = graph.create(name, shape);
        graph.compute("fill.comp").stores("target", image).over({shape.extent.width, shape.extent.height, shape.layers});
        return image;
    }
    /// A step of another technique that reads it, with a result that the frame keeps.
    ComputeStep reader(const std::string& source) {
        enter("reader");
        shader("read.comp",
               "layout(local_size_x = 8, local_size_y = 8) in;\n"
               "layout(set = 1, binding = 7, scalar) writeonly buffer Sink { float sink[]; };\n" +
                   source);
        Buffer sink = graph.create("sink", 4096);
        ComputeStep step = graph.compute("read.comp").stores("Sink", sink);
        graph.keep(sink);
        return step;
    }
    std::vector<ProductUse> all_uses() const {
        const WatchedPlan watched = must(WatchedPlan::of(plan()));
        for (const auto& [id, bytes] : watched.uploads()) shared_executor().upload(id, bytes);
        const Execution done = shared_executor().run(watched.plan(), {});
        for (const auto& [id, bytes] : watched.uploads()) shared_executor().forget(id);
        const auto marks = done.buffers.find(watched.marks().id);
        return watched.uses(marks == done.buffers.end() ? std::span<const std::byte>() : marks->second);
    }
    ProductUse use_of(const std::string& name) const {
        for (const ProductUse& use : all_uses())
            if (use.name == name) return use;
        throw std::runtime_error("no product " + name);
    }
};

constexpr Shape board{.extent = {8, 6}, .format = Format::r32f};

TEST(WatchedPlan, CountsTexelsThatAreFetched) {
    WatchedFrame frame;
    const Image image = frame.filled("board", board);
    frame
        .reader(R"(
        layout(set = 0, binding = 0) uniform sampler2DArray board;
        void main() {
            const ivec2 at = ivec2(gl_GlobalInvocationID.xy);
            if ((at.x + at.y) % 2 == 0) sink[at.x + 8 * at.y] = texelFetch(board, ivec3(at, 0), 0).r;
        })")
        .samples("board", image)
        .over({8, 6});
    const ProductUse use = frame.use_of("board");
    EXPECT_EQ(use.made, 48u);
    EXPECT_EQ(use.read, 24u);
    EXPECT_EQ(use.unit_bytes, 4u);
    EXPECT_TRUE(use.is_image);
    EXPECT_EQ(use.readers.size(), 1u);
}

TEST(WatchedPlan, CountsNoTexelBesideTheImage) {
    WatchedFrame frame;
    const Image image = frame.filled("board", board);
    frame
        .reader(R"(
        layout(set = 0, binding = 0, r32f) readonly uniform image2DArray board;
        void main() { sink[0] = imageLoad(board, ivec3(-1, 2, 0)).r + imageLoad(board, ivec3(8, 2, 0)).r +
                                imageLoad(board, ivec3(7, 5, 0)).r; })")
        .loads("board", image)
        .groups({});
    EXPECT_EQ(frame.use_of("board").read, 1u);
}

TEST(WatchedPlan, TellsLayersApartThroughViewsOfOne) {
    WatchedFrame frame;
    Shape shape = board;
    shape.layers = 4;
    const Image image = frame.filled("board", shape);
    frame
        .reader(R"(
        layout(set = 0, binding = 0) uniform sampler2D one;
        layout(set = 0, binding = 1) uniform sampler2DArray all;
        void main() {
            sink[0] = texelFetch(one, ivec2(1, 1), 0).r + texelFetch(all, ivec3(1, 1, 3), 0).r +
                      texelFetch(all, ivec3(1, 1, 2), 0).r;
        })")
        .samples("one", image, Filter::nearest, {.layer = 2})
        .samples("all", image)
        .groups({});
    EXPECT_EQ(frame.use_of("board").made, 4 * 48u);
    EXPECT_EQ(frame.use_of("board").read, 2u);
}

struct Footprint {
    const char* name;
    const char* read;
    Filter filter;
    std::uint64_t texels;
};
void PrintTo(const Footprint& footprint, std::ostream* out) { *out << footprint.name; }

class Footprints : public testing::TestWithParam<Footprint> {};

TEST_P(Footprints, AreTheTexelsThatASamplerWeighs) {
    WatchedFrame frame;
    const Image image = frame.filled("board", {.extent = {8, 8}, .format = Format::r32f});
    frame
        .reader(fmt::format(R"(
        layout(set = 0, binding = 0) uniform sampler2D board;
        void main() {{ sink[0] = {}; }})",
                            GetParam().read))
        .samples("board", image, GetParam().filter)
        .groups({});
    EXPECT_EQ(frame.use_of("board").read, GetParam().texels);
}

INSTANTIATE_TEST_SUITE_P(OfSamplers, Footprints,
                         testing::Values(Footprint{"linear", "textureLod(board, vec2(3, 5) / 8, 0.0).r", Filter::linear, 4},
                                         Footprint{"nearest", "textureLod(board, vec2(3.4, 5.6) / 8, 0.0).r", Filter::nearest, 1},
                                         Footprint{"corner", "textureLod(board, vec2(0), 0.0).r", Filter::linear, 1},
                                         Footprint{"far_edge", "textureLod(board, vec2(7.9, 4) / 8, 0.0).r", Filter::linear, 2},
                                         Footprint{"beyond", "textureLod(board, vec2(9e9, -9e9), 0.0).r", Filter::linear, 1},
                                         Footprint{"gather", "dot(textureGather(board, vec2(4, 2) / 8), vec4(1))",
                                                   Filter::nearest, 4}),
                         [](const auto& named) { return std::string(named.param.name); });

TEST(WatchedPlan, CountsAnImageThatAFunctionIsGiven) {
    WatchedFrame frame;
    const Image read = frame.filled("read", board), other = frame.filled("other", board);
    frame
        .reader(R"(
        layout(set = 0, binding = 0) uniform sampler2DArray first;
        layout(set = 0, binding = 1) uniform sampler2DArray second;
        float at(sampler2DArray image, int x) { return texelFetch(image, ivec3(x, 0, 0), 0).r; }
        float twice(sampler2DArray image) { return at(image, 0) + at(image, 1); }
        void main() { sink[0] = twice(first); if (sink.length() == 0) sink[1] = texelFetch(second, ivec3(0), 0).r; })")
        .samples("first", read)
        .samples("second", other)
        .groups({});
    EXPECT_EQ(frame.use_of("read").read, 2u);
    EXPECT_EQ(frame.use_of("other").read, 0u);
}

constexpr const char* items = R"(
    struct Item { vec3 place; float size; mat3 turn; uvec2 pairs[2]; };  // 17 words
    layout(set = 0, binding = 0, scalar) ACCESS buffer Items { uint count; Item items[]; };
)";
std::string with_items(std::string_view access, std::string_view rest) {
    std::string source = items;
    source.replace(source.find("ACCESS"), 6, access);
    return source + std::string(rest);
}

struct Words {
    const char* name;
    const char* read;
    std::uint64_t words;
};
void PrintTo(const Words& words, std::ostream* out) { *out << words.name; }

class PartsOfBlocks : public testing::TestWithParam<Words> {};

TEST_P(PartsOfBlocks, AreCountedByWord) {
    WatchedFrame frame;
    frame.shader("write.comp", "layout(local_size_x = 1) in;\n" + with_items("writeonly", R"(
        void main() {
            count = 3;
            for (int i = 0; i < 8; ++i) items[i] = Item(vec3(1), 2, mat3(1), uvec2[2](uvec2(1), uvec2(2)));
        })"));
    Buffer buffer = frame.graph.create("items", 4 + 8 * 68 + 40);
    frame.graph.compute("write.comp").stores("Items", buffer).groups({});
    frame.reader(with_items("readonly", fmt::format("void main() {{ sink[0] = float({}); }}", GetParam().read)))
        .loads("Items", buffer)
        .groups({});
    const ProductUse use = frame.use_of("items");
    EXPECT_EQ(use.units, 1 + 8 * 17 + 10u);
    EXPECT_EQ(use.made, 1 + 8 * 17u);
    EXPECT_EQ(use.read, GetParam().words);
}

INSTANTIATE_TEST_SUITE_P(Of, PartsOfBlocks,
                         testing::Values(Words{"scalar", "count", 1}, Words{"component", "items[5].turn[1].y", 1},
                                         Words{"column", "dot(items[count].turn[2], vec3(1))", 4},
                                         Words{"pair", "items[2].pairs[count - 2].x + items[2].pairs[count - 2].y", 3},
                                         Words{"matrix", "determinant(items[0].turn)", 9},
                                         Words{"same_twice", "items[1].size * items[1].size", 1}),
                         [](const auto& named) { return std::string(named.param.name); });

TEST(WatchedPlan, CountsPartsThatAreWritten) {
    WatchedFrame frame;
    frame.shader("sparse.comp", R"(
        layout(local_size_x = 8, local_size_y = 8) in;
        layout(set = 0, binding = 0, scalar) buffer Words { uint words[]; };
        void main() {
            const uint i = gl_LocalInvocationIndex;
            if (i % 4 == 0) atomicAdd(words[i], 1u);
            if (i == 1) words[63] = 5;
        })");
    Buffer words = frame.graph.create("words", 256);
    frame.graph.clear(words, 0);
    frame.graph.compute("sparse.comp").updates("Words", words).groups({});
    frame
        .reader(
            "layout(set = 0, binding = 0, scalar) readonly buffer Words { uint words[]; };\n"
            "void main() { sink[0] = float(words[gl_LocalInvocationIndex]); }")
        .loads("Words", words)
        .groups({});
    const ProductUse use = frame.use_of("words");
    EXPECT_EQ(use.made, 17u);
    EXPECT_EQ(use.read, 17u);
}

TEST(WatchedPlan, TakesSumsOfTheMakerForNoReading) {
    WatchedFrame frame;
    frame.shader("sum.comp", R"(
        layout(set = 0, binding = 0, scalar) buffer Words { uint words[]; };
        void main() { words[0] = words[0] + 1u; })");
    Buffer words = frame.graph.create("words", 16);
    frame.graph.clear(words, 0);
    for (int step = 0; step < 2; ++step) frame.graph.compute("sum.comp").updates("Words", words).groups({});
    Buffer later = words;
    frame.graph.keep(words);
    EXPECT_EQ(frame.use_of("words").read, 0u);
    frame.enter("another");
    frame.graph.compute("sum.comp").updates("Words", later).groups({});
    frame.graph.keep(later);
    EXPECT_EQ(frame.use_of("words").read, 1u);
}

/// Two triangles that cover the left half of the target, at depth .25, and one that covers all, at .5.
struct WatchedDraws : WatchedFrame {
    WatchedDraws() {
        shader("pull.vert", R"(
            layout(set = 1, binding = 1, scalar) readonly buffer Corners { vec3 corners[]; };
            void main() { gl_Position = vec4(corners[gl_VertexIndex], 1); })");
        const std::vector<glm::vec3> corners = {{-1, -1, 0.25}, {-1, 3, 0.25}, {0, -1, 0.25}, {0, -1, 0.25}, {-1, 3, 0.25},
                                                {0, 3, 0.25},   {-1, -1, 0.5}, {-1, 3, 0.5},  {3, -1, 0.5}};
        graph.offer("Corners", import_values(graph, "corners", ImportId{3}, corners));
        indices = import_values<std::uint32_t>(graph, "indices", ImportId{2}, {0, 1, 2, 3, 4, 5, 6, 7, 8});
        left = list("left", 1, {6, 1, 0, 0, 0});
        all = list("all", 4, {3, 1, 6, 0, 0});
    }
    DrawList list(const char* name, std::uint64_t id, const std::vector<std::uint32_t>& command) {
        return {.commands = import_values(graph, name, ImportId{id}, command), .indices = indices, .count = 1};
    }
    Buffer indices;
    DrawList left, all;
};

TEST(WatchedPlan, CountsPixelsThatADrawCovers) {
    WatchedDraws frame;
    frame.shader("pull.frag", R"(
        layout(location = 0) out vec4 color;
        void main() { if (gl_FragCoord.y < 2) discard; color = vec4(1); })");
    Image target = frame.graph.create("target", {.extent = {16, 8}, .format = Format::rgba8_unorm});
    frame.graph.clear(target, {});
    frame.graph.draw("pull", frame.left).covers(target);
    frame.graph.keep(target);
    const ProductUse use = frame.use_of("target");
    EXPECT_EQ(use.made, 8 * 6u);
    EXPECT_EQ(use.read, use.made);
    EXPECT_TRUE(use.is_picture);
    EXPECT_THAT(use.readers, IsEmpty());
}

TEST(WatchedPlan, HasHiddenFragmentsReadNothing) {
    WatchedDraws frame;
    const Image board_image = frame.filled("board", {.extent = {16, 8}, .format = Format::r32f});
    frame.shader("pull.frag", "void main() {}");
    frame.shader("reading.vert", R"(
        layout(set = 1, binding = 1, scalar) readonly buffer Corners { vec3 corners[]; };
        void main() { gl_Position = vec4(corners[gl_VertexIndex], 1); })");
    frame.shader("reading.frag", R"(
        layout(set = 0, binding = 0) uniform sampler2DArray board;
        layout(location = 0) out vec4 color;
        void main() { color = texelFetch(board, ivec3(gl_FragCoord.xy, 0), 0); })");
    Image depth = frame.graph.create("depth", {.extent = {16, 8}, .format = Format::d32f});
    Image target = frame.graph.create("target", {.extent = {16, 8}, .format = Format::rgba8_unorm});
    frame.graph.clear(depth, {});
    frame.graph.clear(target, {});
    frame.graph.draw("pull", frame.all).writes_depth(depth).within({16, 3});
    frame.enter("reader");
    frame.graph.draw("reading", frame.left).tests_depth(depth).covers(target).samples("board", board_image);
    frame.graph.keep(target);
    EXPECT_EQ(frame.use_of("depth").made, 16 * 3u);
    EXPECT_EQ(frame.use_of("board").read, 8 * 5u);
    EXPECT_EQ(frame.use_of("target").made, 8 * 5u);
}

TEST(WatchedPlan, TakesArgumentsAndCopiesForReadAllOver) {
    WatchedFrame frame;
    frame.shader("arguments.comp", R"(
        layout(set = 0, binding = 0, scalar) writeonly buffer Arguments { uvec3 groups; };
        void main() { groups = uvec3(1); })");
    Buffer arguments = frame.graph.create("arguments", 12), copied = frame.graph.create("copied", 12);
    frame.graph.compute("arguments.comp").stores("Arguments", arguments).groups({});
    frame.graph.copy(arguments, copied);
    frame.graph.keep(copied);
    frame.reader("void main() { sink[0] = 1; }").indirect(arguments);
    EXPECT_EQ(frame.use_of("arguments").made, 3u);
    EXPECT_EQ(frame.use_of("arguments").read, 3u);
    EXPECT_EQ(frame.use_of("copied").made, 3u);
}

TEST(WatchedPlan, NeedsNoMarksWhereNothingIsMade) {
    WatchedFrame frame;
    Image image = frame.graph.create("cleared", board);
    frame.graph.clear(image, {});
    frame.graph.keep(image);
    EXPECT_THAT(frame.all_uses(), IsEmpty());
}

TEST(WatchedPlan, FailsWhereADeviceChoosesWhatIsRead) {
    WatchedDraws frame;
    const Image image = frame.filled("board", board);
    frame.shader("pull.frag", R"(
        layout(set = 0, binding = 0) uniform sampler2D board;
        layout(location = 0) out vec4 color;
        void main() { color = texture(board, gl_FragCoord.xy / 16); })");
    Image target = frame.graph.create("target", {.extent = {16, 8}, .format = Format::rgba8_unorm});
    frame.graph.clear(target, {});
    frame.enter("reader");
    frame.graph.draw("pull", frame.left).covers(target).samples("board", image);
    frame.graph.keep(target);
    const auto watched = WatchedPlan::of(frame.plan());
    ASSERT_FALSE(watched);
    EXPECT_EQ(watched.error().id, "shader.cannot_be_watched");
    EXPECT_THAT(watched.error().sentence, testing::HasSubstr("pull.frag"));
}

}  // namespace
}  // namespace strata
