// Built by hand, with values that differ from the defaults and bits that arithmetic would lose.
#include "tests/1_capture/sample_frames.h"

#include <bit>
#include <limits>

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

namespace strata {
namespace {

/// A quiet NaN whose payload must survive.
const float odd_nan = std::bit_cast<float>(0x7fc12345u);
const float infinite = std::numeric_limits<float>::infinity();

/// A resource with nothing but a name.
template <typename T>
T named(const char* name) {
    T resource;
    resource.name = name;
    return resource;
}

Texture checker() {
    Texture texture{.name = "checker",
                    .width = 2,
                    .height = 2,
                    .mips = 2,
                    .magnify = TexelFilter::nearest,
                    .minify = TexelFilter::nearest,
                    .between_mips = MipFilter::none,
                    .texels = {}};
    for (int i = 0; i < 5 * 4; ++i) texture.texels.push_back(static_cast<std::byte>(i * 12));
    return texture;
}

/// Float texels may hold anything.
Texture floats() {
    Texture texture{.name = "floats", .format = TextureFormat::rgba32f, .width = 1, .height = 1, .texels = {}};
    for (const float value : {odd_nan, -0.0f, infinite, 1e-45f}) {
        for (const std::byte byte : std::bit_cast<std::array<std::byte, 4>>(value)) texture.texels.push_back(byte);
    }
    return texture;
}

Mesh triangle_mesh() {
    Mesh mesh = named<Mesh>("triangle");
    mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals = {{0, 0, -1}, {0, 0, -1}, {0, 0, odd_nan}};
    mesh.tangents = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, -1}};
    mesh.uv0 = mesh.uv1 = {{0, 1}, {1, 1}, {.5f, 0}};
    mesh.colors = {{1, 0, 0, 1}, {0, odd_nan, 0, 1}, {0, 0, infinite, -0.0f}};
    mesh.indices = {0, 1, 2};
    return mesh;
}

Material glass() {
    Material material = named<Material>("glass");
    material.alpha_mode = AlphaMode::blend;
    material.base_color = {.9f, .8f, .7f, .4f};
    material.transmission = {.9f, .5f, .1f};
    material.emissive = {0, -0.0f, .25f};
    material.distortion = .01f;
    material.double_sided = true;
    material.base_color_texture = {.texture = 0, .uv_set = 1, .transform = {2, 0, .5f, 0, 3, -.25f}};
    return material;
}

Emitter smoke() {
    Emitter emitter = named<Emitter>("smoke");
    emitter.texture = 0;
    emitter.soft_depth_fade = .5f;
    emitter.resolution = Resolution::low;
    emitter.particles = {{.center = {0, 1, 4}, .color = {odd_nan, 1, 1}, .alpha = infinite, .depth_offset = odd_nan},
                         {.center = {1, 1, 5}, .rotation = .5f, .emissive = {3, 2, 1}}};
    return emitter;
}

Light spot() {
    Light light = named<Light>("spot");
    light.type = LightType::square_spot;
    light.position = {0, 3, 4};
    light.intensity = {40, -1, 3};
    light.window = RangeWindow::quartic;
    light.texture = 0;
    light.shadow = {.casts = true, .map_size = 256, .bias = .01f, .soft = true};
    light.clip_planes = {{.normal = {0, 1, 0}, .distance = .125}};
    light.blockers = {0};
    light.portals = {0};
    return light;
}

}  // namespace

Frame triangle_frame() {
    Frame frame;
    frame.view.width = 16;
    frame.view.height = 9;
    frame.view.projection = perspective(1, 16. / 9, frame.view.near);
    frame.meshes = {named<Mesh>("triangle")};
    frame.meshes[0].positions = {{-1, 0, 3}, {1, 0, 3}, {0, 1, 3}};
    frame.meshes[0].indices = {0, 1, 2};
    frame.materials = {named<Material>("plain")};
    frame.draws = {named<Draw>("triangle")};
    frame.sun.irradiance = {1, 1, 1};
    return frame;
}

Frame rich_frame() {
    Frame frame = triangle_frame();
    frame.view.samples = 4;
    frame.view.jitter = {.125f, -0.0f};
    frame.time = 1.0 / 3;
    frame.index = 1ull << 40;
    frame.seed = ~0ull;
    frame.textures = {checker(), floats()};
    frame.meshes.push_back(triangle_mesh());
    frame.materials.push_back(glass());
    frame.draws.push_back(
        {.name = "pane", .mesh = 1, .material = 1, .mobility = Mobility::moving, .sort_priority = -3, .layer = 2});
    frame.draws.back().to_world[3] = {0, 0, 5, 1};
    frame.emitters = {smoke()};
    frame.blockers = {{.center = {0, 2, 4}, .half_u = 2, .one_sided = true}};
    frame.portals = {{.center = {0, 2, 4}, .half_u = .5f}};
    frame.lights = {spot(), named<Light>("lamp"), named<Light>("tube")};
    frame.lights[1].position = {1, 2, 3};
    frame.lights[2].type = LightType::tube;
    frame.lights[2].half_extent = {1, 0};
    frame.hemisphere = {{.1f, .2f, .3f}, {.05f, .04f, .03f}};
    frame.background = {.5f, .6f, .7f};
    frame.fog = {.02f, {.3f, .3f, -0.0f}, FogPath::distance};
    frame.light_volumes = {{.kind = VolumeKind::fixed_local, .occlusion = VolumeOcclusion::axial, .cells = {8, 4, 8}}};
    frame.rain = {.intensity = .5f, .wetness = .25f, .direction = {0, -1, 0}};
    frame.lens = {.bloom = .1f, .auto_exposure = true, .focus_distance = 4, .aperture = .01f, .distortion = true};
    frame.film = {.grain = .1f, .fade = .2f, .white = 2};
    frame.recorded_with = {
        {"transparency", "sorted_lists", {{"budget", std::int64_t{-7}}, {"falloff", .1}, {"mode", std::string("all")}}}};
    return frame;
}

}  // namespace strata
