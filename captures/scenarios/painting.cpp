#include "captures/scenarios/painting.h"

#include <utility>

#include "capture_format/codec/texture_mips.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/texture.h"
#include "capture_format/srgb.h"
#include "captures/scenarios/random.h"

namespace strata::scenario {
namespace {

/// Bilinear between the corners of the lattice cell, eased at both ends.
template <typename Corner>
float eased(glm::vec2 p, const Corner& corner) {
    const glm::vec2 cell = glm::floor(p), f = p - cell, s = f * f * (3.0f - 2.0f * f);
    const auto x = static_cast<std::int64_t>(cell.x), y = static_cast<std::int64_t>(cell.y);
    return glm::mix(glm::mix(corner(x, y), corner(x + 1, y), s.x), glm::mix(corner(x, y + 1), corner(x + 1, y + 1), s.x), s.y);
}

}  // namespace

Texture painted(std::string name, const Canvas& canvas, const Paint& paint) {
    Texture texture;
    texture.name = std::move(name);
    texture.format = canvas.format;
    texture.width = texture.height = canvas.edge;
    const std::uint32_t places = canvas.places;
    for (std::uint32_t y = 0; y < canvas.edge; ++y)
        for (std::uint32_t x = 0; x < canvas.edge; ++x) {
            glm::vec4 sum(0);
            for (std::uint32_t i = 0; i < places * places; ++i) {
                const glm::vec2 within = (glm::vec2(i % places, i / places) + 0.5f) / static_cast<float>(places);
                sum += paint((glm::vec2(x, y) + within) / static_cast<float>(canvas.edge));
            }
            const glm::vec4 mean = sum / static_cast<float>(places * places);
            for (int c = 0; c < 3; ++c)
                texture.texels.push_back(unorm8(canvas.format == TextureFormat::rgba8_srgb ? encode_srgb(mean[c]) : mean[c]));
            texture.texels.push_back(unorm8(mean.w));
        }
    return with_mips(std::move(texture));
}

Texture relief(std::string name, std::uint32_t edge, const std::function<float(glm::vec2 uv)>& height) {
    const float step = 1.0f / static_cast<float>(edge);
    return painted(std::move(name), {.edge = edge, .format = TextureFormat::rgba8_unorm}, [&](glm::vec2 uv) {
        const float here = height(uv);
        const glm::vec2 slope(height(uv + glm::vec2(step, 0)) - here, height(uv + glm::vec2(0, step)) - here);
        const glm::vec3 normal = glm::normalize(glm::vec3(-slope.x / step, slope.y / step, 1));  // v grows downwards
        return glm::vec4(normal * 0.5f + 0.5f, 1);
    });
}

float hashed(std::int64_t x, std::int64_t y, std::uint64_t seed) {
    const auto i = static_cast<std::uint64_t>(x), j = static_cast<std::uint64_t>(y);
    return static_cast<float>(Random(seed + i * 0x632be59bd9b4e019ull + j * 0x9e6c63d0676a9a99ull).unit());
}

float noise(glm::vec2 p, std::uint64_t seed) {
    return eased(p, [seed](std::int64_t x, std::int64_t y) { return hashed(x, y, seed); });
}

float fractal_noise(glm::vec2 p, std::uint64_t seed) {
    float sum = 0, weight = 0.5f;
    for (std::uint64_t octave = 0; octave < 4; ++octave, p *= 2.0f, weight *= 0.5f) sum += weight * noise(p, seed + octave);
    return sum / 0.9375f;  // 1/2 + 1/4 + 1/8 + 1/16
}

float tiling_noise(glm::vec2 uv, std::uint32_t cells, std::uint64_t seed) {
    float sum = 0, weight = 0.5f;
    for (std::uint64_t octave = 0; octave < 3; ++octave, cells *= 2, weight *= 0.5f) {
        const auto period = static_cast<std::int64_t>(cells);
        const auto wrapped = [period](std::int64_t i) { return (i % period + period) % period; };
        sum += weight * eased(uv * static_cast<float>(cells),
                              [&](std::int64_t x, std::int64_t y) { return hashed(wrapped(x), wrapped(y), seed + octave); });
    }
    return sum / 0.875f;  // 1/2 + 1/4 + 1/8
}

}  // namespace strata::scenario
