// Sellers and passers-by: long coats, hats and umbrellas. A figure stands on y = 0 and looks along +z.
#include <cmath>
#include <numbers>
#include <utility>

#include "captures/scenarios/modeling.h"
#include "captures/scenarios/night_market/night_market.h"
#include "captures/scenarios/parts.h"

namespace strata::scenario::market {
namespace {

enum class Headwear { hood, straw_hat };

struct Metric {
    Pose place;
    std::uint32_t coat = 0, umbrella = no_index;
    Headwear headwear = Headwear::hood;
    float stride = 0;  ///< meters between the feet
};

void add_umbrella(Mesh& cloth, Mesh& iron, glm::vec3 hand) {
    constexpr float radius = 0.62f, rise = 0.24f;
    const glm::vec3 top = hand + glm::vec3(0.02f, 0.92f, 0);
    part::sheet(cloth, {32, 5}, {3.9f, 0.7f}, [&](glm::vec2 t) {
        const float angle = t.x * 2 * std::numbers::pi_v<float>, in = t.y;
        const float scallop = 1 - 0.07f * (1 - in) * std::abs(std::sin(4 * angle));  // eight ribs
        const float r = glm::mix(radius, 0.012f, in) * scallop;
        return top + glm::vec3(r * std::cos(angle), rise * (1 - (1 - in) * (1 - in)) - rise, -r * std::sin(angle));
    });
    const glm::vec3 shaft[] = {hand - glm::vec3(0, 0.12f, 0), top + glm::vec3(0, 0.06f, 0)};
    part::pipe(iron, shaft, 0.009f, 6);
}

void add_head(Parts& parts, const Materials& materials, const Metric& metric) {
    part::ball(parts.of(materials.skin), {0, 1.62f, 0.02f}, {0.095f, 0.125f}, 16);
    if (metric.headwear == Headwear::straw_hat) {
        constexpr glm::vec2 hat[] = {{0.0f, 0.17f}, {0.26f, 0.0f}, {0.25f, -0.01f}, {0.0f, 0.1f}};
        part::turned(parts.of(materials.dough), hat, {0, 1.64f, 0.02f}, 20);
        return;
    }
    constexpr glm::vec2 hood[] = {{0.0f, 0.31f},  {0.07f, 0.295f}, {0.115f, 0.24f},
                                  {0.13f, 0.16f}, {0.125f, 0.08f}, {0.15f, 0.0f}};
    part::turned(parts.of(metric.coat), hood, {0, 1.46f, -0.025f}, 16);
}

void add_metric(FrameBuilder& builder, const Materials& materials, const Metric& metric) {
    Parts parts(builder);
    constexpr glm::vec2 coat[] = {{0.08f, 1.5f},  {0.17f, 1.46f}, {0.215f, 1.38f}, {0.22f, 1.2f},
                                  {0.205f, 1.0f}, {0.23f, 0.8f},  {0.27f, 0.5f},   {0.2f, 0.48f}};
    Mesh& cloth = parts.of(metric.coat);
    part::turned(cloth, coat, glm::vec3(0), 20);
    for (glm::vec3& position : cloth.positions) position.z *= 0.72f;
    for (glm::vec3& normal : cloth.normals) normal = glm::normalize(normal / glm::vec3(1, 1, 0.72f));
    for (std::size_t i = 0; i < cloth.tangents.size(); ++i) {
        const glm::vec3 along = glm::vec3(cloth.tangents[i]) * glm::vec3(1, 1, 0.72f);
        cloth.tangents[i] = glm::vec4(glm::normalize(along - cloth.normals[i] * glm::dot(along, cloth.normals[i])), 1);
    }
    add_head(parts, materials, metric);
    for (const float s : {-1.0f, 1.0f}) {
        const float z = s * metric.stride / 2;
        const glm::vec3 leg[] = {{0.1f * s, 0.6f, 0.3f * z}, {0.1f * s, 0.3f, 0.7f * z}, {0.1f * s, 0.05f, z}};
        part::pipe(parts.of(materials.dark_coat), leg, 0.075f, 10);
        part::box(parts.of(materials.rubber), {0.1f * s - 0.055f, 0, z - 0.1f}, {0.1f * s + 0.055f, 0.1f, z + 0.17f});
        const bool holds = s > 0 && metric.umbrella != no_index;
        const glm::vec3 hand = holds ? glm::vec3(0.2f, 1.22f, 0.27f) : glm::vec3(0.29f * s, 0.85f, 0.1f);
        const glm::vec3 arm[] = {{0.19f * s, 1.4f, 0}, {0.27f * s, 1.12f, -0.02f}, hand};
        part::pipe(cloth, arm, 0.06f, 10);
        part::ball(parts.of(materials.skin), hand, {0.045f, 0.05f}, 10);
        if (holds) add_umbrella(parts.of(metric.umbrella), parts.of(materials.iron), hand);
    }
    parts.draw(metric.place);
}

}  // namespace

void add_people(FrameBuilder& builder, const Materials& materials) {
    add_metric(
        builder, materials,
        {.place = {.position = {1.98, 0, -6.0}, .yaw = -1.2}, .coat = materials.dark_coat, .headwear = Headwear::straw_hat});
    add_metric(builder, materials,
               {.place = {.position = {-2.3, 0, -4.25}, .yaw = 0.9}, .coat = materials.coat, .headwear = Headwear::straw_hat});
    add_metric(builder, materials, {.place = {.position = {0.62, 0, -7.05}, .yaw = 1.9}, .coat = materials.coat});
    const double walked = 0.35 * (builder.progress() - 1);
    add_metric(builder, materials,
               {.place = {.position = {-0.46, 0, -8.15 - walked}, .yaw = 2.9},
                .coat = materials.dark_coat,
                .umbrella = materials.red_nylon,
                .stride = 0.5f});
    add_metric(builder, materials,
               {.place = {.position = {1.3, 0, -14.2 + walked}, .yaw = 0.2},
                .coat = materials.dark_coat,
                .umbrella = materials.dark_nylon,
                .stride = 0.4f});
    add_metric(builder, materials,
               {.place = {.position = {0.75, 0, -14.5 + walked}, .yaw = 0.1}, .coat = materials.coat, .stride = 0.3f});
}

}  // namespace strata::scenario::market
