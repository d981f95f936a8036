// Where the bodies are and what they look like.
#include "consumer/crowd.h"

#include <cmath>
#include <random>

namespace consumer {

Crowd::Crowd(std::size_t count, Motion motion) {
    std::mt19937_64 bits(1);  // the same everywhere; the standard's distributions are not
    const auto between = [&](double low, double high) {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    };
    for (std::size_t i = 0; i < count; ++i) {
        Body body{.position = {between(-room, room), between(-room, room), between(nearest, nearest + 2 * room)},
                  .velocity = {between(-2, 2), between(-2, 2), between(-2, 2)},
                  .axis = {between(-1, 1), between(-1, 1), between(-1, 1)},
                  .shape = i % shape_count,
                  .paint = i * 7 % paint_count};
        const double length = std::hypot(body.axis[0], body.axis[1], body.axis[2]);
        for (double& coordinate : body.axis) coordinate /= length;
        if (motion == Motion::spinning) body.turn_rate = between(.5, 3);
        bodies.push_back(body);
    }
}

void Crowd::step(double seconds) {
    time += seconds;
    for (Body& body : bodies) {
        body.angle += body.turn_rate * seconds;
        for (std::size_t i = 0; i < 3; ++i) {
            const double low = i == 2 ? nearest : -room, high = low + 2 * room;
            double& x = body.position[i];
            x += body.velocity[i] * seconds;
            if (x >= low && x <= high) continue;
            x = 2 * (x < low ? low : high) - x;
            body.velocity[i] = -body.velocity[i];
        }
    }
}

Placement placed(const Body& body) {
    const auto& [x, y, z] = body.axis;
    const double c = std::cos(body.angle), s = std::sin(body.angle), d = 1 - c;
    return {{{c + d * x * x, d * x * y + s * z, d * x * z - s * y},
             {d * x * y - s * z, c + d * y * y, d * y * z + s * x},
             {d * x * z + s * y, d * y * z - s * x, c + d * z * z},
             body.position}};
}

std::vector<Placement> placements_of(const Crowd& crowd) {
    std::vector<Placement> placements;
    placements.reserve(crowd.bodies.size());
    for (const Body& body : crowd.bodies) placements.push_back(placed(body));
    return placements;
}

Vec3 half_size(std::size_t shape) {
    const double edge = .1 + .03 * static_cast<double>(shape);
    return {edge, edge * (shape % 2 ? 1.5 : 1), edge * (shape % 3 ? .75 : 1)};
}

std::array<float, 3> paint_at(std::size_t paint, double time) {
    const double hue = static_cast<double>(paint) * .4, pulse = paint % 2 ? .75 + .25 * std::sin(3 * time + hue) : 1;
    const auto channel = [&](double phase) { return static_cast<float>(pulse * (.5 + .4 * std::cos(hue + phase))); };
    return {channel(0), channel(2), channel(4)};
}

std::vector<std::uint32_t> screen_at(std::uint64_t frame) {
    std::vector<std::uint32_t> texels(screen_extent * screen_extent, 0xff20'1008);
    for (std::size_t x = 0; x < screen_extent; ++x) {
        const double wave = std::sin(.3 * static_cast<double>(x) + .2 * static_cast<double>(frame));
        const auto row = static_cast<std::size_t>((.5 + .45 * wave) * static_cast<double>(screen_extent));
        texels[row * screen_extent + x] = 0xff40'ff80;
    }
    return texels;
}

}  // namespace consumer
