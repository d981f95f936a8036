// A draw restricted to rows covers all of their samples, and draws in parts make the bits of one draw. lavapipe 22.3 lets the
// lower samples of the row above through, so the shader leaves that row out.
#include <gtest/gtest.h>

#include "passes/shader_interop.h"
#include "tests/support/session.h"
#include "tests/support/test_frame.h"

namespace strata {
namespace {

struct TriangleCommand {
    std::uint32_t index_count = 3, instance_count = 1, first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;
};

/// A tilted triangle over most of 90 x 77 pixels, with values that hang on the place, added to 1.
struct FrameInRows : TestFrame {
    explicit FrameInRows(std::uint32_t samples) {
        shader("place.vert", R"(
            layout(set = 1, binding = 1, scalar) readonly buffer Corners { vec3 corners[]; };
            layout(location = 0) out vec3 out_place;
            void main() {
                out_place = corners[gl_VertexIndex];
                gl_Position = vec4(corners[gl_VertexIndex], 1);
            })");
        shader("place.frag", R"(
            layout(location = 0) sample in vec3 place;
            layout(location = 0) out vec4 out_color;
            layout(push_constant) uniform Push { uint first_row; };
            void main() {
                if (uint(gl_FragCoord.y) < first_row) discard;
                out_color = vec4(place + 3, length(dFdx(place)) + gl_SampleID);
            })");
        list.commands = import_values<TriangleCommand>(graph, "commands", ImportId{1}, {{}});
        list.indices = import_values<std::uint32_t>(graph, "indices", ImportId{2}, {0, 1, 2});
        list.count = 1;
        graph.offer("Corners", import_values<glm::vec3>(graph, "corners", ImportId{3},
                                                        {{-.95, -1.3, .5}, {-.4, 2.9, .25}, {1.2, -.8, .75}}));
        color = graph.create("color", {.extent = {90, height}, .format = Format::rgba32f, .samples = samples});
        graph.clear(color, {{1, 1, 1, 1}});
    }
    void draw(Rows rows) { graph.draw("place", list).adds_to(color).in_rows(rows).push(rows.first); }

    static constexpr std::uint32_t height = 77;
    DrawList list;
    Image color;
};

class DrawInRows : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Samples, DrawInRows, testing::Values(1u, 4u), testing::PrintToStringParamName());

TEST_P(DrawInRows, CoversThemAndLeavesTheOthersAsTheyAre) {
    FrameInRows frame(GetParam());
    frame.draw({34, 9});
    const HostImage result = frame.result(frame.color);
    for (std::uint32_t y = 0; y < FrameInRows::height; ++y)
        for (std::uint32_t s = 0; s < GetParam(); ++s) {
            const bool is_drawn = y >= 34 && y < 43;
            EXPECT_EQ(texel(result, 30, y, s).x != 1, is_drawn) << "row " << y << ", sample " << s;
        }
}

TEST_P(DrawInRows, GivesTheBitsOfOneDrawWhenTheRowsAreDrawnInParts) {
    FrameInRows whole(GetParam());
    whole.draw({0, FrameInRows::height});
    const HostImage wanted = whole.result(whole.color);
    FrameInRows parts(GetParam());
    constexpr std::uint32_t begins[] = {0, 2, 34, 64, 70, 76, FrameInRows::height};
    for (std::size_t i = 0; i + 1 < std::size(begins); ++i) parts.draw({begins[i], begins[i + 1] - begins[i]});
    EXPECT_EQ(parts.result(parts.color).texels, wanted.texels);
}

}  // namespace
}  // namespace strata
