#include "passes/rain/formulas.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "passes/reference/pcg.h"

namespace strata::rain {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// A whole number modulo 2^32, as hashes take it.
std::uint32_t wrapped(double whole) {
    const double rest = std::fmod(whole, 0x1p32);
    return static_cast<std::uint32_t>(rest < 0 ? rest + 0x1p32 : rest);
}

std::uint32_t hash_of(std::uint32_t key, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return pcg(pcg(pcg(key ^ x) ^ y) ^ z);
}

/// 24 bits of a hash, 0 to 1.
double unit_of(std::uint32_t word) { return double(word >> 8) / 0x1p24; }

double fifth_power_step(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Value noise at a place in cells: 0 to 1.
double value_noise(std::uint32_t key, const glm::dvec2& at) {
    const glm::dvec2 corner = glm::floor(at), part = at - corner;
    const auto lattice = [&](double x, double y) {
        return unit_of(hash_of(key, wrapped(corner.x + x), wrapped(corner.y + y), 0));
    };
    const double fx = fifth_power_step(part.x), fy = fifth_power_step(part.y);
    return glm::mix(glm::mix(lattice(0, 0), lattice(1, 0), fx), glm::mix(lattice(0, 1), lattice(1, 1), fx), fy);
}

/// Its change per cell along x, within one cell: a central difference of a polynomial of the fifth degree would err by its third
/// derivative, so the step's own derivative is written out.
double value_noise_slope(std::uint32_t key, const glm::dvec2& at) {
    const glm::dvec2 corner = glm::floor(at), part = at - corner;
    const auto lattice = [&](double x, double y) {
        return unit_of(hash_of(key, wrapped(corner.x + x), wrapped(corner.y + y), 0));
    };
    const double steepness = 30 * std::pow(part.x * (part.x - 1), 2);
    return steepness * glm::mix(lattice(1, 0) - lattice(0, 0), lattice(1, 1) - lattice(0, 1), fifth_power_step(part.y));
}

/// The derivative of (1 - x^2)^2 cos(2 pi x), 0 outside of -1..1.
double wave_slope(double x) {
    if (std::abs(x) >= 1) return 0;
    const double rest = 1 - x * x;
    return -4 * x * rest * std::cos(two_pi * x) - two_pi * rest * rest * std::sin(two_pi * x);
}

/// The ring of the drop that falls into a cell of the world.
glm::dvec2 gradient_of_cell(const Frame& frame, const glm::dvec2& cell, const glm::dvec2& place, double height) {
    const std::uint32_t x = wrapped(cell.x), z = wrapped(cell.y);
    const double turns = frame.time * double(ring_rate), offset = unit_of(hash_of(turn_key, x, z, 0));
    const double whole = std::floor(turns), turned = turns - whole + offset, phase = turned - std::floor(turned);
    const std::uint32_t drop = hash_of(drop_key, x, z, wrapped(whole + std::floor(turned)));
    if (unit_of(pcg(drop)) >= double(frame.rain.intensity)) return {};
    const glm::dvec2 falls = (cell + glm::dvec2(drop & 0xffffu, drop >> 16) / 65536.0) / double(ring_cells);
    const double distance = glm::length(place - falls);
    if (distance == 0) return {};
    const double crest = double(ring_radius) * phase, width = double(ring_width);
    const double fade = 27.0 / 4 * phase * std::pow(1 - phase, 2);  // 1 at its highest
    return height * fade * wave_slope((distance - crest) / width) / width * (place - falls) / distance;
}

double flow_steps(double up) { return std::clamp(std::ceil(10 * (1 - up)), 0.0, 10.0); }

/// Change of the water's height across streams, at a place across and up a face.
double stream_slope(const Frame& frame, std::uint32_t key, const glm::dvec2& place, double steps, double height) {
    const double moved = place.y * double(flow_lengths) + steps * (frame.time * double(flow_rate));
    return height * double(flow_cells) * value_noise_slope(key, {place.x * double(flow_cells), moved});
}

/// What waves add to a normal, world space.
glm::dvec3 bent_by_waves(const Frame& frame, const glm::dvec3& normal, const glm::dvec3& world, const Look& look,
                         const Shown& shown) {
    const double up = std::max(0.0, -glm::dot(glm::dvec3(frame.rain.direction), normal));
    const double steps = flow_steps(up), streams = double(frame.rain.intensity) * shown.streams;
    const glm::dvec2 rings = up * shown.rings * ring_gradient(frame, world, look.ripple_height);
    const double across_z = stream_slope(frame, flow_z_key, {world.z, world.y}, steps, look.flow_height);
    const double across_x = stream_slope(frame, flow_x_key, {world.x, world.y}, steps, look.flow_height);
    return -glm::dvec3(rings.x + streams * std::abs(normal.z) * across_x, 0, rings.y + streams * std::abs(normal.x) * across_z);
}

void color_by_brightness(SurfacePoint& p, double wet) {
    const double g = wet * 0.33 * (p.base_color.x + p.base_color.y + p.base_color.z);
    p.base_color *= std::max(0.5, 1 - std::sqrt(g));
    p.roughness = 1 - std::min(1.0, 1 - p.roughness + 0.8 * g);
}

void color_by_porosity(SurfacePoint& p, double wet, double puddle, const Look& look) {
    const double porosity = std::clamp((p.roughness - 0.5) / 0.4, 0.0, 1.0);
    const double g = std::max(wet * porosity, puddle) * (1 - p.metallic);
    p.base_color *= glm::mix(1.0, look.albedo, g);
    p.roughness = 1 - std::max(1 - p.roughness, g * look.gloss);
}

}  // namespace

glm::dvec3 to_world(const Frame& frame, const glm::dvec3& position) {
    return frame.view.origin + glm::transpose(frame.view.to_view) * position;
}

double slope_weight(double up) { return std::clamp(10 * up + 5.5, 0.0, 1.0); }

double cosine_to_rain(const Frame& frame, const glm::dvec3& normal) {
    return -glm::dot(frame.view.to_view * glm::dvec3(frame.rain.direction), normal);
}

bool is_between_flow_steps(double up) {
    const double tenths = 10 * (1 - std::max(up, 0.0));
    return tenths < 9.5 && std::abs(tenths - std::round(tenths)) < 1e-3;
}

glm::dvec2 ring_gradient(const Frame& frame, const glm::dvec3& world, double height) {
    const glm::dvec2 place(world.x, world.z), own = glm::floor(place * double(ring_cells));
    glm::dvec2 sum(0);
    for (int z = -1; z <= 1; ++z)
        for (int x = -1; x <= 1; ++x) sum += gradient_of_cell(frame, own + glm::dvec2(x, z), place, height);
    return sum;
}

double puddle_at(const glm::dvec3& world, double amount) {
    const glm::dvec2 place(world.x, world.z);
    const double coarse = value_noise(puddle_key, place * double(puddle_cells));
    const double fine = value_noise(fine_puddle_key, place * double(fine_puddle_cells));
    const double level = double(puddle_share) * amount;
    if (level <= 0) return 0;
    return std::clamp((level - (2 * coarse + fine) / 3) / double(puddle_rim), 0.0, 1.0);
}

SurfacePoint wet_surface(const Frame& frame, const SurfacePoint& dry, const Look& look, double arriving, const Shown& shown) {
    const glm::dvec3 facing = facing_normal(dry), normal = glm::transpose(frame.view.to_view) * facing;
    const double rain = arriving * slope_weight(cosine_to_rain(frame, facing));
    if (dry.model == LightingModel::unlit || rain <= 0) return dry;
    const glm::dvec3 world = to_world(frame, dry.position);
    const double wet = rain * double(frame.rain.wetness);
    const double level = std::pow(std::max(0.0, normal.y), 4);
    const double puddle = rain * level * puddle_at(world, look.puddles * double(frame.rain.wetness));
    SurfacePoint p = dry;
    if (look.form == form_xray) color_by_brightness(p, wet);
    else color_by_porosity(p, wet, puddle, look);
    p.roughness = glm::mix(p.roughness, std::min(p.roughness, 1 - double(puddle_gloss)), puddle);
    if (dry.model == LightingModel::hair) return p;
    const glm::dvec3 leveled = glm::mix(normal, glm::dvec3(0, 1, 0), puddle);
    const glm::dvec3 bent = leveled + rain * bent_by_waves(frame, normal, world, look, shown);
    p.normal = frame.view.to_view * glm::normalize(bent);
    return p;
}

}  // namespace strata::rain
