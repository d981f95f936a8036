// What check_frame() refuses, by which id, and what it lets through.
#include <functional>
#include <limits>

#include <gmock/gmock.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/frame/texture.h"
#include "capture_format/frame/weather.h"
#include "capture_format/reader.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// One thing done to a good frame and the error about it.
struct Wrong {
    FailsWithMatcher refused;
    std::function<void(Frame&)> make;
};

void expect_refused(std::initializer_list<Wrong> wrongs) {
    for (const Wrong& wrong : wrongs) {
        Frame frame = rich_frame();
        wrong.make(frame);
        EXPECT_THAT(check_frame(frame), wrong.refused);
    }
}

TEST(FrameCheck, GoodFramesPass) {
    for (const Frame& frame : {triangle_frame(), rich_frame()}) {
        const auto checked = check_frame(frame);
        EXPECT_TRUE(checked) << checked.error().sentence;
    }
}

TEST(FrameCheck, NaNInColorsAlphasAndDepthOffsetsIsForTheStagesToSurvive) {
    Frame frame = rich_frame();
    for (Particle& particle : frame.emitters[0].particles) {
        particle.color = particle.emissive = glm::vec3(nan);
        particle.alpha = particle.depth_offset = -infinity;
    }
    frame.meshes[1].colors.assign(3, glm::vec4(nan));
    frame.meshes[1].normals.assign(3, glm::vec3(nan));
    EXPECT_TRUE(check_frame(frame));
}

TEST(FrameCheck, IndicesPointIntoTheirLists) {  // each is the first that does not
    expect_refused({
        {FailsWith("frame.index_range", Field("list", "mesh"), Field("index", 2), Field("count", 2), Field("subject", "draw"),
                   Field("number", 1), Field("name", "pane")),
         [](Frame& f) { f.draws[1].mesh = 2; }},
        {FailsWith("frame.index_range", Field("list", "material"), Field("index", 2), Field("count", 2), Field("subject", "draw"),
                   Field("number", 1), Field("name", "pane")),
         [](Frame& f) { f.draws[1].material = 2; }},
        {FailsWith("frame.index_range", Field("list", "texture"), Field("index", 2), Field("count", 2),
                   Field("subject", "material"), Field("number", 1), Field("name", "glass")),
         [](Frame& f) { f.materials[1].base_color_texture.texture = 2; }},
        {FailsWith("frame.index_range", Field("list", "texture"), Field("index", 2), Field("count", 2),
                   Field("subject", "emitter"), Field("number", 0), Field("name", "smoke")),
         [](Frame& f) { f.emitters[0].texture = 2; }},
        {FailsWith("frame.index_range", Field("list", "texture"), Field("index", 2), Field("count", 2), Field("subject", "light"),
                   Field("number", 0), Field("name", "spot")),
         [](Frame& f) { f.lights[0].texture = 2; }},
        {FailsWith("frame.index_range", Field("list", "blocker"), Field("index", 1), Field("count", 1), Field("subject", "light"),
                   Field("number", 0), Field("name", "spot")),
         [](Frame& f) { f.lights[0].blockers = {1}; }},
        {FailsWith("frame.index_range", Field("list", "portal"), Field("index", 1), Field("count", 1), Field("subject", "light"),
                   Field("number", 0), Field("name", "spot")),
         [](Frame& f) { f.lights[0].portals = {1}; }},
        {FailsWith("frame.index_range", Field("list", "blocker"), Field("index", 1), Field("count", 1),
                   Field("subject", "portal"), Field("number", 0)),
         [](Frame& f) { f.portals[0].blocker = 1; }},
        {FailsWith("frame.vertex_range", Field("index", 2), Field("vertex", 3), Field("vertices", 3), Field("subject", "mesh"),
                   Field("name", "triangle")),
         [](Frame& f) { f.meshes[1].indices[2] = 3; }},
    });
}

TEST(FrameCheck, StreamsAndTexelsHaveTheirLengths) {
    expect_refused({
        {FailsWith("frame.stream_length", Field("stream", "normals"), Field("positions", 3), Field("length", 2)),
         [](Frame& f) { f.meshes[1].normals.pop_back(); }},
        {FailsWith("frame.stream_length", Field("stream", "uv1"), Field("length", 9)),
         [](Frame& f) { f.meshes[1].uv1.resize(9); }},
        {FailsWith("frame.whole_triangles", Field("indices", 2)), [](Frame& f) { f.meshes[1].indices.pop_back(); }},
        {FailsWith("frame.texel_bytes", Field("needed_bytes", 20), Field("bytes", 19)),
         [](Frame& f) { f.textures[0].texels.pop_back(); }},
        {FailsWith("frame.range", Field("property", "number of mips"), Field("most", 2), Field("value", 3)),
         [](Frame& f) { f.textures[0].mips = 3; }},
        {FailsWith("frame.extent", Field("most", 16384), Field("width", 0), Field("height", 2), Field("subject", "texture")),
         [](Frame& f) { f.textures[0].width = 0; }},
        {FailsWith("frame.uv_set_missing", Field("uv_set", 1), Field("mesh", "triangle")),
         [](Frame& f) { f.meshes[1].uv1.clear(); }},
        {FailsWith("frame.range", Field("property", "uv set"), Field("value", 2)),
         [](Frame& f) { f.materials[1].base_color_texture.uv_set = 2; }},
        {FailsWith("frame.name_too_long", Field("bytes", 256), Field("most", 255)),
         [](Frame& f) { f.draws[0].name.assign(256, 'x'); }},
        {FailsWith("frame.too_many", Field("list", "clip planes"), Field("count", 7), Field("most", 6)),
         [](Frame& f) { f.lights[0].clip_planes.resize(7); }},
        {FailsWith("frame.too_many", Field("list", "blockers"), Field("count", 33), Field("most", 32)),
         [](Frame& f) { f.lights[0].blockers.assign(33, 0); }},
        {FailsWith("frame.too_many", Field("list", "portals"), Field("count", 33), Field("most", 32)),
         [](Frame& f) { f.lights[0].portals.assign(33, 0); }},
    });
}

TEST(FrameCheck, EnumsAreOnesWeKnow) {
    expect_refused({
        {FailsWith("frame.unknown_value", Field("property", "texture format"), Field("value", 4)),
         [](Frame& f) { f.textures[0].format = TextureFormat{4}; }},
        {FailsWith("frame.unknown_value", Field("property", "address mode"), Field("value", 9)),
         [](Frame& f) { f.textures[0].address = AddressMode{9}; }},
        {FailsWith("frame.unknown_value", Field("property", "magnification filter"), Field("value", 2)),
         [](Frame& f) { f.textures[0].magnify = TexelFilter{2}; }},
        {FailsWith("frame.unknown_value", Field("property", "minification filter"), Field("value", 2)),
         [](Frame& f) { f.textures[0].minify = TexelFilter{2}; }},
        {FailsWith("frame.unknown_value", Field("property", "filter between mips"), Field("value", 3)),
         [](Frame& f) { f.textures[0].between_mips = MipFilter{3}; }},
        {FailsWith("frame.unknown_value", Field("property", "lighting model"), Field("value", 9)),
         [](Frame& f) { f.materials[0].lighting_model = LightingModel{9}; }},
        {FailsWith("frame.unknown_value", Field("property", "alpha mode"), Field("value", 5)),
         [](Frame& f) { f.materials[0].alpha_mode = AlphaMode{5}; }},
        {FailsWith("frame.particle_alpha_mode", Field("alpha_mode", 1)),
         [](Frame& f) { f.emitters[0].alpha_mode = AlphaMode::mask; }},
        {FailsWith("frame.unknown_value", Field("property", "mobility"), Field("value", 2)),
         [](Frame& f) { f.draws[0].mobility = Mobility{2}; }},
        {FailsWith("frame.unknown_value", Field("property", "light type"), Field("value", 8)),
         [](Frame& f) { f.lights[0].type = LightType{8}; }},
        {FailsWith("frame.unknown_value", Field("property", "range window"), Field("value", 2)),
         [](Frame& f) { f.lights[0].window = RangeWindow{2}; }},
        {FailsWith("frame.unknown_value", Field("property", "volume occlusion"), Field("value", 3)),
         [](Frame& f) { f.light_volumes[0].occlusion = VolumeOcclusion{3}; }},
    });
}

TEST(FrameCheck, TheViewIsOneThatCanBeDrawn) {
    expect_refused({
        {FailsWith("frame.extent", Field("most", 16384), Field("width", 0), Field("height", 9), Field("subject", "view")),
         [](Frame& f) { f.view.width = 0; }},
        {FailsWith("frame.samples", Field("samples", 2)), [](Frame& f) { f.view.samples = 2; }},
        {FailsWith("frame.not_finite", Field("property", "origin"), Field("subject", "view")),
         [](Frame& f) { f.view.origin.x = nan; }},
        {FailsWith("frame.not_rotation"), [](Frame& f) { f.view.to_view[0] *= 2; }},
        {FailsWith("frame.not_rotation"), [](Frame& f) { f.view.to_view[1] = f.view.to_view[0]; }},
        {FailsWith("frame.not_finite", Field("property", "a number"), Field("part", "projection column"),
                   Field("part_number", 1)),
         [](Frame& f) { f.view.projection[1][1] = infinity; }},
        {FailsWith("frame.projection_form"), [](Frame& f) { f.view.projection[2][2] = -1; }},
        {FailsWith("frame.projection_flip"), [](Frame& f) { f.view.projection[1][1] *= -1; }},
        {FailsWith("frame.near_planes"), [](Frame& f) { f.view.near = .2f; }},
        {FailsWith("frame.range", Field("property", "exposure")), [](Frame& f) { f.view.exposure = 1e-45f; }},
        {FailsWith("frame.range", Field("property", "film's white")), [](Frame& f) { f.film.white = 1e-38f; }},
    });
}

TEST(FrameCheck, FloatsThatWouldBreakAReplayAreRefused) {
    expect_refused({
        {FailsWith("frame.not_finite", Field("property", "a position")), [](Frame& f) { f.meshes[0].positions[1].y = nan; }},
        {FailsWith("frame.uv_range"), [](Frame& f) { f.meshes[1].uv0[0].x = infinity; }},
        {FailsWith("frame.not_affine", Field("property", "to_world")), [](Frame& f) { f.draws[0].to_world[3][0] = nan; }},
        {FailsWith("frame.not_affine", Field("property", "to_world")), [](Frame& f) { f.draws[0].to_world[0][3] = 1; }},
        {FailsWith("frame.range", Field("property", "roughness"), Field("value", 1.5)),
         [](Frame& f) { f.materials[0].roughness = 1.5f; }},
        {FailsWith("frame.not_finite", Field("property", "center"), Field("subject", "emitter"), Field("part", "particle"),
                   Field("part_number", 1)),
         [](Frame& f) { f.emitters[0].particles[1].center.z = nan; }},
        {FailsWith("frame.negative", Field("property", "size in meters"), Field("part", "particle"), Field("part_number", 0)),
         [](Frame& f) { f.emitters[0].particles[0].size = -1; }},
        {FailsWith("frame.not_finite", Field("property", "intensity"), Field("subject", "light")),
         [](Frame& f) { f.lights[1].intensity.x = nan; }},
        {FailsWith("frame.not_unit", Field("property", "direction"), Field("subject", "sun")),
         [](Frame& f) {
             f.sun.direction = {0, -2, 0};
         }},
        {FailsWith("frame.not_unit", Field("property", "direction"), Field("subject", "light"), Field("name", "spot")),
         [](Frame& f) {
             f.lights[0].direction = {0, 0, 0};
         }},
        {FailsWith("frame.not_perpendicular", Field("property", "axis_u"), Field("other", "direction")),
         [](Frame& f) { f.lights[0].axis_u = f.lights[0].direction; }},
        {FailsWith("frame.not_unit", Field("property", "u"), Field("subject", "blocker")),
         [](Frame& f) { f.blockers[0].u *= 2; }},
        {FailsWith("frame.not_perpendicular", Field("property", "v"), Field("other", "u"), Field("subject", "portal")),
         [](Frame& f) { f.portals[0].v = f.portals[0].u; }},
        {FailsWith("frame.not_finite", Field("property", "center"), Field("subject", "blocker")),
         [](Frame& f) { f.blockers[0].center.y = nan; }},
        {FailsWith("frame.negative", Field("property", "half_v in meters"), Field("subject", "portal")),
         [](Frame& f) { f.portals[0].half_v = -1; }},
        {FailsWith("frame.negative", Field("property", "half_u in meters"), Field("subject", "blocker")),
         [](Frame& f) { f.blockers[0].half_u = infinity; }},
        {FailsWith("frame.negative", Field("property", "fog density")), [](Frame& f) { f.fog.density = nan; }},
        {FailsWith("frame.unknown_value", Field("property", "fog path"), Field("value", 2)),
         [](Frame& f) { f.fog.path = FogPath{2}; }},
        {FailsWith("frame.not_finite", Field("property", "falloff"), Field("subject", "stage choice")),
         [](Frame& f) { f.recorded_with[0].settings[1].value = double{nan}; }},
    });
}

TEST(FrameCheck, AnOmniLightMayShineAnywhere) {
    Frame frame = rich_frame();
    frame.lights[1].direction = {0, 0, 0};
    EXPECT_TRUE(check_frame(frame));
}

TEST(FrameCheck, BlockersAndPortalsWithoutAreaStopAndOpenNothingAndAreAllowed) {
    Frame frame = rich_frame();
    frame.blockers[0].half_u = 0;
    frame.portals[0].half_v = 0;
    EXPECT_TRUE(check_frame(frame));
}

/// frame.h: clip = (P00 x + P20 z, -(P11 y + P21 z), near, z).
TEST(FrameCheck, PerspectiveIsReversedAndInfinite) {
    const glm::mat4 projection = perspective(1.5707963267948966, 2, .25);
    const glm::vec4 corner = projection * glm::vec4(2, 1, 1, 1);
    EXPECT_NEAR(corner.x / corner.w, 1, 1e-6);
    EXPECT_NEAR(corner.y / corner.w, -1, 1e-6) << "up on the screen is -1 in Vulkan";
    EXPECT_EQ((projection * glm::vec4(0, 0, .25f, 1)).z / .25f, 1) << "1 at the near plane";
    EXPECT_EQ((projection * glm::vec4(0, 0, 1e6f, 1)).z / 1e6f, .25f / 1e6f) << "towards 0 far away";
}

}  // namespace
}  // namespace strata
