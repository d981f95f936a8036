// The stalls of the night market. A stall's own axes: x along its counter, z towards its customers, y = 0 is the ground.
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "captures/scenarios/foliage.h"
#include "captures/scenarios/modeling.h"
#include "captures/scenarios/night_market/night_market.h"
#include "captures/scenarios/parts.h"
#include "captures/scenarios/random.h"
#include "captures/scenarios/shapes.h"

namespace strata::scenario::market {
namespace {

struct Stall {
    Pose place;
    float width = 2.4f;
    std::uint32_t cloth = 0;
};

constexpr float counter_top = 0.95f, awning_front = 1.05f, awning_low = 2.12f;

class Stalls {
public:
    Stalls(FrameBuilder& builder, const Materials& materials, Lamps& lamps)
        : builder_(&builder),
          m_(materials),
          lamps_(&lamps),
          parts_(builder),
          random_(builder.seed() + 77),
          lantern_(builder.add(lantern_mesh())),
          bulb_(builder.add(sphere(0.05f, 8))) {}

    void add_noodle_stall() {
        const Stall stall{.place = {.position = {1.6, 0, -5.5}, .yaw = -1.0}, .width = 2.6f, .cloth = m_.red_cloth};
        add_frame(stall);
        add_pot({-0.85f, counter_top, 0.05f});
        add_bowls({-0.5f, counter_top, 0.15f});
        add_glass_case(stall, {-0.26f, counter_top, -0.12f}, {0.44f, counter_top + 0.4f, 0.24f});
        add_board({-1.15f, 1.55f, -0.78f}, {1.15f, 2.05f, -0.74f});
        parts_.draw(stall.place);
        const std::uint32_t glasses[] = {m_.green_glass, m_.amber_glass, m_.clear_glass, m_.blue_glass,
                                         m_.amber_glass, m_.red_glass,   m_.green_glass};
        for (int i = 0; i < 7; ++i)
            add_bottle(stall, glasses[i], {0.56f + 0.085f * float(i), counter_top, i % 2 == 0 ? 0.22f : 0.1f},
                       1 + 0.12f * float(i % 3));
        for (const float x : {-1.15f, -0.4f, 0.4f, 1.15f}) hang_lantern(stall, {x, awning_low - 0.32f, awning_front}, 1);
        lamps_->globe("lanterns at the left", at(stall, {-0.75f, awning_low - 0.35f, awning_front + 0.1f}), {3.4f, 1.35f, 0.42f},
                      0.2f);
        lamps_->globe("lanterns at the right", at(stall, {0.75f, awning_low - 0.35f, awning_front + 0.1f}), {3.4f, 1.35f, 0.42f},
                      0.2f);
        for (const float x : {-0.7f, 0.5f})
            builder_->draw(bulb_, m_.warm_bulb, {.position = at(stall, {x, 2.02f, 0.0f})}).casts_shadow = false;
        Light& work = lamps_->spot("work light", at(stall, {-0.1f, 2.25f, -0.1f}), {0, -1, 0}, {17, 12.5f, 7});
        work.inner_angle = 0.75f;
        work.outer_angle = 1.1f;
        work.shadow = {.casts = true, .map_size = 512, .bias = 0.03f, .soft = false};
    }

    void add_fruit_stall() {
        const Stall stall{.place = {.position = {-1.72, 0, -3.75}, .yaw = 0.95}, .width = 2.2f, .cloth = m_.blue_cloth};
        add_frame(stall);
        const std::uint32_t fruits[] = {m_.orange, m_.apple, m_.lime, m_.plum, m_.orange, m_.apple};
        for (int i = 0; i < 6; ++i) {
            const glm::vec3 low(-1.05f + 0.71f * float(i % 3), counter_top + (i < 3 ? 0.0f : 0.17f), i < 3 ? 0.05f : -0.4f);
            add_crate_of(fruits[i], low);
            part::box(parts_.of(m_.dough), low + glm::vec3(0.25f, 0.14f, 0.43f), low + glm::vec3(0.4f, 0.24f, 0.435f));
        }
        add_crate_of(m_.lime, {-0.2f, 0.2f, 0.45f});
        add_crate_of(m_.orange, {0.5f, 0.2f, 0.42f});
        part::box(parts_.of(m_.planks), {-0.3f, 0, 0.42f}, {1.2f, 0.2f, 0.88f});
        parts_.draw(stall.place);
        for (const float x : {-0.8f, 0.8f}) hang_lantern(stall, {x, awning_low - 0.3f, awning_front}, 1);
        Light& lamp = lamps_->globe("lamp over the fruit", at(stall, {0.1f, 1.98f, 0.35f}), {4.2f, 2.9f, 1.5f}, 0.09f);
        lamp.shadow = {.casts = true, .map_size = 256, .bias = 0.04f, .soft = false};
        builder_->draw(bulb_, m_.warm_bulb, {.position = lamp.position}).casts_shadow = false;
    }

    void add_glass_stall() {
        const Stall stall{.place = {.position = {-1.95, 0, -6.7}, .yaw = 1.2}, .width = 2.2f, .cloth = m_.green_cloth};
        add_frame(stall);
        parts_.draw(stall.place);
        add_panes(stall, {-0.65f, counter_top + 0.02f, 0.05f}, 0.3f);
        const std::uint32_t glasses[] = {m_.red_glass, m_.amber_glass, m_.blue_glass, m_.green_glass};
        for (int i = 0; i < 4; ++i) add_bottle(stall, glasses[i], {0.8f + 0.08f * float(i), counter_top, 0.22f}, 1.2f);
        for (const float x : {-0.7f, 0.1f, 0.8f}) hang_lantern(stall, {x, awning_low - 0.3f, awning_front}, 1);
        lamps_->globe("lamp behind the glass", at(stall, {-0.1f, 1.5f, -0.55f}), {3.6f, 2.6f, 1.5f}, 0.1f);
        builder_->draw(bulb_, m_.warm_bulb, {.position = at(stall, {-0.1f, 1.5f, -0.55f})}).casts_shadow = false;
    }

    void add_grill_stall() {
        const Stall stall{.place = {.position = {1.72, 0, -10.6}, .yaw = -1.1}, .width = 2.3f, .cloth = m_.blue_cloth};
        add_frame(stall);
        part::box(parts_.of(m_.iron), {-0.9f, counter_top, -0.2f}, {0.1f, counter_top + 0.14f, 0.28f});
        for (int i = 0; i < 9; ++i)
            part::box(parts_.of(m_.plum), {-0.85f + 0.1f * float(i), counter_top + 0.14f, -0.15f},
                      {-0.81f + 0.1f * float(i), counter_top + 0.17f, 0.36f});
        part::box(parts_.of(m_.amber_neon), {-0.85f, counter_top + 0.141f, -0.15f}, {0.05f, counter_top + 0.143f, 0.22f});
        add_bowls({0.5f, counter_top, 0.1f});
        parts_.draw(stall.place);
        for (const float x : {-0.8f, 0.0f, 0.8f}) hang_lantern(stall, {x, awning_low - 0.3f, awning_front}, 1);
        lamps_->globe("lanterns of the grill", at(stall, {0, 1.85f, awning_front + 0.1f}), {3.6f, 1.4f, 0.42f}, 0.2f);
        lamps_->globe("embers", at(stall, {-0.4f, counter_top + 0.3f, 0.1f}), {1.6f, 0.45f, 0.08f}, 0.15f).range = 3;
    }

    void add_far_stall() {
        const Stall stall{.place = {.position = {1.6, 0, -15.8}, .yaw = -1.0}, .width = 2.4f, .cloth = m_.red_cloth};
        add_frame(stall);
        parts_.draw(stall.place);
        for (const float x : {-0.8f, 0.0f, 0.8f}) hang_lantern(stall, {x, awning_low - 0.3f, awning_front}, 1);
        lamps_->globe("lanterns of the far stall", at(stall, {0, 1.8f, awning_front}), {4.2f, 1.8f, 0.6f}, 0.2f).range = 4;
    }

    /// Beside the eye, out of focus: a lantern above and a plant in a tub below.
    void add_foreground() {
        const Stall near{.place = {.position = {0, 0, 0}}};
        const Stall rack{.place = {.position = {2.2, 0, -3.95}, .yaw = -0.45}};
        part::box(parts_.of(m_.planks), {-0.42f, 0, -0.22f}, {0.42f, 0.62f, 0.22f});
        part::box(parts_.of(m_.lit_paper), {-0.4f, 0.64f, -0.3f}, {0.4f, 1.3f, -0.28f});
        part::box(parts_.of(m_.planks), {-0.44f, 0.62f, -0.34f}, {0.44f, 1.34f, -0.3f});
        parts_.draw(rack.place);
        lamps_->globe("lamp of the rack", at(rack, {0, 1.1f, 0.4f}), {0.7f, 0.55f, 0.35f}, 0.2f).range = 3;
        add_panes(rack, {-0.33f, 0.63f, 0}, 0.13f);
        hang_lantern(near, {-1.12f, 2.12f, -1.75f}, 1.15f);
        lamps_->globe("near lantern", {-1.12, 2.1, -1.75}, {0.9f, 0.36f, 0.11f}, 0.14f).range = 3.5f;
        constexpr glm::vec2 tub[] = {{0.0f, 0.5f}, {0.24f, 0.5f}, {0.24f, 0.55f}, {0.28f, 0.55f}, {0.28f, 0.46f}, {0.22f, 0.0f}};
        part::turned(parts_.of(m_.ceramic), tub, {1.44f, 0, -1.8f}, 24);
        part::box(parts_.of(m_.planks), {1.1f, 0, -2.6f}, {1.8f, 0.35f, -2.15f});
        parts_.draw({});
        const std::uint32_t bush = builder_->add(crown(builder_->seed() + 9, 46, 0.46f));
        builder_->draw(bush, m_.leaf, {.position = {1.44, 0.84, -1.8}, .scale = {0.38, 0.42, 0.38}});
    }

private:
    static glm::dvec3 at(const Stall& stall, glm::vec3 local) {
        return glm::dvec3(transform(stall.place) * glm::dvec4(local, 1));
    }

    /// Paper between a lid and a foot; the cord is its lamp's.
    static Mesh lantern_mesh() {
        Mesh mesh;
        mesh.name = "lantern";
        constexpr glm::vec2 profile[] = {{0.07f, 0.17f},   {0.12f, 0.14f},  {0.158f, 0.08f}, {0.17f, 0.0f},
                                         {0.158f, -0.08f}, {0.12f, -0.14f}, {0.07f, -0.17f}};
        part::turned(mesh, profile, glm::vec3(0), 20);
        for (glm::vec2& uv : mesh.uv0) uv.y /= 0.42f;  // the picture covers the paper once
        return mesh;
    }

    void hang_lantern(const Stall& stall, glm::vec3 local, double scale) {
        builder_->draw(lantern_, m_.paper, {.position = at(stall, local), .scale = glm::dvec3(scale)}).casts_shadow = false;
        const auto s = float(scale);
        for (const float y : {0.17f, -0.2f})
            part::box(parts_.of(m_.iron), local + s * glm::vec3(-0.07f, y, -0.07f),
                      local + s * glm::vec3(0.07f, y + 0.03f, 0.07f));
        part::box(parts_.of(m_.iron), local + s * glm::vec3(-0.004f, 0.2f, -0.004f),
                  local + s * glm::vec3(0.004f, 0.45f, 0.004f));
        parts_.draw(stall.place);
    }

    void add_frame(const Stall& stall) {
        const float half = stall.width / 2;
        Mesh &planks = parts_.of(m_.planks), &iron = parts_.of(m_.iron), &boards = parts_.of(m_.boards);
        part::box(boards, {-half, 0.04f, 0.24f}, {half, counter_top - 0.06f, 0.28f});
        for (const float x : {-half, half - 0.04f}) part::box(boards, {x, 0.04f, -0.4f}, {x + 0.04f, counter_top - 0.06f, 0.28f});
        part::box(planks, {-half - 0.06f, counter_top - 0.06f, -0.5f}, {half + 0.06f, counter_top, 0.4f});
        for (const float y : {0.35f, 0.8f}) part::box(planks, {-half, y, 0.28f}, {half, y + 0.07f, 0.3f});
        for (const float x : {-half, half}) {
            for (const float z : {-0.8f, 0.75f}) {
                const float top = z < 0 ? 2.62f : 2.2f;
                const glm::vec3 line[] = {{x, 0, z}, {x, top, z}};
                part::pipe(iron, line, 0.025f, 8);
            }
            const glm::vec3 rafter[] = {{x, 2.62f, -0.8f}, {x, awning_low, awning_front}};
            part::pipe(iron, rafter, 0.018f, 6);
        }
        const glm::vec3 rail[] = {{-half - 0.1f, awning_low - 0.01f, awning_front},
                                  {half + 0.1f, awning_low - 0.01f, awning_front}};
        part::pipe(iron, rail, 0.018f, 6);
        add_awning(stall);
    }

    /// Cloth that sags between its rafters, and a scalloped hem.
    void add_awning(const Stall& stall) {
        Mesh& cloth = parts_.of(stall.cloth);
        const float width = stall.width + 0.2f;
        part::sheet(cloth, {12, 8}, {width, 1.95f}, [&](glm::vec2 t) {
            const float sag = 0.09f * std::sin(t.x * std::numbers::pi_v<float>) * std::sin(t.y * std::numbers::pi_v<float>);
            return glm::vec3((t.x - 0.5f) * width, awning_low + 0.5f * t.y - sag, awning_front - 1.87f * t.y);
        });
        part::sheet(cloth, {48, 2}, {width, 0.2f}, [&](glm::vec2 t) {
            const float scallop = 0.13f + 0.055f * std::abs(std::sin(t.x * width / 0.2f * std::numbers::pi_v<float>));
            const float blown = 0.03f * (1 - t.y) * std::sin(9 * t.x + stall.width);
            return glm::vec3((t.x - 0.5f) * width, awning_low - scallop * (1 - t.y), awning_front + 0.02f + blown);
        });
    }

    void add_pot(glm::vec3 foot) {
        constexpr glm::vec2 stove[] = {{0.24f, 0.1f}, {0.26f, 0.0f}};
        constexpr glm::vec2 outside[] = {{0.0f, 0.36f},   {0.225f, 0.36f}, {0.235f, 0.42f}, {0.25f, 0.42f},
                                         {0.245f, 0.36f}, {0.24f, 0.16f},  {0.2f, 0.1f}};
        part::turned(parts_.of(m_.iron), stove, foot, 20);
        part::turned(parts_.of(m_.steel), outside, foot, 24);
        part::beam(parts_.of(m_.planks), foot + glm::vec3(0.05f, 0.36f, 0), foot + glm::vec3(0.3f, 0.75f, 0.1f),
                   {0.012f, 0.012f});
    }

    void add_bowls(glm::vec3 foot) {
        constexpr glm::vec2 bowl[] = {{0.075f, 0.05f}, {0.085f, 0.07f}, {0.09f, 0.07f}, {0.075f, 0.03f}, {0.045f, 0.0f}};
        for (int stack = 0; stack < 3; ++stack)
            for (int i = 0; i < 4 + stack; ++i)
                part::turned(parts_.of(m_.ceramic), bowl,
                             foot + glm::vec3(0.2f * float(stack) - 0.2f, 0.035f * float(i), -0.1f * float(stack % 2)), 10);
    }

    /// A menu of paper strips on a board.
    void add_board(glm::vec3 low, glm::vec3 high) {
        part::box(parts_.of(m_.boards), low, high);
        for (int i = 0; i < 9; ++i) {
            const float x = low.x + 0.1f + 0.245f * float(i), length = random_.between(0.25f, 0.4f);
            part::box(parts_.of(m_.dough), {x, high.y - 0.04f - length, high.z}, {x + 0.13f, high.y - 0.04f, high.z + 0.006f});
        }
    }

    /// Panes that reach 2 cm past each other at the corners, and what is for sale behind them.
    void add_glass_case(const Stall& stall, glm::vec3 low, glm::vec3 high) {
        const glm::vec3 size = high - low, middle = 0.5f * (low + high);
        const auto pane = [&](glm::vec2 half, glm::vec3 local, double turned) {
            builder_->draw(builder_->add(quad(half)), m_.clear_glass,
                           {.position = at(stall, local), .yaw = stall.place.yaw + turned});
        };
        constexpr float past = 0.02f;
        for (const float z : {low.z, high.z}) pane({size.x / 2 + past, size.y / 2}, {middle.x, middle.y, z}, 0);
        for (const float x : {low.x, middle.x, high.x})
            pane({size.z / 2 + past, size.y / 2}, {x, middle.y, middle.z}, std::numbers::pi / 2);
        part::box(parts_.of(m_.iron), {low.x - past, high.y, low.z - past}, {high.x + past, high.y + 0.02f, high.z + past});
        part::box(parts_.of(m_.steel), {low.x, low.y + 0.19f, low.z + 0.01f}, {high.x, low.y + 0.2f, high.z - 0.01f});
        for (int i = 0; i < 16; ++i) {
            const glm::vec3 foot(low.x + 0.09f + 0.18f * float(i % 4), low.y + (i < 8 ? 0.045f : 0.245f),
                                 low.z + (i / 4 % 2 == 0 ? 0.1f : 0.26f));
            part::ball(parts_.of(m_.dough), foot, {0.075f, 0.05f}, 10);
        }
    }

    /// Six upright panes in two directions, each through the next: no order of them is right.
    void add_panes(const Stall& stall, glm::vec3 first, float apart) {
        if (pane_ == no_index) pane_ = builder_->add(quad({0.15f, 0.35f}));
        const std::uint32_t glasses[] = {m_.red_glass,   m_.amber_glass, m_.blue_glass,
                                         m_.green_glass, m_.amber_glass, m_.blue_glass};
        for (int i = 0; i < 6; ++i)
            builder_->draw(pane_, glasses[i],
                           {.position = at(stall, first + glm::vec3(apart * float(i), 0.35f, 0)),
                            .yaw = stall.place.yaw + (i % 2 == 0 ? 0.75 : -0.75)});
    }

    void add_bottle(const Stall& stall, std::uint32_t material, glm::vec3 foot, double scale) {
        if (bottle_ == no_index) {
            constexpr glm::vec2 profile[] = {{0.0f, 0.3f},     {0.013f, 0.3f},  {0.013f, 0.23f}, {0.02f, 0.2f},
                                             {0.036f, 0.165f}, {0.038f, 0.12f}, {0.038f, 0.01f}, {0.03f, 0.0f}};
            Mesh mesh;
            mesh.name = "bottle";
            part::turned(mesh, profile, glm::vec3(0), 16);
            bottle_ = builder_->add(std::move(mesh));
        }
        builder_->draw(bottle_, material, {.position = at(stall, foot), .scale = glm::dvec3(scale)});
    }

    /// A crate 0.66 m wide and 0.4 m deep, tilted goods heaped in it.
    void add_crate_of(std::uint32_t fruit, glm::vec3 low) {
        Mesh& planks = parts_.of(m_.planks);
        constexpr float wide = 0.66f, deep = 0.42f, high = 0.13f, thick = 0.015f;
        part::box(planks, low, low + glm::vec3(wide, thick, deep));
        for (const float z : {0.0f, deep - thick})
            part::box(planks, low + glm::vec3(0, 0, z), low + glm::vec3(wide, high, z + thick));
        for (const float x : {0.0f, wide - thick})
            part::box(planks, low + glm::vec3(x, 0, 0), low + glm::vec3(x + thick, high, deep));
        Mesh& heap = parts_.of(fruit);
        for (int i = 0; i < 38; ++i) {
            const bool upper = i >= 24;
            const int k = upper ? i - 24 : i, columns = upper ? 5 : 6;
            const float radius = random_.between(0.046f, 0.054f), x = random_.between(-0.012f, 0.012f),
                        z = random_.between(-0.01f, 0.01f);
            const glm::vec3 place(0.07f + 0.104f * (float(k % columns) + (upper ? 0.5f : 0.0f)) + x, upper ? 0.165f : 0.09f,
                                  0.065f + 0.097f * (float(k / columns) + (upper ? 0.5f : 0.0f)) + z);
            part::ball(heap, low + place, glm::vec2(radius), 8);
        }
    }

    FrameBuilder* builder_;
    Materials m_;
    Lamps* lamps_;
    Parts parts_;
    Random random_;
    std::uint32_t lantern_, bulb_, bottle_ = no_index, pane_ = no_index;
};

}  // namespace

void add_stalls(FrameBuilder& builder, const Materials& materials, Lamps& lamps) {
    Stalls stalls(builder, materials, lamps);
    stalls.add_noodle_stall();
    stalls.add_fruit_stall();
    stalls.add_glass_stall();
    stalls.add_grill_stall();
    stalls.add_far_stall();
    stalls.add_foreground();
}

}  // namespace strata::scenario::market
