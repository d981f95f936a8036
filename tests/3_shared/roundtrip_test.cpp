// A struct of C++ and GLSL with a value of its own in every member goes through the device: a shader takes it apart member by
// member, from the second element of an array so that the stride counts too.
#include <gtest/gtest.h>

#include "tests/support/test_frame.h"

namespace strata {
namespace {

template <typename Record>
std::vector<float> members_seen_by_a_shader(const Record& record, std::string_view type, std::string_view members) {
    TestFrame frame;
    const std::string source = fmt::format(R"(
        #include "passes/shaders/scene.shared.h"
        layout(set = 0, binding = 0, scalar) readonly buffer Records {{ {} records[]; }};
        layout(set = 0, binding = 1, scalar) writeonly buffer Seen {{ float seen[]; }};
        uint count = 0;
        void see(float v) {{ seen[count++] = v; }}
        void see(uint v) {{ see(float(v)); }}
        void see(vec2 v) {{ see(v.x); see(v.y); }}
        void see(vec3 v) {{ see(v.x); see(v.y); see(v.z); }}
        void see(vec4 v) {{ see(v.xyz); see(v.w); }}
        void see(mat3 m) {{ see(m[0]); see(m[1]); see(m[2]); }}
        void see(mat4 m) {{ see(m[0]); see(m[1]); see(m[2]); see(m[3]); }}
        void main() {{ {} r = records[1]; {} }})",
                                           type, type, members);
    frame.library.add(glsl("see.comp", source, STRATA_SOURCE_DIR));
    const Buffer records = import_values(frame.graph, "records", ImportId{5}, std::vector<Record>{Record{}, record});
    Buffer seen = frame.graph.create("seen", sizeof(Record));
    frame.graph.clear(seen, 0);
    frame.graph.compute("see.comp").loads("Records", records).stores("Seen", seen).groups({});
    frame.graph.keep(seen);
    return values_of<float>(frame.run().buffers.at(seen.id));
}

TEST(RoundTrip, ALightArrivesMemberByMember) {
    const LightRecord light{.position = {1, 2, 3},
                            .type = 4,
                            .direction = {5, 6, 7},
                            .range = 8,
                            .intensity = {9, 10, 11},
                            .source_radius = 12,
                            .axis_u = {13, 14, 15},
                            .cos_inner = 16,
                            .cos_outer = 17,
                            .tan_half = {18, 19},
                            .half_extent = {20, 21},
                            .texture = 22,
                            .features = 23,
                            .first_blocker = 24,
                            .blockers = 25,
                            .first_portal = 26,
                            .portals = 27,
                            .first_clip = 28,
                            .clips = 29,
                            .shadow = 30,
                            .shadow_slots = 31,
                            .visibility_layer = 32,
                            .window = 33};
    const auto seen =
        members_seen_by_a_shader(light, "LightRecord",
                                 "see(r.position); see(r.type); see(r.direction); see(r.range); see(r.intensity);"
                                 "see(r.source_radius); see(r.axis_u); see(r.cos_inner); see(r.cos_outer);"
                                 "see(r.tan_half); see(r.half_extent); see(r.texture); see(r.features);"
                                 "see(r.first_blocker); see(r.blockers); see(r.first_portal); see(r.portals);"
                                 "see(r.first_clip); see(r.clips); see(r.shadow); see(r.shadow_slots); see(r.visibility_layer);"
                                 "see(r.window);");
    ASSERT_EQ(seen.size(), 33u);
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<float>(i + 1)) << "member " << i;
}

TEST(RoundTrip, ADrawArrivesWithItsMatrices) {
    DrawRecord draw{};
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 4; ++i) draw.to_view[column][i] = static_cast<float>(4 * column + i + 1);
    for (int column = 0; column < 3; ++column)
        for (int i = 0; i < 3; ++i) draw.normal_to_view[column][i] = static_cast<float>(3 * column + i + 17);
    draw.material = 26;
    draw.soft_fade = 27;
    draw.layer = 28;
    draw.bound_center = {29, 30, 31};
    draw.bound_radius = 32;
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 4; ++i) draw.motion[column][i] = static_cast<float>(4 * column + i + 33);
    draw.first_index = 49;
    draw.vertex_offset = 50;
    draw.normals = 51;
    draw.tangents = 52;
    draw.uv0 = 53;
    draw.uv1 = 54;
    draw.colors = 55;
    draw.first_particle = 56;
    const auto seen =
        members_seen_by_a_shader(draw, "DrawRecord",
                                 "see(r.to_view); see(r.normal_to_view); see(r.material);"
                                 "see(r.soft_fade); see(r.layer); see(r.bound_center); see(r.bound_radius); see(r.motion);"
                                 "see(r.first_index); see(r.vertex_offset); see(r.normals); see(r.tangents); see(r.uv0);"
                                 "see(r.uv1); see(r.colors); see(r.first_particle);");
    ASSERT_EQ(seen.size(), 56u);
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i], static_cast<float>(i + 1)) << "member " << i;
}

}  // namespace
}  // namespace strata
