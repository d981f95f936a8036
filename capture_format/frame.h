// A frame as plain values: everything a stage may need to compute it again, and nothing of any graphics API.
//
//   Units      Metres, radians, seconds, linear radiance. World positions are doubles.
//   World      +y is up: Hemisphere's sky. Right-handed (glTF, OpenGL) or left-handed (Direct3D): View::to_view says which.
//   Matrices   glm's: stored by columns, for column vectors. world = to_world * vec4(object, 1); to_world[3] is the translation.
//              A matrix for row vectors that is stored by rows has the same 16 numbers in the same order.
//   Winding    The front of triangle a, b, c is the side that cross(b - a, c - a) points to, in the coordinates of the mesh. Seen
//              from there a, b, c turn counter-clockwise in a right-handed world and clockwise in a left-handed one. A to_world
//              that mirrors changes no front. Back faces are invisible unless Material::double_sided.
//   Views      view.h: view space, clip space, reversed depth. look_at() makes a View from an eye, a target and a field of view.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "capture_format/view.h"

namespace strata {

// An application that links the library with other types than these would hand over other structs.
static_assert(alignof(glm::vec4) == alignof(float) && alignof(glm::dmat4) == alignof(double),
              "frames need glm's packed types: compile without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");

/// Marks an index that points at nothing (no texture, no shadow, no list).
inline constexpr std::uint32_t no_index = 0xffffffffu;

enum class TextureFormat : std::uint32_t { rgba8_unorm, rgba8_srgb, rgba16f, rgba32f };
/// What lies beyond a texture's edges: of both axes, or of u and then of v, which address_u() and address_v() give alone.
enum class AddressMode : std::uint32_t {
    repeat,
    clamp,
    mirror,
    repeat_clamp,
    repeat_mirror,
    clamp_repeat,
    clamp_mirror,
    mirror_repeat,
    mirror_clamp
};
AddressMode address_u(AddressMode), address_v(AddressMode);

/// Texels of every mip, finest first, rows top to bottom, tightly packed. Mip n is max(1, extent >> n).
struct Texture {
    std::string name;
    TextureFormat format = TextureFormat::rgba8_unorm;
    std::uint32_t width = 0, height = 0, mips = 1;
    AddressMode address = AddressMode::repeat;
    std::vector<std::byte> texels;
};

/// Triangles. Optional streams are empty or as long as positions; indices are triples into them.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< object space, metres
    std::vector<glm::vec3> normals;    ///< unit
    std::vector<glm::vec4> tangents;   ///< xyz unit, w the sign of the bitangent
    std::vector<glm::vec2> uv0, uv1;   ///< v grows downwards
    std::vector<glm::vec4> colors;     ///< linear, unpremultiplied
    std::vector<std::uint32_t> indices;
};

/// How a surface reflects. Burley is renormalized, plain_burley as published. Hair's tangents run along its fibres, from root to
/// tip; without tangents fibres stick out along the normals.
enum class LightingModel : std::uint32_t { unlit, lambert, burley, ggx, cloth, skin, hair, plain_burley, multiscatter_ggx };
/// The last lighting model.
inline constexpr LightingModel last_lighting_model = LightingModel::multiscatter_ggx;
/// Whether `metallic` means anything to a lighting model; elsewhere it counts as 0.
inline bool has_metals(LightingModel model) {
    return model == LightingModel::burley || model == LightingModel::ggx || model == LightingModel::plain_burley ||
           model == LightingModel::multiscatter_ggx;
}
enum class AlphaMode : std::uint32_t { opaque, mask, blend, premultiplied, additive };
/// Whether something behind it may be seen through a covered sample.
inline bool is_transparent(AlphaMode mode) { return mode != AlphaMode::opaque && mode != AlphaMode::mask; }

/// A texture with its uv set and affine uv transform: uv' = transform * (u, v, 1), row by row.
struct TextureUse {
    std::uint32_t texture = no_index;
    std::uint32_t uv_set = 0;
    std::array<float, 6> transform = {1, 0, 0, 0, 1, 0};
};

struct Material {
    std::string name;
    LightingModel lighting_model = LightingModel::ggx;
    AlphaMode alpha_mode = AlphaMode::opaque;
    glm::vec4 base_color{1};  ///< linear, unpremultiplied; a is coverage
    float metallic = 0;       ///< of models that have metals
    float roughness = 1;
    glm::vec3 emissive{0};  ///< radiance
    float normal_scale = 1;
    float occlusion_strength = 1;
    float mask_cutoff = 0.5f;
    glm::vec3 transmission{0};  ///< k of t = 1 - alpha (1 - k): the color glass lets through; 0 is grey smoke
    float distortion = 0;       ///< uv offset per unit of view-space normal
    bool double_sided = false;
    TextureUse base_color_texture, metallic_roughness_texture, normal_texture, emissive_texture, occlusion_texture;
};

enum class Mobility : std::uint32_t { fixed, moving };
enum class Resolution : std::uint32_t { full, low };

/// A mesh with a material somewhere in the world.
struct Draw {
    std::string name;
    std::uint32_t mesh = 0, material = 0;
    glm::dmat4 to_world{1};           ///< object to world
    glm::dmat4 previous_to_world{1};  ///< to_world of the frame before; equal to it for a draw at rest
    Mobility mobility = Mobility::fixed;
    std::int32_t sort_priority = 0;  ///< object-sorted transparency draws lower values first
    Resolution resolution = Resolution::full;
    std::uint32_t layer = 0;  ///< 0 the world; others are in-world interfaces, drawn in front in this order
    bool casts_shadow = true;
};

/// One camera-facing quad. Its corners are center +- size, turned by rotation around the view axis.
struct Particle {
    glm::dvec3 center{0};  ///< world
    float size = 1;        ///< half the edge, metres
    float rotation = 0;    ///< radians, counter-clockwise on screen
    glm::vec3 color{1};    ///< unpremultiplied scattered radiance, already lit by all but light volumes
    float alpha = 1;
    glm::vec3 emissive{0};           ///< radiance added without coverage
    glm::vec4 uv_frame{0, 0, 1, 1};  ///< left, top, width, height of the flipbook cell
    float depth_offset = 0;          ///< metres towards the eye, for sorting and blending, not for the depth test
};

struct Emitter {
    std::string name;
    std::uint32_t texture = no_index;  ///< rgb multiplies color and emissive, a multiplies alpha
    AlphaMode alpha_mode = AlphaMode::blend;
    float soft_depth_fade = 0;  ///< metres over which a quad fades before the opaque surface behind it; 0 is hard
    std::int32_t sort_priority = 0;
    Resolution resolution = Resolution::full;
    std::uint32_t layer = 0;
    std::vector<Particle> particles;
};

enum class LightType : std::uint32_t { omni, round_spot, square_spot, tube, sphere, disc, rectangle, directional };

/// Shadow of a light: a map of size x size texels, filtered by the shadow technique.
struct ShadowUse {
    bool casts = false;
    std::uint32_t map_size = 1024;
    float bias = 0.02f;  ///< metres along the light's rays
    bool soft = false;   ///< wants penumbrae as wide as its source_radius, the sun's angular_radius, makes them
};

/// Keeps what lies on the side dot(normal, p) + distance >= 0, world space.
struct ClipPlane {
    glm::dvec3 normal{0, 1, 0};
    double distance = 0;
};

/// Any light. Intensity is W/sr for points and spots, irradiance for directional, and for tubes, spheres, discs and rectangles
/// the radiance of their surface; negative is a "dark". A tube is a capsule: a cylinder along axis_u with half spheres on its
/// ends. Discs and rectangles shine to the front only. A picture's u grows along axis_u, its v against cross(direction, axis_u)
/// of view space: one that a spot throws is upright for who stands behind the spot with axis_u to the right.
struct Light {
    std::string name;
    LightType type = LightType::omni;
    glm::dvec3 position{0};
    glm::vec3 direction{0, -1, 0};  ///< where it shines, unit
    glm::vec3 axis_u{1, 0, 0};      ///< unit, perpendicular to direction
    glm::vec3 intensity{1};
    float range = 10;                              ///< from position: the window is exactly 0 from here on
    float source_radius = 0;                       ///< sphere, disc, tube
    glm::vec2 half_extent{0};                      ///< rectangle half sizes; tube half length in x
    float inner_angle = 0.5f, outer_angle = 0.7f;  ///< half angles; a square spot uses outer for u and inner for v
    std::uint32_t texture = no_index;              ///< projected (spots) or emitted (rectangle)
    ShadowUse shadow;
    std::vector<ClipPlane> clip_planes;   ///< at most 6
    std::vector<std::uint32_t> blockers;  ///< indices into Frame::blockers, at most 32
    std::vector<std::uint32_t> portals;   ///< indices into Frame::portals, at most 32
};

/// A rectangle that stops light: center +- u * half_u +- v * half_v. One without area stops nothing.
struct Blocker {
    glm::dvec3 center{0};
    glm::vec3 u{1, 0, 0}, v{0, 1, 0};
    float half_u = 1, half_v = 1;
    bool one_sided = false;  ///< stops only light from the side to which cross(u, v) points
};

/// A hole in one blocker, projected onto it along its normal; what lies outside of it opens nothing. A door through both faces of
/// a thick wall is two portals.
struct Portal {
    glm::dvec3 center{0};
    glm::vec3 u{1, 0, 0}, v{0, 1, 0};
    float half_u = 1, half_v = 1;
    std::uint32_t blocker = 0;  ///< index into Frame::blockers
};

struct Sun {
    glm::vec3 direction{0, -1, 0};  ///< where it shines, unit
    glm::vec3 irradiance{0};        ///< perpendicular; zero means there is no sun
    float angular_radius = 0.00465f;
    ShadowUse shadow;
    std::uint32_t cascades = 3;
    float shadow_distance = 60;  ///< metres of view depth covered by the cascades
    bool shafts = false;
};

/// Light from all around: sky above, ground below, mixed by .5 + .5 n.y.
struct Hemisphere {
    glm::vec3 sky{0}, ground{0};  ///< radiance
};

/// The way through fog to a point: its view depth, or its distance from the eye.
enum class FogPath : std::uint32_t { view_depth, distance };

/// f = exp(-density way) of what is behind remains, and (1 - f) color is added.
struct Fog {
    float density = 0;  ///< per metre; zero means there is no fog
    glm::vec3 color{0};
    FogPath path = FogPath::view_depth;
};

enum class VolumeKind : std::uint32_t { cascaded_global, fixed_local };
enum class VolumeOcclusion : std::uint32_t { none, fuzzy_geometry, axial };

/// A light propagation volume.
struct LightVolume {
    VolumeKind kind = VolumeKind::cascaded_global;
    VolumeOcclusion occlusion = VolumeOcclusion::none;
    glm::dvec3 center{0};
    glm::vec3 half_extent{16};
    glm::uvec3 cells{32};
    std::uint32_t cascades = 1;
    std::uint32_t iterations = 16;
};

struct Rain {
    float intensity = 0;  ///< 0 none, 1 heavy
    float wetness = 0;    ///< 0 dry, 1 soaked
    glm::vec3 direction{0, -1, 0};
};

struct Lens {
    float bloom = 0, bloom_threshold = 1;
    bool auto_exposure = false;
    float exposure_speed = 1;
    float focus_distance = 0, aperture = 0;  ///< metres; aperture 0 is a pinhole
    bool distortion = false;
};

struct Film {
    float grain = 0, fade = 0;
    float white = 1.7f;  ///< Wt of the tone curve x (1 + x / Wt^2) / (1 + x)
};

using SettingValue = std::variant<std::int64_t, double, std::string>;
struct Setting {
    std::string key;
    SettingValue value;
};

/// How a stage was done when the frame was recorded. Names are strings: the format knows no technique.
struct StageChoice {
    std::string stage, technique;
    std::vector<Setting> settings;
};

struct Frame {
    View view;
    double time = 0;          ///< seconds
    std::uint64_t index = 0;  ///< of the recording application
    std::uint64_t seed = 0;

    std::vector<Texture> textures;
    std::vector<Mesh> meshes;
    std::vector<Material> materials;
    std::vector<Draw> draws;        ///< in submission order
    std::vector<Emitter> emitters;  ///< submitted after all draws

    std::vector<Light> lights;
    std::vector<Blocker> blockers;
    std::vector<Portal> portals;
    Sun sun;
    Hemisphere hemisphere;
    glm::vec3 background{0};  ///< radiance where no surface is
    Fog fog;
    std::vector<LightVolume> light_volumes;
    Rain rain;
    Lens lens;
    Film film;

    std::vector<StageChoice> recorded_with;
};

}  // namespace strata
