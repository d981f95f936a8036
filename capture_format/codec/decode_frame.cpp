// One function per table of schema/capture.fbs, in its order. Enums are cast as they come; check_frame() refuses strangers.
#include "capture_format/codec/decode_frame.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "capture_format/clean_text.h"
#include "capture_format/codec/stored_bits.h"
#include "capture_format/frame.h"
#include "capture_format/inspection.h"

namespace strata {
namespace {

// Deeper or wider than any frame we write; the recorder refuses to write what this would refuse to read.
constexpr flatbuffers::uoffset_t deepest_nesting = 8, most_tables = 1'000'000;

/// Decodes tables; the first thing that cannot be decoded is the verdict.
class Decoder {
public:
    explicit Decoder(BlobStore& blobs) : blobs_(blobs) {}

    Frame decode(const schema::Frame&);
    const std::optional<Error>& error() const { return error_; }

private:
    /// The values of a stream; empty after the first error.
    template <typename T>
    std::vector<T> stream(const schema::Blob& blob, std::string_view what);
    /// Decodes every table of a vector.
    template <typename Table, typename T>
    std::vector<T> list(const flatbuffers::Vector<flatbuffers::Offset<Table>>& tables, T (Decoder::*decode_one)(const Table&)) {
        std::vector<T> values;
        for (const Table* table : tables) {
            if (error_) break;
            values.push_back((this->*decode_one)(*table));
        }
        return values;
    }
    std::string text(const flatbuffers::String* stored);
    /// Indices of a light, bounded before they are copied.
    std::vector<std::uint32_t> indices(const flatbuffers::Vector<std::uint32_t>& stored);
    void refuse(Error error) {
        if (!error_) error_ = std::move(error);
    }

    View view(const schema::View&);
    Texture texture(const schema::Texture&);
    Mesh mesh(const schema::Mesh&);
    TextureUse texture_use(const schema::TextureUse&);
    Material material(const schema::Material&);
    Draw draw(const schema::Draw&);
    Emitter emitter(const schema::Emitter&);
    ShadowUse shadow(const schema::ShadowUse&);
    ClipPlane clip_plane(const schema::ClipPlane&);
    Light light(const schema::Light&);
    Blocker blocker(const schema::Blocker&);
    Portal portal(const schema::Portal&);
    Sun sun(const schema::Sun&);
    LightVolume light_volume(const schema::LightVolume&);
    Setting setting(const schema::Setting&);
    StageChoice stage_choice(const schema::StageChoice&);

    BlobStore& blobs_;
    std::optional<Error> error_;
};

// A light has up to 32 blockers and 32 portals; more are not worth copying before check_frame() refuses them.
constexpr std::size_t longest_light_list = 33;

template <typename T>
std::vector<T> Decoder::stream(const schema::Blob& blob, std::string_view what) {
    if (error_ || blob.bytes() == 0) return {};
    if (blob.bytes() % sizeof(T) != 0) {
        refuse(fail(Fault::bad_input, "capture.frame.stream_size",
                    "{bytes} bytes of {stream} are not a multiple of {element_bytes}", blob.bytes(), what, sizeof(T)));
        return {};
    }
    const auto found = blobs_.find({{blob.hash_low(), blob.hash_high()}, blob.bytes()});
    if (!found) {
        refuse(found.error());
        return {};
    }
    std::vector<T> values(found->size() / sizeof(T));
    std::memcpy(values.data(), found->data(), found->size());
    return values;
}

std::string Decoder::text(const flatbuffers::String* stored) {
    if (!stored) return {};
    if (stored->size() > longest_text) refuse(too_long_name(stored->size()));
    return error_ ? std::string() : clean_text({stored->c_str(), stored->size()});
}

std::vector<std::uint32_t> Decoder::indices(const flatbuffers::Vector<std::uint32_t>& stored) {
    std::vector<std::uint32_t> values;
    for (flatbuffers::uoffset_t i = 0; i < stored.size() && i < longest_light_list; ++i) values.push_back(stored.Get(i));
    return values;
}

View Decoder::view(const schema::View& table) {
    return {
        .origin = bit_copy<glm::dvec3>(*table.origin_m()),
        .to_view = bit_copy<glm::dmat3>(*table.to_view()),
        .projection = bit_copy<glm::mat4>(*table.projection()),
        .jitter = bit_copy<glm::vec2>(*table.jitter_ndc()),
        .width = table.width_px(),
        .height = table.height_px(),
        .samples = table.samples(),
        .near = table.near_m(),
        .exposure = table.exposure(),
    };
}

Texture Decoder::texture(const schema::Texture& table) {
    return {
        .name = text(table.name()),
        .format = static_cast<TextureFormat>(table.format()),
        .width = table.width_px(),
        .height = table.height_px(),
        .mips = table.mips(),
        .address = static_cast<AddressMode>(table.address()),
        .magnify = static_cast<TexelFilter>(table.magnify()),
        .minify = static_cast<TexelFilter>(table.minify()),
        .between_mips = static_cast<MipFilter>(table.between_mips()),
        .texels = stream<std::byte>(*table.texels(), "texels"),
    };
}

Mesh Decoder::mesh(const schema::Mesh& table) {
    return {
        .name = text(table.name()),
        .positions = stream<glm::vec3>(*table.positions_m(), "positions"),
        .normals = stream<glm::vec3>(*table.normals(), "normals"),
        .tangents = stream<glm::vec4>(*table.tangents(), "tangents"),
        .uv0 = stream<glm::vec2>(*table.uv0(), "texture coordinates"),
        .uv1 = stream<glm::vec2>(*table.uv1(), "texture coordinates"),
        .colors = stream<glm::vec4>(*table.colors(), "colors"),
        .indices = stream<std::uint32_t>(*table.indices(), "indices"),
    };
}

TextureUse Decoder::texture_use(const schema::TextureUse& table) {
    const schema::Vec3& u = *table.row_u();
    const schema::Vec3& v = *table.row_v();
    return {.texture = table.texture(), .uv_set = table.uv_set(), .transform = {u.x(), u.y(), u.z(), v.x(), v.y(), v.z()}};
}

Material Decoder::material(const schema::Material& table) {
    return {
        .name = text(table.name()),
        .lighting_model = static_cast<LightingModel>(table.lighting_model()),
        .alpha_mode = static_cast<AlphaMode>(table.alpha_mode()),
        .base_color = bit_copy<glm::vec4>(*table.base_color()),
        .metallic = table.metallic(),
        .roughness = table.roughness(),
        .emissive = bit_copy<glm::vec3>(*table.emissive_radiance()),
        .normal_scale = table.normal_scale(),
        .occlusion_strength = table.occlusion_strength(),
        .mask_cutoff = table.mask_cutoff(),
        .transmission = bit_copy<glm::vec3>(*table.transmission()),
        .distortion = table.distortion_uv(),
        .double_sided = table.double_sided(),
        .base_color_texture = texture_use(*table.base_color_texture()),
        .metallic_roughness_texture = texture_use(*table.metallic_roughness_texture()),
        .normal_texture = texture_use(*table.normal_texture()),
        .emissive_texture = texture_use(*table.emissive_texture()),
        .occlusion_texture = texture_use(*table.occlusion_texture()),
    };
}

Draw Decoder::draw(const schema::Draw& table) {
    return {
        .name = text(table.name()),
        .mesh = table.mesh(),
        .material = table.material(),
        .to_world = bit_copy<glm::dmat4>(*table.to_world()),
        .previous_to_world = bit_copy<glm::dmat4>(*table.previous_to_world()),
        .mobility = static_cast<Mobility>(table.mobility()),
        .sort_priority = table.sort_priority(),
        .resolution = static_cast<Resolution>(table.resolution()),
        .layer = table.layer(),
        .casts_shadow = table.casts_shadow(),
    };
}

Emitter Decoder::emitter(const schema::Emitter& table) {
    return {
        .name = text(table.name()),
        .texture = table.texture(),
        .alpha_mode = static_cast<AlphaMode>(table.alpha_mode()),
        .soft_depth_fade = table.soft_depth_fade_m(),
        .sort_priority = table.sort_priority(),
        .resolution = static_cast<Resolution>(table.resolution()),
        .layer = table.layer(),
        .particles = stream<Particle>(*table.particles(), "particles"),
    };
}

ShadowUse Decoder::shadow(const schema::ShadowUse& table) {
    return {.casts = table.casts(), .map_size = table.map_size_px(), .bias = table.bias_m(), .soft = table.soft()};
}

ClipPlane Decoder::clip_plane(const schema::ClipPlane& table) {
    return {bit_copy<glm::dvec3>(*table.normal()), table.distance_m()};
}

Light Decoder::light(const schema::Light& table) {
    return {
        .name = text(table.name()),
        .type = static_cast<LightType>(table.type()),
        .position = bit_copy<glm::dvec3>(*table.position_m()),
        .direction = bit_copy<glm::vec3>(*table.direction()),
        .axis_u = bit_copy<glm::vec3>(*table.axis_u()),
        .intensity = bit_copy<glm::vec3>(*table.intensity()),
        .range = table.range_m(),
        .window = static_cast<RangeWindow>(table.window()),
        .source_radius = table.source_radius_m(),
        .half_extent = bit_copy<glm::vec2>(*table.half_extent_m()),
        .inner_angle = table.inner_angle_rad(),
        .outer_angle = table.outer_angle_rad(),
        .texture = table.texture(),
        .shadow = shadow(*table.shadow()),
        .clip_planes = list(*table.clip_planes(), &Decoder::clip_plane),
        .blockers = indices(*table.blockers()),
        .portals = indices(*table.portals()),
    };
}

Blocker Decoder::blocker(const schema::Blocker& table) {
    return {
        .center = bit_copy<glm::dvec3>(*table.center_m()),
        .u = bit_copy<glm::vec3>(*table.u()),
        .v = bit_copy<glm::vec3>(*table.v()),
        .half_u = table.half_u_m(),
        .half_v = table.half_v_m(),
        .one_sided = table.one_sided(),
    };
}

Portal Decoder::portal(const schema::Portal& table) {
    return {
        .center = bit_copy<glm::dvec3>(*table.center_m()),
        .u = bit_copy<glm::vec3>(*table.u()),
        .v = bit_copy<glm::vec3>(*table.v()),
        .half_u = table.half_u_m(),
        .half_v = table.half_v_m(),
        .blocker = table.blocker(),
    };
}

Sun Decoder::sun(const schema::Sun& table) {
    return {
        .direction = bit_copy<glm::vec3>(*table.direction()),
        .irradiance = bit_copy<glm::vec3>(*table.irradiance()),
        .angular_radius = table.angular_radius_rad(),
        .shadow = shadow(*table.shadow()),
        .cascades = table.cascades(),
        .shadow_distance = table.shadow_distance_m(),
        .shafts = table.shafts(),
    };
}

LightVolume Decoder::light_volume(const schema::LightVolume& table) {
    return {
        .kind = static_cast<VolumeKind>(table.kind()),
        .occlusion = static_cast<VolumeOcclusion>(table.occlusion()),
        .center = bit_copy<glm::dvec3>(*table.center_m()),
        .half_extent = bit_copy<glm::vec3>(*table.half_extent_m()),
        .cells = bit_copy<glm::uvec3>(*table.cells()),
        .cascades = table.cascades(),
        .iterations = table.iterations(),
    };
}

Rain rain(const schema::Environment& table) {
    return {table.rain_intensity(), table.rain_wetness(), bit_copy<glm::vec3>(*table.rain_direction())};
}

Lens lens(const schema::Camera& table) {
    return {
        .bloom = table.bloom(),
        .bloom_threshold = table.bloom_threshold(),
        .auto_exposure = table.auto_exposure(),
        .exposure_speed = table.exposure_speed_per_s(),
        .focus_distance = table.focus_distance_m(),
        .aperture = table.aperture_m(),
        .distortion = table.distortion(),
    };
}

Setting Decoder::setting(const schema::Setting& table) {
    Setting setting{text(table.key()), {}};
    switch (table.kind()) {
        case schema::SettingKind::integer:
            setting.value = table.integer();
            break;
        case schema::SettingKind::real:
            setting.value = table.real();
            break;
        case schema::SettingKind::text:
            setting.value = text(table.text());
            break;
        default:
            refuse(fail(Fault::bad_input, "capture.frame.setting_kind", "setting '{setting}' has an unknown kind", setting.key));
    }
    return setting;
}

StageChoice Decoder::stage_choice(const schema::StageChoice& table) {
    return {text(table.stage()), text(table.technique()), list(*table.settings(), &Decoder::setting)};
}

Frame Decoder::decode(const schema::Frame& table) {
    const schema::Environment& environment = *table.environment();
    const schema::Camera& camera = *table.camera();
    Frame frame;
    frame.view = view(*table.view());
    frame.time = table.time_s();
    frame.index = table.index();
    frame.seed = table.seed();
    frame.textures = list(*table.textures(), &Decoder::texture);
    frame.meshes = list(*table.meshes(), &Decoder::mesh);
    frame.materials = list(*table.materials(), &Decoder::material);
    frame.draws = list(*table.draws(), &Decoder::draw);
    frame.emitters = list(*table.emitters(), &Decoder::emitter);
    frame.lights = list(*table.lights(), &Decoder::light);
    frame.blockers = list(*table.blockers(), &Decoder::blocker);
    frame.portals = list(*table.portals(), &Decoder::portal);
    frame.sun = sun(*table.sun());
    frame.hemisphere = {bit_copy<glm::vec3>(*environment.sky_radiance()), bit_copy<glm::vec3>(*environment.ground_radiance())};
    frame.background = bit_copy<glm::vec3>(*environment.background_radiance());
    frame.fog = {environment.fog_density_per_m(), bit_copy<glm::vec3>(*environment.fog_radiance()),
                 static_cast<FogPath>(environment.fog_path())};
    frame.light_volumes = list(*table.light_volumes(), &Decoder::light_volume);
    frame.rain = rain(environment);
    frame.lens = lens(camera);
    frame.film = {camera.grain(), camera.fade(), camera.white()};
    frame.recorded_with = list(*table.recorded_with(), &Decoder::stage_choice);
    return frame;
}

/// What decoding would allocate for bulk data. One section has too few tables for the sum to wrap.
std::uint64_t bulk_bytes(const schema::Frame& table) {
    std::uint64_t sum = 0;
    const auto add = [&sum](const schema::Blob* blob) { sum += std::min(blob->bytes(), largest_frame_bytes + 1); };
    for (const schema::Texture* texture : *table.textures()) add(texture->texels());
    for (const schema::Emitter* emitter : *table.emitters()) add(emitter->particles());
    for (const schema::Mesh* mesh : *table.meshes()) {
        for (const schema::Blob* stream : {mesh->positions_m(), mesh->normals(), mesh->tangents(), mesh->uv0(), mesh->uv1(),
                                           mesh->colors(), mesh->indices()}) {
            add(stream);
        }
    }
    return sum;
}

/// What decoding allocates for tables, names among them: hostile files name one table a million times.
std::uint64_t table_bytes(const schema::Frame& table) {
    const auto each = [](const auto* list, std::size_t bytes) { return list->size() * (bytes + longest_text); };
    constexpr std::size_t light_lists = 2 * longest_light_list * sizeof(std::uint32_t) + 6 * sizeof(ClipPlane);
    std::uint64_t choices = each(table.recorded_with(), sizeof(StageChoice) + longest_text);
    for (const schema::StageChoice* choice : *table.recorded_with())
        choices += each(choice->settings(), sizeof(Setting) + longest_text);
    return choices + each(table.textures(), sizeof(Texture)) + each(table.meshes(), sizeof(Mesh)) +
           each(table.materials(), sizeof(Material)) + each(table.draws(), sizeof(Draw)) +
           each(table.emitters(), sizeof(Emitter)) + each(table.lights(), sizeof(Light) + light_lists) +
           each(table.blockers(), sizeof(Blocker)) + each(table.portals(), sizeof(Portal)) +
           each(table.light_volumes(), sizeof(LightVolume));
}

}  // namespace

Result<void> verify_frame(std::span<const std::byte> section) {
    // 2.0.8 asserts on larger ones; its offsets have 31 bits.
    if (section.size() >= FLATBUFFERS_MAX_BUFFER_SIZE)
        return fail(Fault::bad_input, "capture.frame.too_large", "the frame has {bytes} bytes; the limit is {most}",
                    section.size(), FLATBUFFERS_MAX_BUFFER_SIZE - 1);
    flatbuffers::Verifier verifier(reinterpret_cast<const std::uint8_t*>(section.data()), section.size(), deepest_nesting,
                                   most_tables);
    if (!schema::VerifyFrameBuffer(verifier))
        return fail(Fault::bad_input, "capture.frame.not_a_frame",
                    "the section is not a frame of this format, or has too many parts");
    if (bulk_bytes(*schema::GetFrame(section.data())) > largest_frame_bytes) {
        return fail(Fault::bad_input, "capture.frame.resources_too_large", "the resources take more than {most} bytes",
                    largest_frame_bytes);
    }
    return {};
}

Result<Frame> decode_frame(std::span<const std::byte> section, BlobStore& blobs, MemoryBudget& budget) {
    if (const Result<void> verified = verify_frame(section); !verified) return verified.error();
    const schema::Frame& table = *schema::GetFrame(section.data());
    const std::uint64_t bytes = bulk_bytes(table) + table_bytes(table);
    if (const auto room = budget.take(bytes, 1, "the frame"); !room) return room.error();
    const struct Taken {
        MemoryBudget& budget;
        std::uint64_t bytes;
        ~Taken() { budget.give_back(bytes); }
    } taken{budget, bytes};
    Decoder decoder(blobs);
    Frame frame = decoder.decode(table);
    if (decoder.error()) return *decoder.error();
    return frame;
}

}  // namespace strata
