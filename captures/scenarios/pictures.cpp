#include "captures/scenarios/pictures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "captures/scenarios/painting.h"
#include "captures/scenarios/random.h"

namespace strata::scenario {
namespace {

constexpr Canvas linear{.format = TextureFormat::rgba8_unorm};

}  // namespace

Texture checker(std::uint32_t cells, glm::vec3 light, glm::vec3 dark) {
    return painted("checker", {}, [=](glm::vec2 uv) {
        const glm::vec2 cell = glm::floor(uv * static_cast<float>(cells));
        return glm::vec4(std::fmod(cell.x + cell.y, 2.0f) == 0 ? light : dark, 1);
    });
}

Texture puff(std::uint64_t seed) {
    Texture texture = painted("puff", linear, [=](glm::vec2 uv) {
        const glm::vec2 p = uv * 2.0f - 1.0f;
        const float torn = glm::length(p) + 0.5f * (fractal_noise(uv * 5.0f, seed) - 0.35f);
        const float border = std::clamp((1 - glm::length(p)) * 6, 0.0f, 1.0f);
        const float soft = std::clamp(1 - torn, 0.0f, 1.0f);
        return glm::vec4(glm::vec3(0.75f + 0.25f * fractal_noise(uv * 9.0f, seed + 99)), soft * soft * (3 - 2 * soft) * border);
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Texture glow() {
    Texture texture = painted("glow", linear, [](glm::vec2 uv) {
        const glm::vec2 p = uv * 2.0f - 1.0f;
        const float inside = std::max(0.0f, 1 - glm::dot(p, p));
        return glm::vec4(1, 1, 1, inside * inside);
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Texture streak() {
    Texture texture = painted("streak", {.edge = 32, .format = TextureFormat::rgba8_unorm}, [](glm::vec2 uv) {
        const glm::vec2 p = uv * 2.0f - 1.0f;
        const float across = std::max(0.0f, 1 - std::abs(p.x) * 11), along = std::max(0.0f, 1 - p.y * p.y);
        return glm::vec4(1, 1, 1, across * along);
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Texture foliage(std::uint64_t seed) {
    Texture texture = painted("foliage", {}, [=](glm::vec2 uv) {
        const glm::vec2 cell = glm::floor(uv * 5.0f), local = uv * 5.0f - cell;
        Random random(seed + static_cast<std::uint64_t>(cell.x * 7 + cell.y * 131));
        const float lean = random.between(-0.6f, 0.6f), length = random.between(0.7f, 1.0f), shade = random.between(0.5f, 1.0f);
        const glm::vec2 p((local.x - 0.5f) - lean * (local.y - 0.5f), (local.y - 0.5f) / length);
        const bool leaf = std::abs(p.x) < 0.3f * std::cos(p.y * std::numbers::pi_v<float>) && std::abs(p.y) < 0.5f;
        const bool stem = std::abs(local.x - 0.5f) < 0.06f;
        const glm::vec3 color = leaf ? glm::vec3(0.10f, 0.35f, 0.06f) * shade : glm::vec3(0.18f, 0.12f, 0.06f);
        return glm::vec4(color, leaf || stem ? 1 : 0);
    });
    texture.address = AddressMode::clamp;
    return texture;
}

Texture studs(std::uint32_t cells) {
    return painted("studs", linear, [=](glm::vec2 uv) {
        const glm::vec2 local = glm::fract(uv * static_cast<float>(cells)) * 2.0f - 1.0f;
        const float r = glm::length(local);
        const glm::vec2 slope = r < 0.7f ? local / 0.7f * 0.6f : glm::vec2(0);
        const glm::vec3 normal = glm::normalize(glm::vec3(slope.x, -slope.y, 1));  // green is up, v grows downwards
        return glm::vec4(normal * 0.5f + 0.5f, 1);
    });
}

}  // namespace strata::scenario
