// The consumer's world: boxes that fly straight on and bounce off the walls of a room, paints that pulse, a screen that changes
// with every frame. Plain numbers of its own and no type of Strata, as in any engine that was there before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace consumer {

using Vec3 = std::array<double, 3>;
/// Three columns of a rotation and the position, meters.
using Placement = std::array<Vec3, 4>;

/// What else a body does than fly.
enum class Motion { straight, spinning };

struct Body {
    Vec3 position, velocity;          ///< m, m/s
    Vec3 axis;                        ///< of its rotation, unit
    double angle = 0, turn_rate = 0;  ///< rad, rad/s
    std::size_t shape = 0, paint = 0;
};

inline constexpr std::size_t shape_count = 8, paint_count = 16, screen_extent = 32;
/// The walls: x and y within +-room, z from near to near + 2 room.
inline constexpr double room = 10, nearest = 6;

struct Crowd {
    Crowd(std::size_t count, Motion);
    /// A time step as games take it, sum by sum.
    void step(double seconds);

    std::vector<Body> bodies;
    double time = 0;
};

Placement placed(const Body&);
std::vector<Placement> placements_of(const Crowd&);
/// Half edges of a box, meters.
Vec3 half_size(std::size_t shape);
/// Red, green, blue; every second one pulses.
std::array<float, 3> paint_at(std::size_t paint, double time);
/// RGBA texels, rows top to bottom: a scope's line that wanders with the frame.
std::vector<std::uint32_t> screen_at(std::uint64_t frame);

}  // namespace consumer
