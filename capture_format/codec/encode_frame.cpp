// One function per table of schema/capture.fbs, in its order.
#include "capture_format/codec/encode_frame.h"

#include <span>
#include <string>

#include "capture_format/codec/stored_bits.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/stage_choice.h"
#include "capture_format/frame/texture.h"

namespace strata {
namespace {

using flatbuffers::FlatBufferBuilder;
using flatbuffers::Offset;

/// Encodes tables into one builder and bulk data into the blobs.
class Encoder {
public:
    Encoder(BlobCollector& blobs, std::size_t expected_bytes) : builder_(expected_bytes), blobs_(blobs) {
        builder_.ForceDefaults(true);
    }

    std::vector<std::byte> encode(const Frame&, const StoredResources&);

private:
    /// Encodes every element and the vector of them.
    template <typename T, typename Table>
    auto list(const std::vector<T>& values, Offset<Table> (Encoder::*encode_one)(const T&)) {
        std::vector<Offset<Table>> tables;
        tables.reserve(values.size());
        for (const T& value : values) tables.push_back((this->*encode_one)(value));
        return builder_.CreateVector(tables);
    }

    Offset<schema::View> view(const View&);
    Offset<schema::Texture> texture(const StoredTexture&);
    Offset<schema::Mesh> mesh(const StoredMesh&);
    Offset<schema::TextureUse> texture_use(const TextureUse&);
    Offset<schema::Material> material(const Material&);
    Offset<schema::Draw> draw(const Draw&);
    Offset<schema::Emitter> emitter(const Emitter&);
    Offset<schema::ShadowUse> shadow(const ShadowUse&);
    Offset<schema::ClipPlane> clip_plane(const ClipPlane&);
    Offset<schema::Light> light(const Light&);
    Offset<schema::Blocker> blocker(const Blocker&);
    Offset<schema::Portal> portal(const Portal&);
    Offset<schema::Sun> sun(const Sun&);
    Offset<schema::LightVolume> light_volume(const LightVolume&);
    Offset<schema::Environment> environment(const Frame&);
    Offset<schema::Camera> camera(const Lens&, const Film&);
    Offset<schema::Setting> setting(const Setting&);
    Offset<schema::StageChoice> stage_choice(const StageChoice&);

    FlatBufferBuilder builder_;
    BlobCollector& blobs_;
};

schema::Vec2 bits(const glm::vec2& v) { return bit_copy<schema::Vec2>(v); }
schema::Vec3 bits(const glm::vec3& v) { return bit_copy<schema::Vec3>(v); }
schema::Vec4 bits(const glm::vec4& v) { return bit_copy<schema::Vec4>(v); }
schema::UVec3 bits(const glm::uvec3& v) { return bit_copy<schema::UVec3>(v); }
schema::DVec3 bits(const glm::dvec3& v) { return bit_copy<schema::DVec3>(v); }
schema::DMat3 bits(const glm::dmat3& m) { return bit_copy<schema::DMat3>(m); }
schema::DMat4 bits(const glm::dmat4& m) { return bit_copy<schema::DMat4>(m); }
schema::Mat4 bits(const glm::mat4& m) { return bit_copy<schema::Mat4>(m); }
schema::Blob named(const BlobName& blob) { return {blob.hash.low, blob.hash.high, blob.bytes}; }

Offset<schema::View> Encoder::view(const View& view) {
    const schema::DVec3 origin = bits(view.origin);
    const schema::DMat3 to_view = bits(view.to_view);
    const schema::Mat4 projection = bits(view.projection);
    const schema::Vec2 jitter = bits(view.jitter);
    schema::ViewBuilder table(builder_);
    table.add_origin_m(&origin);
    table.add_to_view(&to_view);
    table.add_projection(&projection);
    table.add_jitter_ndc(&jitter);
    table.add_width_px(view.width);
    table.add_height_px(view.height);
    table.add_samples(view.samples);
    table.add_near_m(view.near);
    table.add_exposure(view.exposure);
    return table.Finish();
}

Offset<schema::Texture> Encoder::texture(const StoredTexture& stored) {
    const Texture& texture = stored.texture;
    const auto name = builder_.CreateString(texture.name);
    const schema::Blob texels = named(stored.texels);
    schema::TextureBuilder table(builder_);
    table.add_name(name);
    table.add_format(static_cast<schema::TextureFormat>(texture.format));
    table.add_width_px(texture.width);
    table.add_height_px(texture.height);
    table.add_mips(texture.mips);
    table.add_address(static_cast<schema::AddressMode>(texture.address));
    table.add_magnify(static_cast<schema::TexelFilter>(texture.magnify));
    table.add_minify(static_cast<schema::TexelFilter>(texture.minify));
    table.add_between_mips(static_cast<schema::MipFilter>(texture.between_mips));
    table.add_texels(&texels);
    return table.Finish();
}

Offset<schema::Mesh> Encoder::mesh(const StoredMesh& mesh) {
    const auto name = builder_.CreateString(mesh.name);
    const schema::Blob positions = named(mesh.positions), normals = named(mesh.normals), tangents = named(mesh.tangents);
    const schema::Blob uv0 = named(mesh.uv0), uv1 = named(mesh.uv1), colors = named(mesh.colors), indices = named(mesh.indices);
    schema::MeshBuilder table(builder_);
    table.add_name(name);
    table.add_positions_m(&positions);
    table.add_normals(&normals);
    table.add_tangents(&tangents);
    table.add_uv0(&uv0);
    table.add_uv1(&uv1);
    table.add_colors(&colors);
    table.add_indices(&indices);
    return table.Finish();
}

Offset<schema::TextureUse> Encoder::texture_use(const TextureUse& use) {
    const auto& m = use.transform;
    const schema::Vec3 row_u(m[0], m[1], m[2]), row_v(m[3], m[4], m[5]);
    schema::TextureUseBuilder table(builder_);
    table.add_texture(use.texture);
    table.add_uv_set(use.uv_set);
    table.add_row_u(&row_u);
    table.add_row_v(&row_v);
    return table.Finish();
}

Offset<schema::Material> Encoder::material(const Material& material) {
    const auto name = builder_.CreateString(material.name);
    const auto base_color_texture = texture_use(material.base_color_texture);
    const auto metallic_roughness_texture = texture_use(material.metallic_roughness_texture);
    const auto normal_texture = texture_use(material.normal_texture);
    const auto emissive_texture = texture_use(material.emissive_texture);
    const auto occlusion_texture = texture_use(material.occlusion_texture);
    const schema::Vec4 base_color = bits(material.base_color);
    const schema::Vec3 emissive = bits(material.emissive), transmission = bits(material.transmission);
    schema::MaterialBuilder table(builder_);
    table.add_name(name);
    table.add_lighting_model(static_cast<schema::LightingModel>(material.lighting_model));
    table.add_alpha_mode(static_cast<schema::AlphaMode>(material.alpha_mode));
    table.add_base_color(&base_color);
    table.add_metallic(material.metallic);
    table.add_roughness(material.roughness);
    table.add_emissive_radiance(&emissive);
    table.add_normal_scale(material.normal_scale);
    table.add_occlusion_strength(material.occlusion_strength);
    table.add_mask_cutoff(material.mask_cutoff);
    table.add_transmission(&transmission);
    table.add_distortion_uv(material.distortion);
    table.add_double_sided(material.double_sided);
    table.add_base_color_texture(base_color_texture);
    table.add_metallic_roughness_texture(metallic_roughness_texture);
    table.add_normal_texture(normal_texture);
    table.add_emissive_texture(emissive_texture);
    table.add_occlusion_texture(occlusion_texture);
    return table.Finish();
}

Offset<schema::Draw> Encoder::draw(const Draw& draw) {
    const auto name = builder_.CreateString(draw.name);
    const schema::DMat4 to_world = bits(draw.to_world), previous = bits(draw.previous_to_world);
    schema::DrawBuilder table(builder_);
    table.add_name(name);
    table.add_mesh(draw.mesh);
    table.add_material(draw.material);
    table.add_to_world(&to_world);
    table.add_previous_to_world(&previous);
    table.add_mobility(static_cast<schema::Mobility>(draw.mobility));
    table.add_sort_priority(draw.sort_priority);
    table.add_resolution(static_cast<schema::Resolution>(draw.resolution));
    table.add_layer(draw.layer);
    table.add_casts_shadow(draw.casts_shadow);
    return table.Finish();
}

Offset<schema::Emitter> Encoder::emitter(const Emitter& emitter) {
    const auto name = builder_.CreateString(emitter.name);
    const schema::Blob particles = named(store(emitter.particles, blobs_));
    schema::EmitterBuilder table(builder_);
    table.add_name(name);
    table.add_texture(emitter.texture);
    table.add_alpha_mode(static_cast<schema::AlphaMode>(emitter.alpha_mode));
    table.add_soft_depth_fade_m(emitter.soft_depth_fade);
    table.add_sort_priority(emitter.sort_priority);
    table.add_resolution(static_cast<schema::Resolution>(emitter.resolution));
    table.add_layer(emitter.layer);
    table.add_particles(&particles);
    return table.Finish();
}

Offset<schema::ShadowUse> Encoder::shadow(const ShadowUse& shadow) {
    return schema::CreateShadowUse(builder_, shadow.casts, shadow.map_size, shadow.bias, shadow.soft);
}

Offset<schema::ClipPlane> Encoder::clip_plane(const ClipPlane& plane) {
    const schema::DVec3 normal = bits(plane.normal);
    return schema::CreateClipPlane(builder_, &normal, plane.distance);
}

Offset<schema::Light> Encoder::light(const Light& light) {
    const auto name = builder_.CreateString(light.name);
    const auto shadow_use = shadow(light.shadow);
    const auto clip_planes = list(light.clip_planes, &Encoder::clip_plane);
    const auto blockers = builder_.CreateVector(light.blockers);
    const auto portals = builder_.CreateVector(light.portals);
    const schema::DVec3 position = bits(light.position);
    const schema::Vec3 direction = bits(light.direction), axis_u = bits(light.axis_u), intensity = bits(light.intensity);
    const schema::Vec2 half_extent = bits(light.half_extent);
    schema::LightBuilder table(builder_);
    table.add_name(name);
    table.add_type(static_cast<schema::LightType>(light.type));
    table.add_position_m(&position);
    table.add_direction(&direction);
    table.add_axis_u(&axis_u);
    table.add_intensity(&intensity);
    table.add_range_m(light.range);
    table.add_source_radius_m(light.source_radius);
    table.add_half_extent_m(&half_extent);
    table.add_inner_angle_rad(light.inner_angle);
    table.add_outer_angle_rad(light.outer_angle);
    table.add_texture(light.texture);
    table.add_shadow(shadow_use);
    table.add_clip_planes(clip_planes);
    table.add_blockers(blockers);
    table.add_portals(portals);
    table.add_window(static_cast<schema::RangeWindow>(light.window));
    return table.Finish();
}

Offset<schema::Blocker> Encoder::blocker(const Blocker& blocker) {
    const schema::DVec3 center = bits(blocker.center);
    const schema::Vec3 u = bits(blocker.u), v = bits(blocker.v);
    return schema::CreateBlocker(builder_, &center, &u, &v, blocker.half_u, blocker.half_v, blocker.one_sided);
}

Offset<schema::Portal> Encoder::portal(const Portal& portal) {
    const schema::DVec3 center = bits(portal.center);
    const schema::Vec3 u = bits(portal.u), v = bits(portal.v);
    return schema::CreatePortal(builder_, &center, &u, &v, portal.half_u, portal.half_v, portal.blocker);
}

Offset<schema::Sun> Encoder::sun(const Sun& sun) {
    const auto shadow_use = shadow(sun.shadow);
    const schema::Vec3 direction = bits(sun.direction), irradiance = bits(sun.irradiance);
    schema::SunBuilder table(builder_);
    table.add_direction(&direction);
    table.add_irradiance(&irradiance);
    table.add_angular_radius_rad(sun.angular_radius);
    table.add_shadow(shadow_use);
    table.add_cascades(sun.cascades);
    table.add_shadow_distance_m(sun.shadow_distance);
    table.add_shafts(sun.shafts);
    return table.Finish();
}

Offset<schema::LightVolume> Encoder::light_volume(const LightVolume& volume) {
    const schema::DVec3 center = bits(volume.center);
    const schema::Vec3 half_extent = bits(volume.half_extent);
    const schema::UVec3 cells = bits(volume.cells);
    schema::LightVolumeBuilder table(builder_);
    table.add_kind(static_cast<schema::VolumeKind>(volume.kind));
    table.add_occlusion(static_cast<schema::VolumeOcclusion>(volume.occlusion));
    table.add_center_m(&center);
    table.add_half_extent_m(&half_extent);
    table.add_cells(&cells);
    table.add_cascades(volume.cascades);
    table.add_iterations(volume.iterations);
    return table.Finish();
}

Offset<schema::Environment> Encoder::environment(const Frame& frame) {
    const schema::Vec3 sky = bits(frame.hemisphere.sky), ground = bits(frame.hemisphere.ground);
    const schema::Vec3 background = bits(frame.background), fog = bits(frame.fog.color), rain = bits(frame.rain.direction);
    schema::EnvironmentBuilder table(builder_);
    table.add_sky_radiance(&sky);
    table.add_ground_radiance(&ground);
    table.add_background_radiance(&background);
    table.add_fog_density_per_m(frame.fog.density);
    table.add_fog_radiance(&fog);
    table.add_rain_intensity(frame.rain.intensity);
    table.add_rain_wetness(frame.rain.wetness);
    table.add_rain_direction(&rain);
    table.add_fog_path(static_cast<schema::FogPath>(frame.fog.path));
    return table.Finish();
}

Offset<schema::Camera> Encoder::camera(const Lens& lens, const Film& film) {
    schema::CameraBuilder table(builder_);
    table.add_bloom(lens.bloom);
    table.add_bloom_threshold(lens.bloom_threshold);
    table.add_auto_exposure(lens.auto_exposure);
    table.add_exposure_speed_per_s(lens.exposure_speed);
    table.add_focus_distance_m(lens.focus_distance);
    table.add_aperture_m(lens.aperture);
    table.add_distortion(lens.distortion);
    table.add_grain(film.grain);
    table.add_fade(film.fade);
    table.add_white(film.white);
    return table.Finish();
}

Offset<schema::Setting> Encoder::setting(const Setting& setting) {
    const std::string* text_value = std::get_if<std::string>(&setting.value);
    const auto key = builder_.CreateString(setting.key);
    const auto text = builder_.CreateString(text_value ? *text_value : std::string());
    schema::SettingBuilder table(builder_);
    table.add_key(key);
    table.add_text(text);
    table.add_kind(static_cast<schema::SettingKind>(setting.value.index()));
    if (const auto* integer = std::get_if<std::int64_t>(&setting.value)) table.add_integer(*integer);
    if (const auto* real = std::get_if<double>(&setting.value)) table.add_real(*real);
    return table.Finish();
}

Offset<schema::StageChoice> Encoder::stage_choice(const StageChoice& choice) {
    const auto stage = builder_.CreateString(choice.stage);
    const auto technique = builder_.CreateString(choice.technique);
    const auto settings = list(choice.settings, &Encoder::setting);
    return schema::CreateStageChoice(builder_, stage, technique, settings);
}

std::vector<std::byte> Encoder::encode(const Frame& frame, const StoredResources& resources) {
    const auto view_table = view(frame.view);
    const auto textures = list(resources.textures, &Encoder::texture);
    const auto meshes = list(resources.meshes, &Encoder::mesh);
    const auto materials = list(resources.materials, &Encoder::material);
    const auto draws = list(frame.draws, &Encoder::draw);
    const auto emitters = list(frame.emitters, &Encoder::emitter);
    const auto lights = list(frame.lights, &Encoder::light);
    const auto blockers = list(frame.blockers, &Encoder::blocker);
    const auto portals = list(frame.portals, &Encoder::portal);
    const auto sun_table = sun(frame.sun);
    const auto environment_table = environment(frame);
    const auto volumes = list(frame.light_volumes, &Encoder::light_volume);
    const auto camera_table = camera(frame.lens, frame.film);
    const auto choices = list(frame.recorded_with, &Encoder::stage_choice);
    schema::FrameBuilder table(builder_);
    table.add_view(view_table);
    table.add_time_s(frame.time);
    table.add_index(frame.index);
    table.add_seed(frame.seed);
    table.add_textures(textures);
    table.add_meshes(meshes);
    table.add_materials(materials);
    table.add_draws(draws);
    table.add_emitters(emitters);
    table.add_lights(lights);
    table.add_blockers(blockers);
    table.add_portals(portals);
    table.add_sun(sun_table);
    table.add_environment(environment_table);
    table.add_light_volumes(volumes);
    table.add_camera(camera_table);
    table.add_recorded_with(choices);
    schema::FinishFrameBuffer(builder_, table.Finish());
    const auto bytes = std::as_bytes(std::span(builder_.GetBufferPointer(), builder_.GetSize()));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<std::byte> encode_frame(const Frame& frame, const StoredResources& resources, BlobCollector& blobs) {
    // A draw takes 350 bytes without its name: growing from a kilobyte would copy the lot ten times.
    return Encoder(blobs, 4096 + 384 * frame.draws.size()).encode(frame, resources);
}

std::vector<std::byte> encode_frame(const Frame& frame, BlobCollector& blobs) {
    return encode_frame(frame, store_resources(frame, blobs), blobs);
}

std::int64_t echo_of(std::span<const std::byte> section) {
    const auto& draws = *schema::GetFrame(section.data())->draws();
    if (draws.size() == 0) return 0;
    const auto* now = reinterpret_cast<const std::byte*>(draws.Get(0)->to_world());
    const auto* before = reinterpret_cast<const std::byte*>(draws.Get(0)->previous_to_world());
    return (before - now) / std::ptrdiff_t{8};
}

}  // namespace strata
