#include "ui/frame/capture_tables.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include <fmt/core.h>

#include "capture_format/codec/texture_bytes.h"
#include "capture_format/enum_names.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/light_types.h"
#include "passes/graph/describe.h"
#include "ui/widgets/find_text.h"

namespace strata::ui {
namespace {

CaptureCell cell(std::string_view text) { return {std::string(text)}; }
CaptureCell cell(double value) { return {fmt::format("{:.4g}", value), value}; }
template <std::integral Whole>
CaptureCell cell(Whole value) {
    return {fmt::format("{}", value), static_cast<double>(value)};
}
CaptureCell yes_or_no(bool value) { return {value ? "yes" : "", value ? 1.0 : 0.0}; }
template <int n, typename T>
CaptureCell cell(const glm::vec<n, T>& value) {
    std::string text;
    for (int i = 0; i < n; ++i) text += fmt::format("{}{:.4g}", i > 0 ? " " : "", value[i]);
    return {text, static_cast<double>(glm::length(value))};
}
CaptureCell degrees(float radians) { return cell(double{radians} * 180 / std::numbers::pi); }
CaptureCell byte_cell(std::uint64_t bytes) { return {size_text(bytes), static_cast<double>(bytes)}; }

/// "3 glass": what a list has at an index.
template <typename T>
CaptureCell entry(const std::vector<T>& list, std::uint32_t index) {
    if (index == no_index) return {"", -1};
    return {fmt::format("{} {}", index, list[index].name), static_cast<double>(index)};
}

CaptureCell row_name(std::size_t index, std::string_view name) {
    return {fmt::format("{} {}", index, name), static_cast<double>(index)};
}

CaptureTable draws_of(const Frame& frame) {
    CaptureTable table{.name = "draws",
                       .help = "meshes drawn with a material, in the order of submission",
                       .columns = {{"draw", ""},
                                   {"mesh", ""},
                                   {"triangles", ""},
                                   {"material", ""},
                                   {"alpha", "alpha mode of its material"},
                                   {"position, m", "origin in world space; sorts by distance from the eye"},
                                   {"moved, m", "distance that its origin moved since the previous frame"},
                                   {"priority", "object-sorted transparency draws lower values first"},
                                   {"layer", "0 is the world; others are in-world interfaces, drawn in front"},
                                   {"resolution", ""},
                                   {"shadow", "whether it casts shadows"}},
                       .rows = {},
                       .first_draw = 0};
    for (std::size_t i = 0; i < frame.draws.size(); ++i) {
        const Draw& draw = frame.draws[i];
        const glm::dvec3 position(draw.to_world[3]);
        CaptureCell at = cell(position);
        at.number = glm::length(position - frame.view.origin);
        table.rows.push_back({row_name(i, draw.name), entry(frame.meshes, draw.mesh),
                              cell(frame.meshes[draw.mesh].indices.size() / 3), entry(frame.materials, draw.material),
                              cell(name(frame.materials[draw.material].alpha_mode)), std::move(at),
                              cell(glm::length(position - glm::dvec3(draw.previous_to_world[3]))), cell(draw.sort_priority),
                              cell(draw.layer), cell(name(draw.resolution)), yes_or_no(draw.casts_shadow)});
    }
    return table;
}

CaptureTable emitters_of(const Frame& frame) {
    CaptureTable table{.name = "emitters",
                       .help = "camera-facing particles, submitted after all draws",
                       .columns = {{"emitter", ""},
                                   {"particles", ""},
                                   {"alpha", "alpha mode of its particles"},
                                   {"texture", ""},
                                   {"soft fade, m", "distance over which particles fade in front of an opaque surface"},
                                   {"priority", "object-sorted transparency draws lower values first"},
                                   {"layer", "0 is the world; others are in-world interfaces, drawn in front"},
                                   {"resolution", ""}},
                       .rows = {},
                       .first_draw = static_cast<std::uint32_t>(frame.draws.size())};
    for (std::size_t i = 0; i < frame.emitters.size(); ++i) {
        const Emitter& emitter = frame.emitters[i];
        table.rows.push_back({row_name(i, emitter.name), cell(emitter.particles.size()), cell(name(emitter.alpha_mode)),
                              entry(frame.textures, emitter.texture), cell(emitter.soft_depth_fade), cell(emitter.sort_priority),
                              cell(emitter.layer), cell(name(emitter.resolution))});
    }
    return table;
}

CaptureTable meshes_of(const Frame& frame) {
    CaptureTable table{.name = "meshes",
                       .help = "triangles in object space",
                       .columns = {{"mesh", ""},
                                   {"triangles", ""},
                                   {"vertices", ""},
                                   {"streams", "beside positions"},
                                   {"draws", "draws that use it"}},
                       .rows = {}};
    std::vector<std::size_t> used(frame.meshes.size());
    for (const Draw& draw : frame.draws) ++used[draw.mesh];
    for (std::size_t i = 0; i < frame.meshes.size(); ++i) {
        const Mesh& mesh = frame.meshes[i];
        std::string streams;
        const auto add = [&](const auto& stream, const char* what) {
            if (!stream.empty()) streams += fmt::format("{}{}", streams.empty() ? "" : " ", what);
        };
        add(mesh.normals, "normals");
        add(mesh.tangents, "tangents");
        add(mesh.uv0, "uv0");
        add(mesh.uv1, "uv1");
        add(mesh.colors, "colors");
        table.rows.push_back(
            {row_name(i, mesh.name), cell(mesh.indices.size() / 3), cell(mesh.positions.size()), cell(streams), cell(used[i])});
    }
    return table;
}

CaptureTable materials_of(const Frame& frame) {
    CaptureTable table{.name = "materials",
                       .help = "materials of draws: reflection, transmission, textures",
                       .columns = {{"material", ""},
                                   {"model", "lighting model"},
                                   {"alpha", "alpha mode: opaque, mask, blend, premultiplied or additive"},
                                   {"base color", "linear red, green, blue, and alpha"},
                                   {"metallic", ""},
                                   {"roughness", ""},
                                   {"emissive", "radiance"},
                                   {"transmission", "color of the transmitted light"},
                                   {"two sides", ""},
                                   {"base texture", ""},
                                   {"normal texture", ""},
                                   {"draws", "draws that use it"}},
                       .rows = {}};
    std::vector<std::size_t> used(frame.materials.size());
    for (const Draw& draw : frame.draws) ++used[draw.material];
    for (std::size_t i = 0; i < frame.materials.size(); ++i) {
        const Material& m = frame.materials[i];
        table.rows.push_back({row_name(i, m.name), cell(name(m.lighting_model)), cell(name(m.alpha_mode)), cell(m.base_color),
                              cell(m.metallic), cell(m.roughness), cell(m.emissive), cell(m.transmission),
                              yes_or_no(m.double_sided), entry(frame.textures, m.base_color_texture.texture),
                              entry(frame.textures, m.normal_texture.texture), cell(used[i])});
    }
    return table;
}

/// How many materials, emitters and lights look each texture up.
std::vector<std::size_t> texture_uses(const Frame& frame) {
    std::vector<std::size_t> used(frame.textures.size());
    const auto count = [&](std::uint32_t texture) {
        if (texture != no_index) ++used[texture];
    };
    for (const Material& m : frame.materials)
        for (const TextureUse* use :
             {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emissive_texture, &m.occlusion_texture})
            count(use->texture);
    for (const Emitter& emitter : frame.emitters) count(emitter.texture);
    for (const Light& light : frame.lights) count(light.texture);
    return used;
}

CaptureTable textures_of(const Frame& frame) {
    CaptureTable table{.name = "textures",
                       .help = "textures stored in the capture",
                       .columns = {{"texture", ""},
                                   {"texels", "extent of the finest mip"},
                                   {"format", ""},
                                   {"mips", ""},
                                   {"address", "address mode beyond its edges"},
                                   {"filters", "between texels where magnified and where minified, and between mips"},
                                   {"bytes", "size of all mips"},
                                   {"uses", "uses by materials, emitters and lights"}},
                       .rows = {}};
    const std::vector<std::size_t> used = texture_uses(frame);
    for (std::size_t i = 0; i < frame.textures.size(); ++i) {
        const Texture& t = frame.textures[i];
        table.rows.push_back({row_name(i, t.name),
                              {fmt::format("{} x {}", t.width, t.height), static_cast<double>(t.width) * t.height},
                              cell(name(t.format)),
                              cell(t.mips),
                              cell(name(t.address)),
                              cell(fmt::format("{} {} {}", name(t.magnify), name(t.minify), name(t.between_mips))),
                              byte_cell(texture_bytes(t)),
                              cell(used[i])});
    }
    return table;
}

CaptureTable lights_of(const Frame& frame) {
    CaptureTable table{
        .name = "lights",
        .help = "all lights except the sun, which is in the table 'view and weather'",
        .columns = {{"light", ""},
                    {"type", ""},
                    {"position, m", "position in world space; sorts by distance from the eye"},
                    {"intensity", "point and spot: W/sr; directional: irradiance; area: radiance; negative: takes light away"},
                    {"range, m", "nothing is lit beyond it"},
                    {"window", "how the light ends at its range"},
                    {"angles, deg", "half angles, inner and outer"},
                    {"radius, m", "radius of the source, for soft shadows and highlights"},
                    {"shadow map", "texels along an edge; empty: the light casts no shadows"},
                    {"planes", "number of clip planes"},
                    {"blockers", ""},
                    {"portals", ""},
                    {"texture", "texture that it projects or emits"}},
        .rows = {}};
    for (std::size_t i = 0; i < frame.lights.size(); ++i) {
        const Light& light = frame.lights[i];
        CaptureCell at = cell(light.position);
        at.number = glm::length(light.position - frame.view.origin);
        CaptureCell angles = degrees(light.outer_angle);
        angles.text = is_spot(light.type) ? fmt::format("{} {}", degrees(light.inner_angle).text, angles.text) : "";
        table.rows.push_back({row_name(i, light.name), cell(name(light.type)), std::move(at), cell(light.intensity),
                              cell(light.range), cell(name(light.window)), std::move(angles), cell(light.source_radius),
                              light.shadow.casts ? cell(light.shadow.map_size) : CaptureCell{"", 0},
                              cell(light.clip_planes.size()), cell(light.blockers.size()), cell(light.portals.size()),
                              entry(frame.textures, light.texture)});
    }
    return table;
}

CaptureTable blockers_of(const Frame& frame) {
    CaptureTable table{.name = "blockers",
                       .help = "rectangles that stop light",
                       .columns = {{"blocker", ""},
                                   {"center, m", "in the world"},
                                   {"width, m", ""},
                                   {"height, m", ""},
                                   {"one side", "stops only light that arrives at its front"},
                                   {"portals", "number of holes in it"},
                                   {"lights", "number of lights that it stops"}},
                       .rows = {}};
    std::vector<std::size_t> holes(frame.blockers.size()), stopped(frame.blockers.size());
    for (const Portal& portal : frame.portals) ++holes[portal.blocker];
    for (const Light& light : frame.lights)
        for (const std::uint32_t blocker : light.blockers) ++stopped[blocker];
    for (std::size_t i = 0; i < frame.blockers.size(); ++i) {
        const Blocker& b = frame.blockers[i];
        table.rows.push_back({cell(i), cell(b.center), cell(2 * b.half_u), cell(2 * b.half_v), yes_or_no(b.one_sided),
                              cell(holes[i]), cell(stopped[i])});
    }
    return table;
}

CaptureTable portals_of(const Frame& frame) {
    CaptureTable table{
        .name = "portals",
        .help = "holes in blockers",
        .columns = {{"portal", ""}, {"center, m", "in the world"}, {"width, m", ""}, {"height, m", ""}, {"blocker", ""}},
        .rows = {}};
    for (std::size_t i = 0; i < frame.portals.size(); ++i) {
        const Portal& p = frame.portals[i];
        table.rows.push_back({cell(i), cell(p.center), cell(2 * p.half_u), cell(2 * p.half_v), cell(p.blocker)});
    }
    return table;
}

CaptureTable volumes_of(const Frame& frame) {
    CaptureTable table{.name = "light volumes",
                       .help = "grids in which light propagates from cell to cell",
                       .columns = {{"volume", ""},
                                   {"kind", ""},
                                   {"occlusion", ""},
                                   {"center, m", "in the world"},
                                   {"half extent, m", ""},
                                   {"cells", ""},
                                   {"cascades", ""},
                                   {"iterations", ""}},
                       .rows = {}};
    for (std::size_t i = 0; i < frame.light_volumes.size(); ++i) {
        const LightVolume& v = frame.light_volumes[i];
        table.rows.push_back({cell(i), cell(name(v.kind)), cell(name(v.occlusion)), cell(v.center), cell(v.half_extent),
                              cell(glm::dvec3(v.cells)), cell(v.cascades), cell(v.iterations)});
    }
    return table;
}

CaptureTable weather_of(const Frame& frame) {
    CaptureTable table{.name = "view and weather",
                       .help = "settings of the frame: view, sun, hemisphere, fog, rain, lens, film",
                       .columns = {{"what", ""}, {"value", ""}, {"unit", ""}},
                       .rows = {}};
    const auto add = [&](std::string_view what, CaptureCell value, std::string_view unit = "") {
        table.rows.push_back({cell(what), std::move(value), cell(unit)});
    };
    const View& view = frame.view;
    add("time", cell(frame.time), "s");
    add("frame of the application", cell(frame.index));
    add("seed", cell(frame.seed));
    add("view: extent", {fmt::format("{} x {}", view.width, view.height)}, "pixels");
    add("view: samples", cell(view.samples), "per pixel");
    add("view: eye", cell(view.origin), "m, world");
    add("view: looks along", cell(glm::transpose(view.to_view) * glm::dvec3(0, 0, 1)), "world");
    add("view: near plane", cell(view.near), "m");
    add("view: jitter", cell(view.jitter), "NDC");
    add("view: exposure", cell(view.exposure), "factor");
    add("background", cell(frame.background), "radiance");
    add("sun: direction", cell(frame.sun.direction), "where it shines");
    add("sun: irradiance", cell(frame.sun.irradiance), "W/m\xc2\xb2, perpendicular; 0: no sun");
    add("sun: angular radius", degrees(frame.sun.angular_radius), "degrees");
    add("sun: shadow", frame.sun.shadow.casts ? cell(frame.sun.shadow.map_size) : cell("none"), "texels along an edge");
    add("sun: cascades", cell(frame.sun.cascades));
    add("sun: shadow distance", cell(frame.sun.shadow_distance), "m of view depth");
    add("sun: shafts", yes_or_no(frame.sun.shafts));
    add("hemisphere: sky", cell(frame.hemisphere.sky), "radiance");
    add("hemisphere: ground", cell(frame.hemisphere.ground), "radiance");
    add("fog: density", cell(frame.fog.density), "per meter; 0: no fog");
    add("fog: path", cell(name(frame.fog.path)), "what its meters are counted along");
    add("fog: color", cell(frame.fog.color), "radiance");
    add("rain: intensity", cell(frame.rain.intensity), "0 none, 1 heavy");
    add("rain: wetness", cell(frame.rain.wetness), "0 dry, 1 soaked");
    add("rain: direction", cell(frame.rain.direction));
    add("lens: bloom", cell(frame.lens.bloom), "factor");
    add("lens: bloom threshold", cell(frame.lens.bloom_threshold), "radiance");
    add("lens: auto exposure", yes_or_no(frame.lens.auto_exposure));
    add("lens: exposure speed", cell(frame.lens.exposure_speed));
    add("lens: focus distance", cell(frame.lens.focus_distance), "m");
    add("lens: aperture", cell(frame.lens.aperture), "m; 0: a pinhole");
    add("lens: distortion", yes_or_no(frame.lens.distortion));
    add("film: grain", cell(frame.film.grain));
    add("film: fade", cell(frame.film.fade));
    add("film: white", cell(frame.film.white), "radiance that becomes white");
    return table;
}

}  // namespace

std::vector<CaptureTable> capture_tables(const Frame& frame) {
    return {draws_of(frame),  emitters_of(frame), meshes_of(frame),  materials_of(frame), textures_of(frame),
            lights_of(frame), blockers_of(frame), portals_of(frame), volumes_of(frame),   weather_of(frame)};
}

std::vector<std::size_t> rows_with(const CaptureTable& table, std::string_view text) {
    std::vector<std::size_t> rows;
    const auto has_text = [&](const CaptureCell& each) { return is_found_in(each.text, text); };
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (std::ranges::any_of(table.rows[i], has_text)) rows.push_back(i);
    return rows;
}

void sort_rows(const CaptureTable& table, std::size_t column, SortDirection direction, std::vector<std::size_t>& rows) {
    const auto is_before = [&](const CaptureCell& a, const CaptureCell& b) {
        return a.number && b.number ? *a.number < *b.number : a.text < b.text;
    };
    std::ranges::stable_sort(rows, [&](std::size_t a, std::size_t b) {
        const CaptureCell &first = table.rows[a][column], &second = table.rows[b][column];
        return direction == SortDirection::up ? is_before(first, second) : is_before(second, first);
    });
}

}  // namespace strata::ui
