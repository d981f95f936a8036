// Wet surfaces in double, from docs/algorithms/deferred.md 7: the map by rays, the taps by the noise's definition, water by
// passes/rain/formulas.h, base color and roughness as every layout keeps them.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "capture_format/frame/frame.h"
#include "capture_format/result.h"
#include "passes/edges/plain_pixels.h"
#include "passes/gbuffer/codes.h"
#include "passes/rain/formulas.h"
#include "passes/rain/wetness/traced_map_model.h"
#include "passes/rain/wetness/wetness.shared.h"
#include "passes/reference/decoded.h"
#include "passes/reference/pcg.h"
#include "passes/settings.h"
#include "passes/stage_input.h"

namespace strata::rain {
namespace {

// How far floats of the device may be from the numbers here: positions in meters, per meter from the eye.
constexpr double rounding = 4e-6;

struct Scene {
    const StageInput& input;
    WetnessParams params;
    Look look;
    CastersInRain casters;
    std::vector<TracedMap> maps;  ///< one for each direction of the rain

    Scene(const StageInput& given, const WetnessParams& settings)
        : input(given),
          params(settings),
          look{.form = settings.form,
               .albedo = double(settings.albedo),
               .gloss = double(settings.gloss),
               .ripple_height = double(settings.ripple_height) * 1e-3,
               .flow_height = double(settings.flow_height) * 1e-3,
               .puddles = double(settings.puddles)},
          casters(given.frame, settings) {
        for (const glm::dvec3& direction : falling_directions(given.frame, settings))
            maps.emplace_back(casters, given.frame, settings, direction);
    }
};

struct Arriving {
    double share = 1;
    bool undecided = false;
};

// --- taps -------------------------------------------------------------------------------------------------------------------

std::uint32_t noise_of(const glm::dvec3& cell) {
    const auto wrapped = [](double whole) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)); };
    return pcg(pcg(pcg(tap_key ^ wrapped(cell.x)) ^ wrapped(cell.y)) ^ wrapped(cell.z));
}

double disc_radius(const WetnessParams& params, double lean) {
    return params.jitter == jitter_none ? std::sqrt(0.5) : double(params.radius) * (1 - double(disc_loss) * lean);
}

/// In texels; `disc` is the radius.
glm::dvec2 tap_offset(const WetnessParams& params, std::uint32_t noise, std::uint32_t tap, double disc) {
    if (params.jitter == jitter_none) return glm::dvec2(tap % 2, tap / 2) - 0.5;
    const std::uint32_t word = pcg(noise + tap);
    const double around = (tap + (word & 0xffffu) / 65536.0) * std::numbers::pi / 2;
    const double away = disc * std::sqrt(((word >> 16) + 0.5) / 65536.0);
    return away * glm::dvec2(std::cos(around), std::sin(around));
}

/// A tap between two texels, but for rounding, may read either.
Reached tap(const TracedMap& map, const glm::dvec2& at, double depth, double doubt) {
    const double slack = doubt / map.texel() + 5e-4;
    const glm::ivec2 texel(glm::floor(at));
    Reached result = map.is_reached(texel, depth, doubt);
    for (const glm::dvec2 aside : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
        const glm::ivec2 other(glm::floor(at + slack * aside));
        if (other != texel && map.is_reached(other, depth, doubt).open != result.open) result.undecided = true;
    }
    return result;
}

/// The cells of the noise that a place may be in.
std::vector<glm::dvec3> cells_at(const glm::dvec3& world, double distance) {
    const glm::dvec3 scaled = world * double(noise_cells) + double(noise_shift);
    const double slack = (rounding * distance + 1e-6) * double(noise_cells);
    std::vector<glm::dvec3> cells{glm::floor(scaled)};
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const glm::dvec3 aside = glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2) * 2.0 - 1.0;
        const glm::dvec3 cell = glm::floor(scaled + slack * aside);
        if (std::ranges::find(cells, cell) == cells.end()) cells.push_back(cell);
    }
    return cells;
}

/// A place of a rain map around which taps lie.
struct Taps {
    const TracedMap& map;
    glm::dvec3 at;
    double disc;  ///< radius in texels
};

Taps taps_around(const Scene& scene, const TracedMap& map, const SurfacePoint& p) {
    const glm::dvec3 normal = facing_normal(p);
    const double up = glm::dot(normal, map.along()), lean = std::sqrt(std::max(0.0, 1 - up * up));
    const double disc = disc_radius(scene.params, lean), aside = (disc + 1) * map.texel() * lean;
    return {map, map.place(p.position + normal * aside), disc};
}

/// Of four taps those that rain reaches, from 0 to 1.
Arriving share_of_taps(const Scene& scene, const Taps& taps, std::uint32_t noise, double doubt) {
    Arriving result{.share = 0};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const glm::dvec2 place = glm::dvec2(taps.at) + tap_offset(scene.params, noise, i, taps.disc);
        const Reached reached = tap(taps.map, place, taps.at.z - double(scene.params.bias), doubt);
        result.share += reached.open ? .25 : 0;
        result.undecided = result.undecided || reached.undecided;
    }
    return result;
}

/// The share of a direction's rain that falls on the front of a surface.
double share_in_front(const Scene& scene, const TracedMap& map, const SurfacePoint& p) {
    if (scene.maps.size() == 1) return 1;
    return std::clamp(.5 - glm::dot(facing_normal(p), map.along()) / double(grazing_width), 0., 1.);
}

/// The mean of all directions.
Arriving looked_up(const Scene& scene, const SurfacePoint& p) {
    const double distance = glm::length(p.position), doubt = 1e-4 + rounding * (1 + distance);
    Arriving result;
    std::vector<double> shares;
    for (const glm::dvec3& cell : cells_at(to_world(scene.input.frame, p.position), distance)) {
        double sum = 0;
        for (std::uint32_t i = 0; i < scene.maps.size(); ++i) {
            const Arriving one = share_of_taps(scene, taps_around(scene, scene.maps[i], p), noise_of(cell) + 4 * i, doubt);
            const double front = share_in_front(scene, scene.maps[i], p);
            sum += one.share * front;
            result.undecided = result.undecided || (one.undecided && front > 0);
        }
        shares.push_back(sum / double(scene.maps.size()));
    }
    result.share = shares.front();
    result.undecided = result.undecided || std::ranges::any_of(shares, [&](double share) { return share != shares.front(); });
    return result;
}

// --- fading -----------------------------------------------------------------------------------------------------------------

Arriving arriving_at(const Scene& scene, const SurfacePoint& p) {
    const double reach = double(scene.params.reach), begin = reach * double(scene.params.fade);
    const double t = std::clamp((p.position.z - begin) / (reach - begin), 0.0, 1.0), known = std::pow(1 - t * t * (3 - 2 * t), 2);
    const double beyond = scene.params.beyond == beyond_open ? 1 : 0;
    if (known == 0) return {beyond};
    const Arriving found = looked_up(scene, p);
    return {glm::mix(beyond, found.share, known), found.undecided};
}

Shown shown_at(const Scene& scene, const SurfacePoint& p) {
    if (scene.params.ripple_filter == 0) return {};
    const View& view = scene.input.frame.view;
    const double cosine = std::max(0.1, std::abs(glm::dot(facing_normal(p), glm::normalize(p.position))));
    const double footprint = p.position.z * 2 / (std::abs(double(view.projection[1][1])) * view.height) / cosine;
    const auto share = [&](double size) { return std::clamp(2 - footprint / size, 0.0, 1.0); };
    return {.rings = share(double(ring_width)), .streams = share(1 / double(flow_cells))};
}

// --- images -----------------------------------------------------------------------------------------------------------------

struct Wet {
    bool is_wet = false, undecided = false;
    SurfacePoint point;
};

/// Whether rounding decides which code of 8 bits stores the roughness. Rain of 5/8, as several directions make it, gives 127.5.
bool is_between_codes(double roughness) {
    const double codes = 255 * roughness;
    return std::abs(codes - std::floor(codes) - 0.5) < 1e-4;
}

Wet wet_at(const Scene& scene, const DecodedTexels& texels, std::uint32_t x, std::uint32_t y) {
    if (texels.normal.w <= 0) return {};
    const SurfacePoint dry = decoded_surface(scene.input.frame, texels, x, y);
    const double up = cosine_to_rain(scene.input.frame, facing_normal(dry));
    if (dry.model == LightingModel::unlit || slope_weight(up) <= 0) return {};
    const Arriving arriving = arriving_at(scene, dry);
    Wet wet{.is_wet = arriving.share > 0, .undecided = arriving.undecided || is_between_flow_steps(up)};
    if (!wet.is_wet) return wet;
    const SurfacePoint exact = wet_surface(scene.input.frame, dry, scene.look, arriving.share, shown_at(scene, dry));
    wet.undecided = wet.undecided || is_between_codes(exact.roughness);
    wet.point = gbuffer::stored_color(exact);
    return wet;
}

}  // namespace

ImageSet wetness_model(const StageInput& input, const Settings& settings) {
    const auto found = input.before.find("surface_normal");
    if (found == input.before.end()) return {};
    const Scene scene(input, settings.as<WetnessParams>());
    ReferenceImage normal = found->second, color = input.before.at("surface_color"),
                   material = input.before.at("surface_material");
    std::vector<bool> undecided(normal.texels.size());
    for (std::uint32_t y = 0; y < normal.height; ++y)
        for (std::uint32_t x = 0; x < normal.width; ++x) {
            Wet wet;
            for (std::uint32_t sample = 0; sample < normal.layers; ++sample) {
                const std::size_t i = normal.index(x, y, sample);
                const bool repeats = sample > 0 && is_plain_pixel(input, x, y);
                if (!repeats) wet = wet_at(scene, {normal.texels[i], color.texels[i], material.texels[i]}, x, y);
                undecided[i] = wet.undecided;
                if (!wet.is_wet) continue;
                normal.texels[i] = glm::dvec4(wet.point.normal, normal.texels[i].w);
                color.texels[i] = glm::dvec4(wet.point.base_color, wet.point.roughness);
            }
        }
    ImageSet images{{"surface_color", color}, {"surface_normal", normal}, {"surface_material", material}};
    for (auto& [name, image] : images) image.undecided = undecided;
    return images;
}

}  // namespace strata::rain
