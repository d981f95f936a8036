// A courtyard in the sun: paving and plaster bounce the light into the arcade behind the columns. Light volumes follow the eye,
// which walks towards the corner where the arcade's two arms meet. In that corner lies a store room behind a closed door: no
// light reaches it.
//
//   z = -8  +------+---------------------+   y up, meters; the sun comes over the right and the front wall
//           |store |   arcade            |
//   z = -5  +------#--o----o----o----o---#   # piers, o columns; arches between them and a storey above
//           |      |                     |
//           |      o                     |
//           |arcade|        court        |
//           |      o                     |
//   z = 5   +------#---------------------+
//          x = -8  -5                    5
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr double court = 5, outside = 8;             // half of the court's width; from its middle to the arcade's outer wall
constexpr double outer_wall = 0.3, partition = 0.2;  // thickness of outer walls and of the store room's
constexpr double panel = 0.4;                        // thickness of the arches and of the wall above
constexpr double arcade_height = 3.5, storey_height = 5.6,
                 wall_height = 4;  // of the arcade; of the storey above; of the walls without an arcade
constexpr double bay = 2, springing = 2.3, arch_radius = 0.76;

using Corners = std::array<glm::vec3, 4>;

/// Counter-clockwise seen from its front. It is a triangle where the first and the last corner, or the middle two, are one.
void add_quad(Mesh& mesh, const Corners& corners, const Corners& normals) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    constexpr std::array<glm::vec2, 4> uv = {glm::vec2(0, 1), glm::vec2(1, 1), glm::vec2(1, 0), glm::vec2(0, 0)};
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.positions.push_back(corners[i]);
        mesh.normals.push_back(normals[i]);
        mesh.tangents.emplace_back(glm::normalize(corners[1] - corners[0]), 1.0f);
        mesh.uv0.push_back(uv[i]);
    }
    if (corners[1] != corners[2]) mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
    if (corners[3] != corners[0]) mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 3});
}

void add_quad(Mesh& mesh, const Corners& corners) {
    Corners normals;
    normals.fill(glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0])));
    add_quad(mesh, corners, normals);
}

/// A bay's wall above its semicircular arch: x along the wall, y = 0 on the ground, z = 0 in the middle of the wall.
Mesh arch() {
    constexpr std::uint32_t steps = 20;
    constexpr auto half = float(bay / 2), r = float(arch_radius), foot = float(springing), top = float(arcade_height);
    constexpr auto front = float(panel / 2), back = -front;
    Mesh mesh;
    mesh.name = "arch";
    const auto on_arch = [&](std::uint32_t i) {
        const float angle = std::numbers::pi_v<float> * (1 - float(i) / steps);
        return glm::vec2(std::cos(angle), std::sin(angle));
    };
    const auto add_faces = [&](glm::vec2 a, glm::vec2 b) {  // from this line up to the top, on both sides
        add_quad(mesh, {glm::vec3(a, front), glm::vec3(b, front), {b.x, top, front}, {a.x, top, front}});
        add_quad(mesh, {glm::vec3(b, back), glm::vec3(a, back), {a.x, top, back}, {b.x, top, back}});
    };
    for (std::uint32_t i = 0; i < steps; ++i) {
        const glm::vec2 from = on_arch(i), to = on_arch(i + 1);
        const glm::vec2 a = r * from + glm::vec2(0, foot), b = r * to + glm::vec2(0, foot);
        add_faces(a, b);
        const glm::vec3 inward_a(-from, 0), inward_b(-to, 0);
        add_quad(mesh, {glm::vec3(a, front), glm::vec3(a, back), glm::vec3(b, back), glm::vec3(b, front)},
                 {inward_a, inward_a, inward_b, inward_b});
    }
    for (const glm::vec2 x : {glm::vec2(-half, -r), glm::vec2(r, half)}) {
        add_faces({x.x, foot}, {x.y, foot});
        add_quad(mesh, {glm::vec3(x.x, foot, front), {x.x, foot, back}, {x.y, foot, back}, {x.y, foot, front}});
    }
    return mesh;
}

/// A profile of points (distance from the y axis, height) turned around the axis. Its outside lies to the left of the way along
/// it: downwards on the outside, outwards on the top.
Mesh turned(std::span<const glm::vec2> profile, std::uint32_t segments) {
    Mesh mesh;
    mesh.name = "turned";
    for (std::size_t j = 0; j + 1 < profile.size(); ++j) {
        const glm::vec2 upper = profile[j], lower = profile[j + 1], way = glm::normalize(lower - upper), out(-way.y, way.x);
        for (std::uint32_t i = 0; i < segments; ++i) {
            const auto around = [&](std::uint32_t k, glm::vec2 p) {
                const float angle = 2 * std::numbers::pi_v<float> * float(k) / float(segments);
                return glm::vec3(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
            };
            const Corners corners = {around(i, upper), around(i, lower), around(i + 1, lower), around(i + 1, upper)};
            add_quad(mesh, corners, {around(i, out), around(i, out), around(i + 1, out), around(i + 1, out)});
        }
    }
    return mesh;
}

/// Squares of a chessboard over a rectangle on the ground (x, z), the even or the odd ones.
Mesh squares(glm::vec2 begin, glm::vec2 end, glm::uvec2 count, std::uint32_t parity) {
    Mesh mesh;
    mesh.name = "squares";
    const glm::vec2 size = (end - begin) / glm::vec2(count);
    for (std::uint32_t i = 0; i < count.x * count.y; ++i) {
        const glm::uvec2 at(i % count.x, i / count.x);
        if ((at.x + at.y) % 2 != parity) continue;
        const glm::vec2 a = begin + size * glm::vec2(at), b = a + size;
        add_quad(mesh, {glm::vec3(a.x, 0, b.y), {b.x, 0, b.y}, {b.x, 0, a.y}, {a.x, 0, a.y}});
    }
    return mesh;
}

/// An arm of the arcade: x along it from -5 to 5, z = 0 in the middle of its arches, which face the court in +z.
struct Arm {
    glm::dvec3 middle;
    double yaw;
};
constexpr Arm arms[] = {{{0, 0, -court}, 0}, {{-court, 0, 0}, std::numbers::pi / 2}};

class Courtyard {
public:
    explicit Courtyard(FrameBuilder& builder)
        : builder_(&builder),
          cube_(builder.add(box(glm::vec3(0.5f)))),
          plaster_(builder.add(lambert("plaster", {0.78f, 0.6f, 0.4f}))),
          stone_(builder.add(lambert("stone", {0.68f, 0.64f, 0.57f}))),
          wood_(builder.add(lambert("wood", {0.3f, 0.17f, 0.08f}))),
          terracotta_(builder.add(lambert("terracotta", {0.55f, 0.24f, 0.13f}))) {}

    void build() {
        pave();
        add_walls();
        add_store_room();
        for (const Arm& arm : arms) add_arm(arm);
        block({-court - 0.3, 0, -court - 0.3}, {-court + 0.3, arcade_height, -court + 0.3}, stone_);
        add_well({-1.7, 0, -1.3});
        add_plants();
        add_bench();
    }

private:
    /// A box by its two corners.
    void block(glm::dvec3 low_corner, glm::dvec3 high_corner, std::uint32_t material) {
        builder_->draw(cube_, material, {.position = 0.5 * (low_corner + high_corner), .scale = high_corner - low_corner});
    }

    /// The same in the axes of an arm.
    void block(const Arm& arm, glm::dvec3 low_corner, glm::dvec3 high_corner, std::uint32_t material) {
        const glm::dvec3 at(transform({.position = arm.middle, .yaw = arm.yaw}) *
                            glm::dvec4(0.5 * (low_corner + high_corner), 1));
        builder_->draw(cube_, material, {.position = at, .yaw = arm.yaw, .scale = high_corner - low_corner});
    }

    void pave() {
        const std::uint32_t materials[] = {builder_->add(lambert("light paving", {0.62f, 0.57f, 0.48f})),
                                           builder_->add(lambert("dark paving", {0.3f, 0.24f, 0.2f}))};
        constexpr auto c = float(court), o = float(outside);
        for (const std::uint32_t parity : {0u, 1u})
            builder_->draw(builder_->add(squares({-c, -c}, {c, c}, {10, 10}, parity)), materials[parity], {});
        builder_->draw(builder_->add(squares({-o, -o}, {-c, c}, {1, 1}, 0)), terracotta_, {});
        builder_->draw(builder_->add(squares({-c, -o}, {c, -c}, {1, 1}, 0)), terracotta_, {});
    }

    void add_walls() {
        constexpr double far = outside + outer_wall, near = court + outer_wall, face = court - panel / 2;
        block({-far, 0, -far}, {-outside, arcade_height, near}, plaster_);
        block({-outside, 0, -far}, {near, arcade_height, -outside}, plaster_);
        block({court, 0, -outside}, {near, arcade_height, -face}, plaster_);
        block({-outside, 0, court}, {-face, arcade_height, near}, plaster_);
        block({-far, arcade_height, -far}, {-face, storey_height, near}, plaster_);
        block({-face, arcade_height, -far}, {near, storey_height, -face}, plaster_);
        const std::uint32_t ochre = builder_->add(lambert("ochre", {0.72f, 0.45f, 0.2f}));
        block({court, 0, -face}, {near, wall_height, near}, ochre);
        block({-face, 0, court}, {court, wall_height, near}, ochre);
        block({court - 0.06, wall_height, -face}, {near + 0.06, wall_height + 0.1, near + 0.06}, terracotta_);
        block({-face, wall_height, court - 0.06}, {court - 0.06, wall_height + 0.1, near + 0.06}, terracotta_);
    }

    /// Closed all around; its door is in the wall towards the left arm.
    void add_store_room() {
        block({-outside, 0, -court - partition}, {-court, arcade_height, -court}, plaster_);
        block({-court - partition, 0, -outside}, {-court, arcade_height, -court - partition}, plaster_);
        constexpr double left = -7, right = -6, lintel = 2.1, proud = -court + 0.05;
        for (int plank = 0; plank < 5; ++plank)
            block({left + 0.2 * plank + 0.008, 0.01, -court}, {left + 0.2 * plank + 0.192, lintel, proud - 0.015}, wood_);
        for (const double x : {left - 0.12, right}) block({x, 0, -court}, {x + 0.12, lintel + 0.12, proud}, stone_);
        block({left, lintel, -court}, {right, lintel + 0.12, proud}, stone_);
    }

    void add_arm(const Arm& arm) {
        if (arch_ == no_index) arch_ = builder_->add(arch());
        for (int i = -2; i <= 2; ++i) {
            const glm::dmat4 to_world = transform({.position = arm.middle, .yaw = arm.yaw});
            const auto at = [&](glm::dvec3 p) { return glm::dvec3(to_world * glm::dvec4(p, 1)); };
            builder_->draw(arch_, plaster_, {.position = at({bay * i, 0, 0}), .yaw = arm.yaw});
            if (i < 2) add_column(at({bay * i + bay / 2, 0, 0}));
            add_window(arm, bay * i);
        }
        constexpr double front = panel / 2;
        const double end = arm.yaw == 0 ? court : -court;  // where no corner pier is
        block(arm, {std::min(end, end - end / court * 0.26), 0, -front},
              {std::max(end, end - end / court * 0.26), springing, front}, stone_);
        block(arm, {-court + front, arcade_height, front}, {court, arcade_height + 0.12, front + 0.07}, stone_);
        block(arm, {-court + front, storey_height - 0.12, front}, {court, storey_height + 0.06, front + 0.22}, stone_);
    }

    void add_column(glm::dvec3 foot) {
        constexpr glm::vec2 profile[] = {{0.25f, 2.16f}, {0.15f, 1.98f}, {0.18f, 1.95f}, {0.15f, 1.91f},
                                         {0.175f, 0.3f}, {0.23f, 0.25f}, {0.23f, 0.18f}};
        if (column_ == no_index) column_ = builder_->add(turned(profile, 20));
        builder_->draw(column_, stone_, {.position = foot});
        block(foot + glm::dvec3(-0.26, 0, -0.26), foot + glm::dvec3(0.26, 0.18, 0.26), stone_);
        block(foot + glm::dvec3(-0.26, 2.16, -0.26), foot + glm::dvec3(0.26, springing, 0.26), stone_);
    }

    /// Between open shutters, in the storey above a bay.
    void add_window(const Arm& arm, double x) {
        if (green_ == no_index) {
            green_ = builder_->add(lambert("shutters", {0.12f, 0.3f, 0.18f}));
            pane_ = builder_->add(lambert("panes", {0.05f, 0.06f, 0.08f}));
        }
        constexpr double sill = 4.05, head = 5.15, face = panel / 2;
        block(arm, {x - 0.27, sill, face}, {x + 0.27, head, face + 0.015}, pane_);
        for (const double side : {-0.54, 0.28}) block(arm, {x + side, sill, face}, {x + side + 0.26, head, face + 0.05}, green_);
        block(arm, {x - 0.34, sill - 0.08, face}, {x + 0.34, sill, face + 0.1}, stone_);
    }

    void add_well(glm::dvec3 at) {
        constexpr glm::vec2 rim[] = {{0.6f, 0.4f},   {0.6f, 0.8f},   {0.84f, 0.8f}, {0.84f, 0.7f},
                                     {0.77f, 0.66f}, {0.77f, 0.16f}, {1.0f, 0.16f}, {1.0f, 0.0f}};
        constexpr glm::vec2 water[] = {{0.0f, 0.5f}, {0.6f, 0.5f}};
        constexpr glm::vec2 bucket[] = {{0.0f, 0.06f},  {0.13f, 0.06f}, {0.14f, 0.26f},
                                        {0.16f, 0.26f}, {0.13f, 0.0f},  {0.0f, 0.0f}};
        builder_->draw(builder_->add(turned(rim, 32)), stone_, {.position = at});
        builder_->draw(builder_->add(turned(water, 32)), builder_->add(lambert("water", {0.03f, 0.06f, 0.07f})),
                       {.position = at});
        const auto beam = [&](glm::dvec3 a, glm::dvec3 b) { block(at + a, at + b, wood_); };
        for (const double x : {-0.78, 0.68}) beam({x, 0.8, -0.05}, {x + 0.1, 2.1, 0.05});
        beam({-0.9, 2.1, -0.06}, {0.9, 2.22, 0.06});
        beam({-0.01, 1.32, -0.01}, {0.01, 2.1, 0.01});
        builder_->draw(builder_->add(turned(bucket, 20)), wood_, {.position = at + glm::dvec3(0, 1.08, 0)});
    }

    /// Clipped trees in pots before the columns and beside the right wall.
    void add_plants() {
        constexpr glm::vec2 profile[] = {{0.0f, 0.4f},   {0.22f, 0.4f},  {0.22f, 0.45f}, {0.27f, 0.45f},
                                         {0.27f, 0.36f}, {0.24f, 0.36f}, {0.17f, 0.0f}};
        const std::uint32_t pot = builder_->add(turned(profile, 24)), ball = builder_->add(sphere(0.34f, 24)),
                            leaves = builder_->add(lambert("leaves", {0.1f, 0.26f, 0.06f}));
        for (const glm::dvec2 at : {glm::dvec2(-4.2, -4.2), {-1, -4.35}, {3, -4.35}, {-4.35, -1}, {-4.35, 3}, {4.4, -2.2}}) {
            builder_->draw(pot, terracotta_, {.position = {at.x, 0, at.y}});
            builder_->draw(cube_, wood_, {.position = {at.x, 0.6, at.y}, .scale = {0.05, 0.4, 0.05}});
            builder_->draw(ball, leaves, {.position = {at.x, 1.05, at.y}});
        }
    }

    void add_bench() {
        block({4.5, 0.4, -1}, {4.95, 0.46, 1}, wood_);
        for (const double z : {-0.8, 0.7}) block({4.55, 0, z}, {4.9, 0.4, z + 0.1}, stone_);
    }

    FrameBuilder* builder_;
    std::uint32_t cube_, plaster_, stone_, wood_, terracotta_;
    std::uint32_t arch_ = no_index, column_ = no_index, green_ = no_index, pane_ = no_index;
};

/// Within walls, ceilings and ground, so that what volumes hold does not pass them. The sun lists none: its shadows are the
/// surfaces'.
void add_blockers(Frame& frame) {
    // A rectangle across an axis at a place; low and high corners of the other two axes in turn (y z, z x, x y).
    const auto across = [&](int axis, double at, glm::dvec2 low_corner, glm::dvec2 high_corner) {
        glm::dvec3 center(0);
        glm::vec3 u(0), v(0);
        const int first = (axis + 1) % 3, second = (axis + 2) % 3;
        center[axis] = at;
        center[first] = 0.5 * (low_corner.x + high_corner.x), center[second] = 0.5 * (low_corner.y + high_corner.y);
        u[first] = v[second] = 1;
        const glm::dvec2 half = 0.5 * (high_corner - low_corner);
        frame.blockers.push_back({.center = center, .u = u, .v = v, .half_u = float(half.x), .half_v = float(half.y)});
    };
    constexpr double under = -0.15, floor_above = arcade_height + 0.15, far = outside + outer_wall / 2,
                     near = court + outer_wall / 2;
    constexpr double store = court + partition / 2;
    across(1, under, {-far, -far}, {near, near});
    across(0, -far, {under, -far}, {storey_height, near});
    across(2, -far, {-far, under}, {near, storey_height});
    across(0, near, {under, -far}, {wall_height, near});
    across(2, near, {-far, under}, {near, wall_height});
    across(1, floor_above, {-far, -far}, {near, -court});
    across(1, floor_above, {-far, -far}, {-court, near});
    across(0, -court, {springing + arch_radius, -court}, {storey_height, near});
    across(2, -court, {-court, springing + arch_radius}, {near, storey_height});
    across(0, -store, {under, -far}, {floor_above, -store});
    across(2, -store, {-far, under}, {-store, floor_above});
}

void add_afternoon_sun(Frame& frame) {
    frame.sun.direction = glm::normalize(glm::vec3(-0.62f, -1, -0.5f));
    frame.sun.irradiance = {7, 6.2f, 4.8f};
    frame.sun.shadow = {.casts = true, .map_size = 512};
    frame.sun.cascades = 2;
    frame.sun.shadow_distance = 24;
    frame.hemisphere = {.sky = {0.05f, 0.07f, 0.1f}, .ground = {0.03f, 0.025f, 0.02f}};
    frame.background = {0.4f, 0.6f, 0.95f};
}

}  // namespace

Frame courtyard(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    constexpr glm::dvec3 begin{4.3, 1.65, 4.5}, end{1.6, 1.65, 2.2};
    const double progress = builder.progress();
    builder.look({.eye = begin + (end - begin) * progress, .target = {-4.6, 1.75, -3.6}, .vertical_fov = 0.95, .swing = 0});
    Courtyard(builder).build();
    add_blockers(builder.frame);
    add_afternoon_sun(builder.frame);
    builder.frame.light_volumes = {{.kind = VolumeKind::cascaded_global,
                                    .occlusion = VolumeOcclusion::axial,
                                    .half_extent = {7, 3.5f, 7},
                                    .cells = {28, 14, 28},
                                    .cascades = 2,
                                    .iterations = 8}};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
