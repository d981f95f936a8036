// What a frame says, derived once and kept with the loaded frame: features, lights, draw lists, bounds, shadow views, depths. The
// device's records and every declaration read it; models, truths and judges derive what they need by their own code.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "capture_format/frame/light.h"
#include "capture_format/frame_features.h"
#include "passes/depth_range.h"
#include "passes/graph/step.h"
#include "passes/scene/draw_bounds.h"
#include "passes/scene/draw_lists.h"
#include "passes/scene/fragment_bounds.h"
#include "passes/scene/material_uses.h"
#include "passes/scene/shadow_views.h"
#include "passes/scene/transparent_depths.h"

namespace strata {

class Readers;  // passes/scene/readers.h

/// A value made at first use.
template <typename Value>
class Kept {
public:
    template <typename Make>
    const Value& get(const Make& make) const {
        if (!value_) value_.emplace(make());
        return *value_;
    }
    bool is_made() const { return value_.has_value(); }

private:
    mutable std::optional<Value> value_;
};

/// Refers to the frame, which must stay where it is and as it is. Each member is derived when it is first asked for: one thread
/// at a time.
class SceneFacts {
public:
    explicit SceneFacts(const Frame&);
    ~SceneFacts();
    SceneFacts(const SceneFacts&) = delete;
    SceneFacts& operator=(const SceneFacts&) = delete;

    const Frame& frame() const { return *frame_; }
    /// As recorded: a request may force others on.
    const Features& features() const;
    const DrawLists& lists() const;
    std::span<const Light> lights() const;
    const DrawBounds& bounds() const;
    const std::vector<ShadowView>& shadow_views(Allocation) const;
    const Readers& readers() const;
    DepthRange transparent_depths() const;
    DepthRange world_depths() const;
    float farthest_depth_offset() const;
    /// Of transparent geometry on images of an extent with 1 or 4 samples per pixel.
    const FragmentBounds& fragment_bounds(Extent, std::uint32_t samples) const;
    const MaterialUses& material_uses(Surfaces) const;
    /// What lights and materials need (light_features.h), and what of it the view may show (frame_spectrum.h).
    std::uint32_t light_features() const;
    std::uint32_t spectrum() const;
    /// The most iterations that a loop over all lights with their blockers takes (light_list.h).
    std::uint64_t light_iterations() const;
    /// Every spectrum that a tile may have, of the given features alone (frame_spectrum.h).
    const std::vector<std::uint32_t>& possible_spectra(std::uint32_t features) const;
    /// Of everything transparent; 0 where nothing is in an interface layer.
    std::uint32_t highest_interface_layer() const;
    /// Of each of lists().casters (caster_hashes.h).
    const std::vector<std::uint64_t>& caster_hashes() const;

    /// How many members were derived so far, fragment bounds once per extent and samples and possible spectra once per set of
    /// features: asking for a member again adds nothing.
    std::size_t derived() const;

private:
    const Frame* frame_;
    Kept<Features> features_;
    Kept<DrawLists> lists_;
    Kept<std::vector<Light>> lights_;
    Kept<DrawBounds> bounds_;
    Kept<std::vector<ShadowView>> views_[2];  ///< by Allocation
    Kept<std::unique_ptr<Readers>> readers_;
    Kept<DepthRange> transparent_depths_, world_depths_;
    Kept<float> farthest_depth_offset_;
    mutable std::map<std::array<std::uint32_t, 3>, FragmentBounds> fragment_bounds_;  ///< by width, height and samples
    Kept<MaterialUses> material_uses_[2];                                             ///< by Surfaces
    Kept<std::uint32_t> light_features_, spectrum_, highest_interface_layer_;
    Kept<std::vector<std::uint64_t>> caster_hashes_;
    mutable std::map<std::uint32_t, std::vector<std::uint32_t>> possible_spectra_;  ///< by features
};

}  // namespace strata
