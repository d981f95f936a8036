// What a frame contains, as named bits, each with the reason it is set. Stages ask these bits whether they are needed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace strata {

struct Frame;  // capture_format/frame.h

enum class Feature : std::uint32_t {
    opaque,
    masked,
    transparent,
    chromatic,
    additive,
    particles,
    soft_particles,
    distortion,
    low_resolution,
    interface_layers,
    emissive,
    multisampled,
    sun,
    local_lights,
    shadows,
    hemisphere,
    fog,
    light_volumes,
    blockers,
    portals,
    projected_textures,
    area_lights,
    clip_planes,
    darks,
    rain,
    sun_shafts,
    bloom,
    auto_exposure,
    depth_of_field,
    lens_distortion,
    grain,
    count_,
};

/// The feature's name on the command line: the enumerator.
std::string_view name(Feature);
/// All features, in order.
std::span<const Feature> all_features();
std::optional<Feature> find_feature(std::string_view name);

/// A set of features; every member carries the sentence that says why it is in.
class Features {
public:
    bool has(Feature feature) const { return reasons_[static_cast<std::size_t>(feature)].has_value(); }
    /// Why it is in ("draw 'pane' uses material 'glass' with alpha mode blend"), or empty.
    std::string_view reason(Feature) const;
    /// Adds the feature; the first reason stays.
    void set(Feature, std::string reason);

private:
    std::array<std::optional<std::string>, static_cast<std::size_t>(Feature::count_)> reasons_;
};

/// What the frame contains. Looks at what is used, not at what is declared: an unused blend material sets nothing.
Features frame_features(const Frame&);

}  // namespace strata
