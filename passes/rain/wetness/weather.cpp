#include "passes/rain/wetness/weather.h"

#include <cmath>

#include "capture_format/frame/frame.h"

namespace strata::rain {
namespace {

std::uint32_t low_bits(double whole) {
    const double rest = std::fmod(whole, 0x1p32);
    return static_cast<std::uint32_t>(rest < 0 ? rest + 0x1p32 : rest);
}

}  // namespace

Turns turns_of(double time, double rate) {
    const double turns = time * rate, whole = std::floor(turns);
    return {low_bits(whole), static_cast<float>(turns - whole)};
}

RainRecord record_of(const RainMap& map, const WetnessParams& params) {
    const glm::dvec4 biased = map.depth + glm::dvec4(0, 0, 0, double(params.bias) / map.range);
    return {.u = glm::vec4(map.u),
            .v = glm::vec4(map.v),
            .depth = glm::vec4(biased),
            .towards_rain = glm::vec3(map.towards_rain),
            .texel = static_cast<float>(map.texel)};
}

WetnessPush weather_push(const Frame& frame, const RainMap& map, const WetnessParams& params) {
    constexpr double cube = 4;  // meters
    const glm::dvec3 whole = glm::floor(frame.view.origin / cube);
    const Turns rings = turns_of(frame.time, double(ring_rate)), flow = turns_of(frame.time, double(flow_rate));
    RainRecord record = record_of(map, params);
    record.towards_rain = glm::vec3(-(frame.view.to_view * glm::dvec3(frame.rain.direction)));
    return {.map = record,
            .cubes = {low_bits(whole.x), low_bits(whole.y), low_bits(whole.z)},
            .place = glm::vec3(frame.view.origin - cube * whole),
            .ring_turns = rings.whole,
            .ring_phase = rings.rest,
            .flow_turns = flow.whole,
            .flow_phase = flow.rest,
            .wetness = frame.rain.wetness,
            .intensity = frame.rain.intensity};
}

}  // namespace strata::rain
