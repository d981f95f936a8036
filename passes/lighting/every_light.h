// Every light on every sample of a decoded G-buffer, in double: what the truth is and what brute force does. Techniques that keep
// lists leave some out.
#pragma once

#include <functional>
#include <vector>

#include "passes/reference/blockers.h"
#include "passes/reference/lights.h"
#include "passes/tolerance.h"

namespace strata::lighting {

/// As the shaders do it, or with area lights integrated (passes/reference/lights.h).
enum class LightForm { real_time, exact };

/// What is left out, or done otherwise.
struct LightFilter {
    /// Whether the pixel's list has the light, by its place in shining_lights(); none: all are listed.
    std::function<bool(glm::uvec2 pixel, std::size_t light)> lists = {};
    bool asks_blockers = true;  ///< else they let light through
    /// What a surface reflects of a light in real time; none: reflected() of passes/reference/lights.h.
    std::function<glm::dvec3(const Frame&, const SurfacePoint&, const Light&)> reflects = {};
};

class EveryLight {
public:
    /// Reads surface_normal, surface_color, surface_material and, where it exists, visibility.
    explicit EveryLight(const StageInput&, LightForm = LightForm::real_time, LightFilter = {});

    std::uint32_t width() const { return normal_->width; }
    std::uint32_t height() const { return normal_->height; }
    std::uint32_t samples() const { return normal_->layers; }
    /// Radiance reflected to the eye; zero where there is no surface. Positions are the pixel center's, as readers' are.
    glm::dvec3 at(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;

private:
    struct ShadowedLight {
        Light light;
        glm::dvec4 from{0};  ///< light_point()
        LightBlockers blockers;
        std::uint32_t visibility_layer = no_index;  ///< of sample 0
    };
    glm::dvec3 arriving(const ShadowedLight&, const SurfacePoint&) const;
    SurfacePoint surface(std::uint32_t x, std::uint32_t y, std::uint32_t sample) const;

    const Frame* frame_;
    LightForm form_;
    LightFilter filter_;
    const ReferenceImage *normal_, *color_, *material_, *visibility_ = nullptr;
    std::vector<ShadowedLight> lights_;
};

/// What a technique gives that leaves out no other light that adds anything: real-time forms, sample 0 of plain pixels for all of
/// their samples, within what a half float holds.
ImageSet light_of_shaded_samples(const StageInput&, const LightFilter& = {});

/// How far the device may be from that, and from the same sum over fewer lights.
inline constexpr Tolerance shaded_light_tolerance = {
    .rmse = 1e-3,
    .worst = 4e-3,
    .because =
        "light is stored as half floats of undefined rounding (2^-10 of itself); float normals move a lobe of alpha "
        "0.002 by 1e-4 of its width"};

}  // namespace strata::lighting
