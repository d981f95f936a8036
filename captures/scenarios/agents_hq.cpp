// The agents' headquarters: a lobby before two rows of four rooms. Doors and windows are portals in walls that are blockers,
// 200 lights of every type, glass in the windows, a person of cloth, skin and hair. Made for what a room costs to light.
//
//   z = -12  +------+------+------+------+   doors between the rooms of a row and between the rows,
//            |      |      |      |      |   windows with glass, and doors, towards the lobby
//   z = -6   +--  --+--  --+--  --+--  --+
//            |      |      |      |      |
//   z = 0    + -[==]+ -[==]+ -[==]+ -[==]+
//            |          lobby            |
//   z = 8    +---------windows-----------+
//           x = -12                     12
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "captures/scenarios/builders.h"
#include "captures/scenarios/frame_builder.h"
#include "captures/scenarios/pictures.h"
#include "captures/scenarios/props.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario {
namespace {

constexpr double height = 3, thickness = 0.1, room = 6, lobby = 8;
// Blockers lie in the middle of walls and slabs and meet there: what lies within 5 mm of a blocker's plane counts as before it,
// so the top of a wall would be lit through a blocker at the lower face of the ceiling.
constexpr double slab = 0.2, roof_height = height + slab / 2;
constexpr std::uint32_t rooms_in_row = 4, rows_of_rooms = 2, lights_in_room = 20, lights_in_lobby = 40;

enum class Opening { none, door, window };

/// A wall on the line from `from` to `to` (x, z) with one opening in its middle: boxes to see, a blocker, a portal.
struct Wall {
    glm::dvec2 from, to;
    Opening opening = Opening::none;
};

/// Width, lower and upper edge of an opening, meters.
struct Hole {
    double half_width = 0, low = 0, high = 0;
};

Hole hole(Opening opening) {
    if (opening == Opening::door) return {0.5, 0, 2.1};
    if (opening == Opening::window) return {1.8, 0.9, 2.2};
    return {};
}

class Headquarters {
public:
    explicit Headquarters(FrameBuilder& builder)
        : builder_(&builder),
          paint_(builder.add(painted("plaster", {0.62f, 0.6f, 0.55f}, 0.8f))),
          pane_(builder.add(window_glass())),
          unit_box_(builder.add(box(glm::vec3(0.5f)))),
          sheet_(builder.add(quad({0.5f, 0.5f}))),
          random_(builder.seed()) {}

    void build() {
        add_slabs();
        for (std::uint32_t row = 0; row < rows_of_rooms; ++row) {
            const double front = -room * row, back = front - room;
            for (std::uint32_t i = 0; i < rooms_in_row; ++i) {
                const double left = -2 * room + room * i, right = left + room;
                if (row > 0) add_wall({{left, front}, {right, front}, Opening::door});
                if (row == 0) add_wall({{left, front}, {left + 2, front}, Opening::door});
                if (row == 0) add_wall({{left + 2, front}, {right, front}, Opening::window});
                if (i > 0) add_wall({{left, front}, {left, back}, Opening::door});
            }
        }
        const double deep = -room * rows_of_rooms, wide = 2 * room;
        add_wall({{-wide, deep}, {wide, deep}, Opening::none});
        add_wall({{-wide, lobby}, {-wide, deep}, Opening::none});
        add_wall({{wide, deep}, {wide, lobby}, Opening::none});
        for (const double middle : {-8.0, 0.0, 8.0}) add_wall({{middle - 4, lobby}, {middle + 4, lobby}, Opening::window});
        add_sky();
        for (std::uint32_t i = 0; i < rooms_in_row * rows_of_rooms; ++i) {
            const double x = -1.5 * room + room * (i % rooms_in_row), z = -room * (0.5 + i / rooms_in_row);
            furnish({x, 0, z});
            light_room({x, 0, z}, {room / 2, room / 2}, lights_in_room);
        }
        light_room({0, 0, lobby / 2}, {2 * room, lobby / 2}, lights_in_lobby - 1);
    }

private:
    static Material painted(std::string name, glm::vec3 color, float roughness) {
        Material material = lambert(std::move(name), color);
        material.lighting_model = LightingModel::burley;
        material.roughness = roughness;
        return material;
    }

    static Material window_glass() {
        Material material = glass("window", {0.85f, 0.93f, 0.9f});
        material.lighting_model = LightingModel::ggx;
        material.base_color = glm::vec4(glm::vec3(0.02f), 1);
        material.roughness = 0.2f;
        return material;
    }

    /// A box by its two corners.
    void block(glm::dvec3 low, glm::dvec3 high, std::uint32_t material) {
        builder_->draw(unit_box_, material, {.position = 0.5 * (low + high), .scale = high - low});
    }

    void add_slabs() {
        Material tiles = painted("tiles", glm::vec3(1), 0.35f);
        tiles.lighting_model = LightingModel::ggx;
        tiles.base_color_texture.texture = builder_->add(checker(2, glm::vec3(0.5f, 0.48f, 0.44f), glm::vec3(0.3f)));
        tiles.base_color_texture.transform = {12, 0, 0, 0, 10, 0};
        const double wide = 2 * room, deep = -room * rows_of_rooms;
        block({-wide, -slab, deep}, {wide, 0, lobby}, builder_->add(tiles));
        block({-wide, height, deep}, {wide, height + slab, lobby}, paint_);
    }

    void add_wall(const Wall& wall) {
        const glm::dvec2 line = wall.to - wall.from;
        const double length = glm::length(line);
        const glm::dvec2 along = line / length, middle = 0.5 * (wall.from + wall.to);
        const Hole cut = hole(wall.opening);
        // Parts of the wall by their span along it and their heights; a wall without opening is the first alone.
        const glm::dvec2 half{length / 2, thickness / 2};
        const auto part = [&](glm::dvec2 span, glm::dvec2 heights) {
            const glm::dvec2 center = middle + along * (0.5 * (span.x + span.y));
            builder_->draw(unit_box_, paint_,
                           {.position = {center.x, 0.5 * (heights.x + heights.y), center.y},
                            .yaw = -std::atan2(along.y, along.x),
                            .scale = {span.y - span.x, heights.y - heights.x, 2 * half.y}});
        };
        if (wall.opening == Opening::none) {
            part({-half.x, half.x}, {0, height});
        } else {
            part({-half.x, -cut.half_width}, {0, height});
            part({cut.half_width, half.x}, {0, height});
            part({-cut.half_width, cut.half_width}, {cut.high, height});
            if (cut.low > 0) part({-cut.half_width, cut.half_width}, {0, cut.low});
        }
        Frame& frame = builder_->frame;
        const glm::vec3 u(float(along.x), 0, float(along.y));
        const auto blocker = static_cast<std::uint32_t>(frame.blockers.size());
        frame.blockers.push_back({.center = {middle.x, roof_height / 2, middle.y},
                                  .u = u,
                                  .v = {0, 1, 0},
                                  .half_u = float(length / 2),
                                  .half_v = float(roof_height / 2)});
        if (wall.opening == Opening::none) return;
        const glm::dvec3 opening{middle.x, 0.5 * (cut.low + cut.high), middle.y};
        frame.portals.push_back({.center = opening,
                                 .u = u,
                                 .v = {0, 1, 0},
                                 .half_u = float(cut.half_width),
                                 .half_v = float(0.5 * (cut.high - cut.low)),
                                 .blocker = blocker});
        if (wall.opening == Opening::window)
            builder_->draw(sheet_, pane_,
                           {.position = opening,
                            .yaw = -std::atan2(along.y, along.x),
                            .scale = {2 * cut.half_width, cut.high - cut.low, 1}});
    }

    /// Daylight from the front: the roof and the walls keep it out but for the windows.
    void add_sky() {
        Frame& frame = builder_->frame;
        const auto roof = static_cast<std::uint32_t>(frame.blockers.size());
        frame.blockers.push_back({.center = {0, roof_height, (lobby - room * rows_of_rooms) / 2},
                                  .u = {1, 0, 0},
                                  .v = {0, 0, 1},
                                  .half_u = float(2 * room),
                                  .half_v = float((lobby + room * rows_of_rooms) / 2)});
        Light day;
        day.name = "daylight";
        day.type = LightType::directional;
        day.direction = glm::normalize(glm::vec3(0.35f, -0.5f, -1));
        day.intensity = {4, 3.7f, 3.2f};
        for (std::uint32_t i = 0; i <= roof; ++i) day.blockers.push_back(i);
        for (std::uint32_t i = 0; i < frame.portals.size(); ++i) day.portals.push_back(i);
        frame.lights.push_back(day);
    }

    void furnish(glm::dvec3 floor) {
        const std::uint32_t wood = desk_ != no_index ? desk_ : desk_ = builder_->add(painted("wood", {0.4f, 0.25f, 0.12f}, 0.5f));
        const std::uint32_t fabric = fabric_ != no_index ? fabric_ : fabric_ = builder_->add([] {
            Material material = painted("fabric", {0.15f, 0.2f, 0.45f}, 0.7f);
            material.lighting_model = LightingModel::cloth;
            return material;
        }());
        const double turn = random_.between(-0.4, 0.4);
        const glm::dvec3 at = floor + glm::dvec3{random_.between(-1.2, 1.2), 0, random_.between(-1.5, 0.0)};
        builder_->draw(unit_box_, wood, {.position = at + glm::dvec3(0, 0.72, 0), .yaw = turn, .scale = {1.6, 0.06, 0.8}});
        builder_->draw(unit_box_, wood, {.position = at + glm::dvec3(0, 0.35, 0), .yaw = turn, .scale = {0.1, 0.7, 0.6}});
        builder_->draw(unit_box_, fabric, {.position = floor + glm::dvec3(-2.2, 0.25, 1.2), .scale = {0.9, 0.5, 1.8}});
    }

    static constexpr LightType types_of_a_room[] = {
        LightType::omni,      LightType::round_spot, LightType::rectangle,  LightType::square_spot, LightType::tube,
        LightType::omni,      LightType::sphere,     LightType::round_spot, LightType::disc,        LightType::omni,
        LightType::rectangle, LightType::omni,       LightType::tube,       LightType::square_spot, LightType::round_spot,
        LightType::omni,      LightType::omni,       LightType::sphere,     LightType::omni,        LightType::omni};

    /// Lights of all types between the walls that are nearer than their range, which stop them but for their openings.
    void light_room(glm::dvec3 floor, glm::dvec2 half, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i) {
            Light light = lamp(types_of_a_room[i % std::size(types_of_a_room)], i);
            const bool hangs = light.type != LightType::omni && light.type != LightType::sphere;
            light.position = {floor.x + random_.between(-0.8, 0.8) * half.x, hangs ? height - 0.15 : random_.between(0.9, 2.4),
                              floor.z + random_.between(-0.8, 0.8) * half.y};
            if (i % 20 == 16) light.intensity = glm::vec3(-0.5f);  // a dark: gray, a warm one would leave blue rims
            if (i % 20 == 18) light.clip_planes = {{{0, 1, 0}, -light.position.y + 0.4}, {{1, 0, 0}, -light.position.x}};
            shield(light);
            builder_->frame.lights.push_back(std::move(light));
        }
    }

    Light lamp(LightType type, std::uint32_t index) {
        Light light;
        light.type = type;
        light.name = "lamp " + std::to_string(builder_->frame.lights.size());
        light.range = random_.between(2.0f, 4.5f);
        light.direction = glm::normalize(glm::vec3{random_.between(-0.3f, 0.3f), -1, random_.between(-0.3f, 0.3f)});
        light.axis_u = glm::normalize(glm::cross(light.direction, glm::vec3(0, 0, 1)));
        const glm::vec3 tint{random_.between(0.7f, 1.0f), random_.between(0.6f, 0.9f), random_.between(0.4f, 0.9f)};
        light.intensity = tint * 2.5f;
        const bool spot = type == LightType::round_spot || type == LightType::square_spot;
        if (spot) {
            light.range = 4.5f;
            light.intensity = tint * 14.0f;
            light.inner_angle = type == LightType::round_spot ? 0.35f : 0.45f;
            light.outer_angle = 0.6f;
            light.shadow.casts = index % 20 == 1;
            light.shadow.map_size = 256;
            if (index % 20 == 13) light.texture = slide();
        }
        if (type == LightType::tube) {
            light.half_extent = {0.6f, 0};
            light.source_radius = 0.02f;
            light.intensity = tint * 60.0f;
        }
        if (type == LightType::sphere || type == LightType::disc) {
            light.source_radius = 0.15f;
            light.intensity = tint * 30.0f;
        }
        if (type == LightType::rectangle) {
            light.half_extent = {0.5f, 0.3f};
            light.intensity = tint * 9.0f;
            if (index % 20 == 10) light.texture = slide();
        }
        return light;
    }

    /// The picture that spots project and panels show.
    std::uint32_t slide() {
        if (slide_ == no_index) slide_ = builder_->add(checker(4, {0.9f, 0.85f, 0.7f}, {0.08f, 0.1f, 0.2f}));
        return slide_;
    }

    /// Lists the walls within the light's range, and their openings.
    void shield(Light& light) const {
        const Frame& frame = builder_->frame;
        std::vector<bool> listed(frame.blockers.size(), false);
        for (std::uint32_t i = 0; i < frame.blockers.size(); ++i) {
            const Blocker& wall = frame.blockers[i];
            const glm::dvec3 offset = light.position - wall.center;
            const double across = std::abs(glm::dot(offset, glm::dvec3(glm::cross(wall.u, wall.v))));
            const double along = std::abs(glm::dot(offset, glm::dvec3(wall.u))) - double(wall.half_u);
            if (across > double(light.range) || along > double(light.range)) continue;
            light.blockers.push_back(i);
            listed[i] = true;
        }
        for (std::uint32_t i = 0; i < frame.portals.size(); ++i)
            if (listed[frame.portals[i].blocker]) light.portals.push_back(i);
    }

    FrameBuilder* builder_;
    std::uint32_t paint_, pane_, unit_box_, sheet_;
    std::uint32_t desk_ = no_index, fabric_ = no_index, slide_ = no_index;
    Random random_;
};

/// A guest in the lobby: suit, face and hair each of its own lighting model.
void add_guest(FrameBuilder& builder) {
    Material suit = lambert("suit", {0.12f, 0.13f, 0.16f});
    suit.lighting_model = LightingModel::cloth;
    const People people(builder);
    people.add(builder, builder.add(suit), {.position = {-2.2, 0, 2.6}, .yaw = -0.9});
    Material face = lambert("face", {0.7f, 0.45f, 0.35f});
    face.lighting_model = LightingModel::skin;
    face.roughness = 0.5f;
    builder.draw(builder.add(sphere(0.125f, 16)), builder.add(face), {.position = {-2.22, 1.69, 2.63}});
    Material hair = lambert("hair", {0.25f, 0.14f, 0.06f});
    hair.lighting_model = LightingModel::hair;
    hair.roughness = 0.4f;
    builder.draw(builder.add(sphere(0.13f, 16)), builder.add(hair), {.position = {-2.18, 1.74, 2.57}});
}

}  // namespace

Frame agents_hq(std::uint32_t frame, const ScenarioOptions& options) {
    FrameBuilder builder(frame, options);
    builder.look({.eye = {-5, 1.9, 5.6}, .target = {0.5, 1.1, -1.5}, .vertical_fov = 0.95, .swing = 0.15});
    Headquarters(builder).build();
    add_guest(builder);
    builder.frame.hemisphere = {.sky = glm::vec3(0.04f), .ground = glm::vec3(0.03f)};
    builder.frame.background = {0.5f, 0.6f, 0.75f};
    return std::move(builder.frame);
}

}  // namespace strata::scenario
