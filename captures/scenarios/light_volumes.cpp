// Rooms in which light bounces, each inside a light propagation volume that is at least a cell wider, because it fades at its
// border. Walls, floors and ceilings are faces that look inwards, so that the eye sees through their backs and light does not.
#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

using Quadrilateral = std::array<glm::dvec3, 4>;

/// A quadrilateral, its corners in turn, that faces a point.
Mesh face_towards(glm::dvec3 point, Quadrilateral corners) {
    if (glm::dot(glm::cross(corners[1] - corners[0], corners[3] - corners[0]), point - corners[0]) < 0)
        std::swap(corners[1], corners[3]);
    Mesh mesh;
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
    for (const glm::dvec3& corner : corners) {
        mesh.positions.emplace_back(corner);
        mesh.normals.push_back(normal);
        mesh.tangents.emplace_back(glm::normalize(glm::vec3(corners[1] - corners[0])), 1.0f);
    }
    mesh.uv0 = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

void add_face(FrameBuilder& builder, std::uint32_t material, glm::dvec3 towards, const Quadrilateral& corners) {
    builder.draw(builder.add(face_towards(towards, corners)), material, {});
}

// --- The Cornell box: positions, reflectances and emission as measured by the Cornell University Program of Computer Graphics
// (Goral, Torrance, Greenberg, Battaile 1984; the data of 1998), 10 times as large. The reflectances are spectra: here is what
// linear sRGB sees of them.

constexpr glm::vec3 white{0.725f, 0.71f, 0.68f}, red{0.63f, 0.065f, 0.05f}, green{0.14f, 0.45f, 0.091f};
constexpr double ceiling = 5.488;

/// A block by the corners of its top in turn (x, z) and its height.
struct Block {
    std::array<glm::dvec2, 4> corners;
    double height;
};
constexpr Block short_block{{{{1.30, 0.65}, {0.82, 2.25}, {2.40, 2.72}, {2.90, 1.14}}}, 1.65};
constexpr Block tall_block{{{{4.23, 2.47}, {2.65, 2.96}, {3.14, 4.56}, {4.72, 4.06}}}, 3.30};

/// The side from one corner to the next, a distance inside the block and as much shorter.
struct Side {
    glm::dvec2 middle, along;
    double half = 0;
};
Side side_of(const Block& block, std::size_t i, double inset) {
    const glm::dvec2 a = block.corners[i], b = block.corners[(i + 1) % 4];
    const glm::dvec2 center = 0.25 * (block.corners[0] + block.corners[1] + block.corners[2] + block.corners[3]);
    const glm::dvec2 along = glm::normalize(b - a), across(-along.y, along.x);
    const double inwards = glm::dot(across, center - a) > 0 ? inset : -inset;
    return {0.5 * (a + b) + across * inwards, along, 0.5 * glm::length(b - a) - inset};
}

/// Rectangle lights have no shadow maps: blockers 2 cm inside the block's faces keep its light away from what is behind.
void add_blockers(Frame& frame, const Block& block) {
    constexpr double inset = 0.02;
    const double height = block.height - inset;
    for (std::size_t i = 0; i < 4; ++i) {
        const Side side = side_of(block, i, inset);
        frame.blockers.push_back({.center = {side.middle.x, 0.5 * height, side.middle.y},
                                  .u = glm::vec3(float(side.along.x), 0, float(side.along.y)),
                                  .v = {0, 1, 0},
                                  .half_u = float(side.half),
                                  .half_v = float(0.5 * height)});
    }
    const Side base = side_of(block, 0, inset), next = side_of(block, 1, inset), opposite = side_of(block, 2, inset);
    const glm::dvec2 middle = 0.5 * (base.middle + opposite.middle);
    frame.blockers.push_back({.center = {middle.x, height, middle.y},
                              .u = glm::vec3(float(base.along.x), 0, float(base.along.y)),
                              .v = glm::vec3(float(-base.along.y), 0, float(base.along.x)),
                              .half_u = float(base.half),
                              .half_v = float(next.half)});
}

void add_block(FrameBuilder& builder, std::uint32_t material, const Block& block) {
    const auto at = [&](std::size_t corner, double y) {
        return glm::dvec3(block.corners[corner % 4].x, y, block.corners[corner % 4].y);
    };
    const glm::dvec3 above = at(0, block.height) + glm::dvec3(0, 1, 0);
    add_face(builder, material, above, {at(0, block.height), at(1, block.height), at(2, block.height), at(3, block.height)});
    for (std::size_t i = 0; i < 4; ++i) {
        const Side outside = side_of(block, i, -1);
        add_face(builder, material, {outside.middle.x, 0, outside.middle.y},
                 {at(i, 0), at(i + 1, 0), at(i + 1, block.height), at(i, block.height)});
    }
    add_blockers(builder.frame, block);
}

void add_ceiling_light(FrameBuilder& builder) {
    const glm::vec3 radiance = 3.2f * glm::vec3(18.4f, 14.0f, 6.75f);
    Material glowing = lambert("ceiling light", glm::vec3(0.78f));
    glowing.emissive = radiance;
    const double y = ceiling - 0.002;
    add_face(builder, builder.add(glowing), {2.78, 0, 2.795},
             {{{3.43, y, 2.27}, {3.43, y, 3.32}, {2.13, y, 3.32}, {2.13, y, 2.27}}});
    Light light;
    light.name = "ceiling light";
    light.type = LightType::rectangle;
    light.position = {2.78, ceiling - 0.01, 2.795};
    light.direction = {0, -1, 0};
    light.axis_u = {1, 0, 0};
    light.half_extent = {0.65f, 0.525f};
    light.intensity = radiance;
    light.range = 30;
    for (std::uint32_t i = 0; i < builder.frame.blockers.size(); ++i) light.blockers.push_back(i);
    builder.frame.lights.push_back(std::move(light));
}

// --- Two rooms.

constexpr double wall = 0.05;                             // half the thickness of the wall between them
constexpr double wide = 4, high = 2.8, deep = -4;         // of each room: x, y, z
constexpr double door_low = -2.6, door_high = -1.8;       // z
constexpr double door_height = 2.1, door_overlap = 0.05;  // the leaf is wider than the doorway by this much on both sides

/// How far the door is open: closed in the first of several frames, wide open in the last.
double opening(std::uint32_t frame, const ScenarioOptions& options) {
    return options.frames > 1 ? std::min(1.0, frame / (options.frames - 1.0)) : 1.0;
}

/// How far the leaf has slid into the wall; what it leaves open of the doorway is less by its overlap.
double slid(double opened) { return opened * (door_high - door_low + door_overlap); }

/// On one side of the wall between the rooms, x the wall's face.
void add_wall_with_doorway(FrameBuilder& builder, std::uint32_t paint, double x) {
    const auto part = [&](glm::dvec2 z, glm::dvec2 y) {
        add_face(builder, paint, {20 * x, 0, 0}, {{{x, y.x, z.x}, {x, y.x, z.y}, {x, y.y, z.y}, {x, y.y, z.x}}});
    };
    part({deep, door_low}, {0, high});
    part({door_high, 0}, {0, high});
    part({door_low, door_high}, {door_height, high});
}

/// Floor, ceiling and the three walls that are not between the rooms; from the wall between them to x.
void add_room(FrameBuilder& builder, const std::array<std::uint32_t, 3>& floor_walls_end, double x) {
    const double begin = x < 0 ? -wall : wall;
    const glm::dvec3 middle(0.5 * x, 0.5 * high, 0.5 * deep);
    const auto [floor, walls, end] = floor_walls_end;
    add_face(builder, floor, middle, {{{begin, 0, 0}, {x, 0, 0}, {x, 0, deep}, {begin, 0, deep}}});
    add_face(builder, walls, middle, {{{begin, high, 0}, {x, high, 0}, {x, high, deep}, {begin, high, deep}}});
    add_face(builder, walls, middle, {{{begin, 0, deep}, {x, 0, deep}, {x, high, deep}, {begin, high, deep}}});
    add_face(builder, walls, middle, {{{begin, 0, 0}, {x, 0, 0}, {x, high, 0}, {begin, high, 0}}});
    add_face(builder, end, middle, {{{x, 0, 0}, {x, 0, deep}, {x, high, deep}, {x, high, 0}}});
    add_wall_with_doorway(builder, walls, begin);
}

/// The faces of the doorway within the wall, and the leaf that slides into the wall.
void add_door(FrameBuilder& builder, std::uint32_t paint, double opened, double opened_before) {
    const glm::dvec3 middle(0, 0.5 * door_height, 0.5 * (door_low + door_high));
    for (const double z : {door_low, door_high})
        add_face(builder, paint, middle, {{{-wall, 0, z}, {wall, 0, z}, {wall, door_height, z}, {-wall, door_height, z}}});
    for (const double y : {0.0, door_height})
        add_face(builder, paint, middle,
                 {{{-wall, y, door_low}, {wall, y, door_low}, {wall, y, door_high}, {-wall, y, door_high}}});
    const double half_height = 0.5 * door_height + 0.02, half_width = 0.5 * (door_high - door_low) + door_overlap;
    Draw& leaf =
        builder.draw(builder.add(box({0.02f, float(half_height), float(half_width)})),
                     builder.add(lambert("door", {0.45f, 0.24f, 0.12f})), {.position = middle - glm::dvec3(0, 0, slid(opened))});
    leaf.mobility = Mobility::moving;
    leaf.previous_to_world = transform({.position = middle - glm::dvec3(0, 0, slid(opened_before))});
}

void add_furniture(FrameBuilder& builder) {
    const std::uint32_t wood = builder.add(lambert("wood", {0.5f, 0.32f, 0.18f}));
    const std::uint32_t cloth = builder.add(lambert("cloth", {0.15f, 0.3f, 0.55f})),
                        plain = builder.add(lambert("plaster", glm::vec3(0.75f)));
    const std::uint32_t cube = builder.add(box(glm::vec3(0.5f)));
    builder.draw(cube, wood, {.position = {-2.6, 0.72, -2.9}, .yaw = 0.2, .scale = {1.5, 0.06, 0.8}});
    for (const double x : {-3.2, -2.0})
        builder.draw(cube, wood, {.position = {x, 0.345, -2.9}, .yaw = 0.2, .scale = {0.08, 0.69, 0.6}});
    builder.draw(cube, plain, {.position = {-1.0, 0.3, -0.8}, .yaw = 0.5, .scale = glm::dvec3(0.6)});
    builder.draw(cube, cloth, {.position = {2.6, 0.22, -3.4}, .scale = {2, 0.44, 0.9}});
    builder.draw(cube, cloth, {.position = {2.6, 0.65, -3.8}, .scale = {2, 0.5, 0.25}});
    builder.draw(builder.add(sphere(0.45f, 32)), plain, {.position = {2.3, 0.45, -1.3}});
}

/// A blocker behind each wall of the rooms together and one within the wall between them, which the door's portal opens.
void add_blockers(Frame& frame, double opened) {
    const double x = wide + wall, y = 0.5 * high, z = 0.5 * deep, half_y = y + wall, half_z = -z + wall;
    const auto rectangle = [&](glm::dvec3 center, glm::vec3 u, glm::vec3 v, glm::dvec2 half) {
        frame.blockers.push_back({.center = center, .u = u, .v = v, .half_u = float(half.x), .half_v = float(half.y)});
    };
    const glm::vec3 to_right(1, 0, 0), up(0, 1, 0), to_front(0, 0, 1);
    for (const double at : {0.0, -x, x}) rectangle({at, y, z}, to_front, up, {half_z, half_y});
    for (const double at : {-wall, high + wall}) rectangle({0, at, z}, to_right, to_front, {x, half_z});
    for (const double at : {deep - wall, wall}) rectangle({0, y, at}, to_right, up, {x, half_y});
    const double width = std::max(0.0, slid(opened) - door_overlap);
    frame.portals.push_back({.center = {0, 0.5 * door_height, door_high - 0.5 * width},
                             .u = to_front,
                             .v = up,
                             .half_u = float(0.5 * width),
                             .half_v = float(0.5 * door_height),
                             .blocker = 0});
}

void add_lamp(FrameBuilder& builder) {
    Light lamp;
    lamp.name = "lamp";
    lamp.position = {-2.3, 2.1, -1.7};
    lamp.intensity = {24, 20, 14};
    lamp.range = 14;
    lamp.shadow = {.casts = true, .map_size = 512};
    for (std::uint32_t i = 0; i < builder.frame.blockers.size(); ++i) lamp.blockers.push_back(i);
    lamp.portals = {0};
    Draw& bulb =
        builder.draw(builder.add(sphere(0.09f, 16)), builder.add(unlit("bulb", {3, 2.5f, 1.8f, 1})), {.position = lamp.position});
    bulb.casts_shadow = false;
    builder.frame.lights.push_back(std::move(lamp));
}

}  // namespace

Frame cornell_box(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {2.78, 2.73, -8}, .target = {2.78, 2.73, 2.8}, .vertical_fov = 0.6864, .swing = 0.15});
    const std::uint32_t paint = builder.add(lambert("white", white));
    const glm::dvec3 middle(2.78, 2.74, 2.8);
    constexpr glm::dvec3 left_front{5.528, 0, 0}, left_back{5.496, 0, 5.592}, left_top_back{5.56, ceiling, 5.592},
        left_top_front{5.56, ceiling, 0}, right_front{0, 0, 0}, right_back{0, 0, 5.592}, right_top_back{0, ceiling, 5.592},
        right_top_front{0, ceiling, 0};
    add_face(builder, paint, middle, {left_front, right_front, right_back, left_back});
    add_face(builder, paint, middle, {left_top_front, left_top_back, right_top_back, right_top_front});
    add_face(builder, paint, middle, {left_back, right_back, right_top_back, left_top_back});
    add_face(builder, builder.add(lambert("green", green)), middle, {right_back, right_front, right_top_front, right_top_back});
    add_face(builder, builder.add(lambert("red", red)), middle, {left_front, left_back, left_top_back, left_top_front});
    add_block(builder, paint, short_block);
    add_block(builder, paint, tall_block);
    add_ceiling_light(builder);
    builder.frame.light_volumes = {{.kind = VolumeKind::fixed_local,
                                    .center = {2.78, 2.744, 2.796},
                                    .half_extent = glm::vec3(3.15f),
                                    .cells = glm::uvec3(18),
                                    .iterations = 36}};
    return std::move(builder.frame);
}

/// The lamp hangs in the left room. The wall between the rooms is a quarter of a cell thick and lies a quarter of a cell off the
/// borders of cells.
Frame two_rooms(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {2.7, 7.2, 4.6}, .target = {0.15, 0.75, -1.75}, .vertical_fov = 0.72, .swing = 0.1});
    const std::uint32_t boards = builder.add(lambert("boards", {0.55f, 0.42f, 0.3f})),
                        paint = builder.add(lambert("paint", glm::vec3(0.7f)));
    add_room(builder, {boards, paint, builder.add(lambert("orange", {0.75f, 0.35f, 0.12f}))}, -wide);
    add_room(builder, {boards, paint, builder.add(lambert("blue", {0.2f, 0.4f, 0.7f}))}, wide);
    const double opened = opening(frame, options);
    add_door(builder, paint, opened, frame > 0 ? opening(frame - 1, options) : opened);
    add_furniture(builder);
    add_blockers(builder.frame, opened);
    add_lamp(builder);
    builder.frame.background = glm::vec3(0.02f, 0.025f, 0.035f);
    builder.frame.light_volumes = {{.kind = VolumeKind::fixed_local,
                                    .occlusion = VolumeOcclusion::axial,
                                    .center = {0.1, 1.5, -2},
                                    .half_extent = {4.8f, 2, 2.8f},
                                    .cells = {24, 10, 14},
                                    .iterations = 32}};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
