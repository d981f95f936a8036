#include "passes/gbuffer/codes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "passes/reference/textures.h"

namespace strata::gbuffer {
namespace {

constexpr double smallest_normal = 0x1p-14, largest_half = 65504;
constexpr std::uint32_t codes_per_sign = 30720, first_normal = 0x0400, first_negative_normal = 0x8400;

/// The nearest of levels + 1 equal steps of 0..1, as its number.
std::uint32_t level(double value, std::uint32_t levels) {
    return static_cast<std::uint32_t>(std::floor(std::clamp(value, 0.0, 1.0) * levels + 0.5));
}

/// The material numbers that a lighting model has.
struct MaterialNumbers {
    std::uint32_t first, count;
};

/// Models with metals have 58 numbers each and come first; within both groups the order is the enumerators'.
MaterialNumbers numbers_of(LightingModel model) {
    std::uint32_t first = 0;
    for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(last_lighting_model); ++i) {
        const auto other = static_cast<LightingModel>(i);
        const bool before = has_metals(other) == has_metals(model) ? other < model : has_metals(other);
        if (before) first += has_metals(other) ? 58 : 1;
    }
    return {first, has_metals(model) ? 58u : 1u};
}

LightingModel model_of(std::uint32_t number) {
    for (std::uint32_t i = 0; i <= static_cast<std::uint32_t>(last_lighting_model); ++i) {
        const auto model = static_cast<LightingModel>(i);
        const MaterialNumbers numbers = numbers_of(model);
        if (number >= numbers.first && number < numbers.first + numbers.count) return model;
    }
    assert(false && "no lighting model has this number");
    return LightingModel::unlit;
}

}  // namespace

std::uint16_t half_bits(double value) {
    const std::uint32_t sign = std::signbit(value) ? 0x8000u : 0u;
    const double size = std::abs(value);
    if (size >= 65520) return static_cast<std::uint16_t>(sign | 0x7c00u);
    const int exponent = size == 0 ? -14 : std::max(std::ilogb(size), -14);
    // Steps of 2^(exponent - 10); 2048 of them are the next exponent's first half float, which the sum below gives by itself.
    const auto steps = static_cast<std::uint32_t>(std::nearbyint(std::ldexp(size, 10 - exponent)));
    return static_cast<std::uint16_t>(sign | (static_cast<std::uint32_t>(exponent + 14) * 1024 + steps));
}

double half_value(std::uint16_t bits) {
    const int exponent = (bits >> 10) & 31, fraction = bits & 1023;
    double size = 0;
    if (exponent == 31) size = fraction == 0 ? HUGE_VAL : NAN;
    else size = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
    return (bits & 0x8000) != 0 ? -size : size;
}

std::uint16_t half_of_code(std::uint32_t code) {
    assert(code < code_count);
    return static_cast<std::uint16_t>(code < codes_per_sign ? code + first_normal
                                                            : code - codes_per_sign + first_negative_normal);
}

std::uint32_t code_of_half(std::uint16_t bits) { return (bits & 0x7fffu) - first_normal + (bits >> 15) * codes_per_sign; }

double nearest_half(double value) {
    const double size = std::abs(value);
    double rounded = 0;
    if (size < smallest_normal) rounded = size < smallest_normal / 2 ? 0 : smallest_normal;
    else rounded = half_value(half_bits(std::min(size, largest_half)));
    return std::copysign(rounded, value);
}

std::uint32_t material_code(const SurfacePoint& p) {
    const MaterialNumbers numbers = numbers_of(p.model);
    return (numbers.first + level(p.metallic, numbers.count - 1)) * 256 + level(p.occlusion, 255);
}

SurfacePoint stored_color(SurfacePoint p) {
    for (int c = 0; c < 3; ++c)
        p.base_color[c] = srgb_to_linear(level(linear_to_srgb(std::clamp(p.base_color[c], 0.0, 1.0)), 255) / 255.0);
    p.roughness = level(p.roughness, 255) / 255.0;
    return p;
}

SurfacePoint stored_material(SurfacePoint p) {
    const std::uint32_t code = code_of_half(half_of_code(material_code(p)));
    p.occlusion = double(code % 256) / 255;
    const MaterialNumbers numbers = numbers_of(p.model = model_of(code / 256));
    p.metallic = numbers.count == 1 ? 0 : double(code / 256 - numbers.first) / (numbers.count - 1);
    return stored_color(p);
}

}  // namespace strata::gbuffer
