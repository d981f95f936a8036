// What check_frame() refuses, with the sentence it says, and what it lets through.
#include <functional>
#include <limits>

#include <gmock/gmock.h>

#include "capture_format/reader.h"
#include "tests/1_capture/sample_frames.h"

namespace strata {
namespace {

using testing::HasSubstr;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// One thing done to a good frame and part of the sentence about it.
struct Wrong {
    std::string sentence;
    std::function<void(Frame&)> make;
};

void expect_refused(std::initializer_list<Wrong> wrongs) {
    for (const Wrong& wrong : wrongs) {
        Frame frame = rich_frame();
        wrong.make(frame);
        const auto checked = check_frame(frame);
        ASSERT_FALSE(checked) << wrong.sentence;
        EXPECT_THAT(checked.error().sentence, HasSubstr(wrong.sentence));
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
        {"draw 1 'pane': it draws mesh 2 of 2", [](Frame& f) { f.draws[1].mesh = 2; }},
        {"draw 1 'pane': it uses material 2 of 2", [](Frame& f) { f.draws[1].material = 2; }},
        {"material 1 'glass': it uses texture 2 of 2", [](Frame& f) { f.materials[1].base_color_texture.texture = 2; }},
        {"emitter 0 'smoke': it uses texture 2 of 2", [](Frame& f) { f.emitters[0].texture = 2; }},
        {"light 0 'spot': it uses texture 2 of 2", [](Frame& f) { f.lights[0].texture = 2; }},
        {"light 0 'spot': it lists blocker 1 of 1", [](Frame& f) { f.lights[0].blockers = {1}; }},
        {"light 0 'spot': it lists portal 1 of 1", [](Frame& f) { f.lights[0].portals = {1}; }},
        {"portal 0: it is a hole in blocker 1 of 1", [](Frame& f) { f.portals[0].blocker = 1; }},
        {"mesh 1 'triangle': index 2 points at vertex 3 of 3", [](Frame& f) { f.meshes[1].indices[2] = 3; }},
    });
}

TEST(FrameCheck, StreamsAndTexelsHaveTheirLengths) {
    expect_refused({
        {"normals must be absent or as many as the 3 positions, not 2", [](Frame& f) { f.meshes[1].normals.pop_back(); }},
        {"uv1 must be absent", [](Frame& f) { f.meshes[1].uv1.resize(9); }},
        {"2 indices are not whole triangles", [](Frame& f) { f.meshes[1].indices.pop_back(); }},
        {"its mips need 20 bytes, 19 are there", [](Frame& f) { f.textures[0].texels.pop_back(); }},
        {"2 x 2 texels have 1 to 2 mips, not 3", [](Frame& f) { f.textures[0].mips = 3; }},
        {"1 to 16384 texels each way, not 0 x 2", [](Frame& f) { f.textures[0].width = 0; }},
        {"a texture on uv set 1, which mesh 'triangle' lacks", [](Frame& f) { f.meshes[1].uv1.clear(); }},
        {"uv sets are 0 and 1, not 2", [](Frame& f) { f.materials[1].base_color_texture.uv_set = 2; }},
        {"names may have 255 bytes", [](Frame& f) { f.draws[0].name.assign(256, 'x'); }},
        {"up to 6 clip planes, not 7", [](Frame& f) { f.lights[0].clip_planes.resize(7); }},
        {"up to 32 blockers, not 33", [](Frame& f) { f.lights[0].blockers.assign(33, 0); }},
        {"up to 32 portals, not 33", [](Frame& f) { f.lights[0].portals.assign(33, 0); }},
    });
}

TEST(FrameCheck, EnumsAreOnesWeKnow) {
    expect_refused({
        {"no texture format 4", [](Frame& f) { f.textures[0].format = TextureFormat{4}; }},
        {"no address mode 9", [](Frame& f) { f.textures[0].address = AddressMode{9}; }},
        {"no lighting model 9", [](Frame& f) { f.materials[0].lighting_model = LightingModel{9}; }},
        {"no alpha mode 5", [](Frame& f) { f.materials[0].alpha_mode = AlphaMode{5}; }},
        {"alpha mode 1 is none of these", [](Frame& f) { f.emitters[0].alpha_mode = AlphaMode::mask; }},
        {"no mobility 2", [](Frame& f) { f.draws[0].mobility = Mobility{2}; }},
        {"no light type 8", [](Frame& f) { f.lights[0].type = LightType{8}; }},
        {"no occlusion 3", [](Frame& f) { f.light_volumes[0].occlusion = VolumeOcclusion{3}; }},
    });
}

TEST(FrameCheck, TheViewIsOneThatCanBeDrawn) {
    expect_refused({
        {"view: the extent must be 1 to 16384 pixels each way, not 0 x 9", [](Frame& f) { f.view.width = 0; }},
        {"samples must be 1 or 4, not 2", [](Frame& f) { f.view.samples = 2; }},
        {"the origin is not finite", [](Frame& f) { f.view.origin.x = nan; }},
        {"to_view must be a rotation", [](Frame& f) { f.view.to_view[0] *= 2; }},
        {"to_view must be a rotation", [](Frame& f) { f.view.to_view[1] = f.view.to_view[0]; }},
        {"column 1 is not finite", [](Frame& f) { f.view.projection[1][1] = infinity; }},
        {"reversed infinite form", [](Frame& f) { f.view.projection[2][2] = -1; }},
        {"keep x and flip y", [](Frame& f) { f.view.projection[1][1] *= -1; }},
        {"near plane is 0.1, the view's 0.2", [](Frame& f) { f.view.near = .2f; }},
    });
}

TEST(FrameCheck, FloatsThatWouldBreakAReplayAreRefused) {
    expect_refused({
        {"a position is not finite", [](Frame& f) { f.meshes[0].positions[1].y = nan; }},
        {"texture coordinates must be within", [](Frame& f) { f.meshes[1].uv0[0].x = infinity; }},
        {"to_world must be finite", [](Frame& f) { f.draws[0].to_world[3][0] = nan; }},
        {"last row 0 0 0 1", [](Frame& f) { f.draws[0].to_world[0][3] = 1; }},
        {"roughness must be 0 to 1, not 1.5", [](Frame& f) { f.materials[0].roughness = 1.5f; }},
        {"particle 1's center is not finite", [](Frame& f) { f.emitters[0].particles[1].center.z = nan; }},
        {"particle 0's size must be 0 m or above", [](Frame& f) { f.emitters[0].particles[0].size = -1; }},
        {"its intensity is not finite", [](Frame& f) { f.lights[1].intensity.x = nan; }},
        {"sun: its direction must be unit",
         [](Frame& f) {
             f.sun.direction = {0, -2, 0};
         }},
        {"light 0 'spot': its direction must be unit",
         [](Frame& f) {
             f.lights[0].direction = {0, 0, 0};
         }},
        {"perpendicular to its direction", [](Frame& f) { f.lights[0].axis_u = f.lights[0].direction; }},
        {"its u and v must be unit", [](Frame& f) { f.blockers[0].u *= 2; }},
        {"portal 0: its u and v must be unit and perpendicular", [](Frame& f) { f.portals[0].v = f.portals[0].u; }},
        {"blocker 0: its center is not finite", [](Frame& f) { f.blockers[0].center.y = nan; }},
        {"portal 0: its half sizes must be 0 m or above", [](Frame& f) { f.portals[0].half_v = -1; }},
        {"blocker 0: its half sizes must be 0 m or above", [](Frame& f) { f.blockers[0].half_u = infinity; }},
        {"fog's density must be 0 or above", [](Frame& f) { f.fog.density = nan; }},
        {"no path of fog 2", [](Frame& f) { f.fog.path = FogPath{2}; }},
        {"setting 'falloff' is not finite", [](Frame& f) { f.recorded_with[0].settings[1].value = double{nan}; }},
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
