// Frames with many lights, blockers and portals around what a scenario shows, and runs of lighting techniques on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "capture_format/frame.h"
#include "passes/stages.h"
#include "replay/images/image_io.h"
#include "replay/scene/scene_records.h"
#include "tests/support/random_numbers.h"
#include "tests/support/session.h"

namespace strata {

/// A scenario in a picture of 96 x 54, or its own where that is narrower.
inline Frame at_most_96(std::string_view scenario, std::uint32_t samples) {
    Frame frame = scenario_frames(scenario, samples).front();
    if (frame.view.width > 96) frame.view.width = 96, frame.view.height = 54;
    return frame;
}

/// A scenario in a picture of 64 x 36 without its lights.
inline Frame dark_frame(std::string_view scenario, std::uint32_t samples = 1) {
    Frame frame = scenario_frames(scenario, samples).front();
    frame.view.width = 64, frame.view.height = 36;
    frame.lights.clear(), frame.blockers.clear(), frame.portals.clear();
    frame.sun.irradiance = glm::vec3(0);
    return frame;
}

/// The scenarios of the lighting stage whose frames have lights: the others never get there.
inline std::vector<std::string_view> lit_scenarios() {
    std::vector<std::string_view> lit;
    for (const std::string_view scenario : info(Stage::lighting).scenarios)
        if (!info(Stage::lighting).unwanted(frame_features(scenario_frames(scenario).front()))) lit.push_back(scenario);
    return lit;
}

inline glm::dvec3 to_world(const Frame& frame, const glm::dvec3& in_view) {
    return frame.view.origin + glm::transpose(frame.view.to_view) * in_view;
}

class RandomLights {
public:
    explicit RandomLights(unsigned seed) : numbers(seed) {}

    /// Within the view.
    glm::dvec3 place(const Frame& frame) {
        const double z = numbers.from(1, 12);
        return to_world(frame, {z * numbers.from(-.9f, .9f), z * numbers.from(-.5f, .5f), z});
    }

    Light light(const Frame& frame, LightType type, float range) {
        Light light;
        light.type = type;
        light.position = place(frame);
        light.direction = numbers.direction();
        light.axis_u = numbers.across(light.direction);
        light.range = range;
        light.window = RangeWindow{lights_++ % 2};
        light.intensity = {numbers.from(.2f, 4), numbers.from(.2f, 4), numbers.from(.2f, 4)};
        light.outer_angle = numbers.from(.2f, 1.2f), light.inner_angle = light.outer_angle * numbers.from(0, .9f);
        return light;
    }

    /// Lights without blockers.
    void add_lights(Frame& frame, std::size_t count, float range) {
        for (std::size_t i = 0; i < count; ++i)
            frame.lights.push_back(light(frame, LightType::omni, numbers.from(.1f, 1) * range));
    }

    /// A light with up to so many blockers, and up to two portals in each.
    void add_blocked_light(Frame& frame, std::uint32_t most_blockers) {
        constexpr LightType types[] = {LightType::omni, LightType::round_spot, LightType::square_spot, LightType::directional};
        Light lamp = light(frame, types[numbers.below(4)], numbers.from(3, 20));
        for (std::uint32_t i = numbers.below(most_blockers + 1); i > 0; --i) {
            lamp.blockers.push_back(static_cast<std::uint32_t>(frame.blockers.size()));
            frame.blockers.push_back(blocker(frame));
            for (std::uint32_t k = numbers.below(3); k > 0 && lamp.portals.size() < 32; --k) {
                lamp.portals.push_back(static_cast<std::uint32_t>(frame.portals.size()));
                frame.portals.push_back(portal(frame.blockers.back(), lamp.blockers.back()));
            }
        }
        frame.lights.push_back(lamp);
    }

    Numbers numbers;

private:
    std::uint32_t lights_ = 0;  ///< made so far
    Blocker blocker(const Frame& frame) {
        Blocker wall;
        wall.center = place(frame);
        wall.u = numbers.direction();
        wall.v = numbers.across(wall.u);
        wall.half_u = numbers.from(.2f, 3), wall.half_v = numbers.from(.2f, 3);
        wall.one_sided = numbers.below(4) == 0;
        return wall;
    }

    Portal portal(const Blocker& wall, std::uint32_t index) {
        const float turn = numbers.from(0, 6.2831853f);
        Portal door;
        door.blocker = index;
        door.center = wall.center + glm::dvec3(wall.u * numbers.from(-wall.half_u, wall.half_u)) +
                      glm::dvec3(wall.v * numbers.from(-wall.half_v, wall.half_v));
        door.u = wall.u * std::cos(turn) + wall.v * std::sin(turn);
        door.v = wall.v * std::cos(turn) - wall.u * std::sin(turn);
        door.half_u = numbers.from(0, wall.half_u), door.half_v = numbers.from(0, wall.half_v);
        return door;
    }
};

/// What a lighting technique makes of a frame; further outputs are views and tables of its own by their names.
inline Run lit(const Frame& frame, const std::string& technique, std::vector<std::string> sets = {},
               const std::vector<std::string>& inside = {}) {
    Request request{.choices = chosen({technique}, std::move(sets)), .outputs = {"light"}};
    for (const std::string& name : inside) request.outputs.push_back(technique + ":" + name);
    return must(session_of_scenarios().run(frame, std::span(&request, 1))).front();
}

inline std::uint64_t count_of(const Run& run, std::string_view name) {
    for (const CounterRecord& counter : run.counters)
        if (counter.technique.starts_with("lighting/") && counter.name == name) return counter.value;
    throw std::runtime_error(fmt::format("no counter {}", name));
}

/// Texels of rgba16f that are not the same to the last bit.
inline std::size_t differing_texels(const Run& a, const Run& b) {
    const HostImage &left = a.images.at("light"), &right = b.images.at("light");
    if (left.texels.size() != right.texels.size()) throw std::runtime_error("pictures of two sizes");
    constexpr std::size_t texel = 8;
    std::size_t differing = 0;
    for (std::size_t at = 0; at < left.texels.size(); at += texel)
        differing += !std::equal(left.texels.begin() + std::ptrdiff_t(at), left.texels.begin() + std::ptrdiff_t(at + texel),
                                 right.texels.begin() + std::ptrdiff_t(at));
    return differing;
}

/// Texels that are lit at all: two dark pictures are equal without having been compared.
inline std::size_t lit_texels(const Run& run) {
    const ReferenceImage light = in_double(run.images.at("light"));
    return std::size_t(std::ranges::count_if(light.texels, [](const glm::dvec4& t) { return t.x != 0 || t.y != 0 || t.z != 0; }));
}

}  // namespace strata
