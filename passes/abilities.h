// What some techniques can do and others cannot.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace strata {

/// Variants of a technique's shader, of which every tile is shaded by one: its shading modes.
struct ShaderVariants {
    std::string_view constant;  ///< specialization constant that holds a variant's number
    std::string_view view;      ///< of the technique: the number of each pixel's variant, below 0 where nothing is shaded
    std::string_view table;     ///< of the technique: a column named as the constant, one "tiles", and whatever tells them apart
};

/// Shading modes that serve tiles by the features these need of lights and surfaces.
struct FeatureModes {
    std::string_view table;                   ///< of the technique: spectra; columns spectrum, tiles, mode, superfluous
    std::string_view constant;                ///< specialization constant that holds the features of a pipeline's mode
    std::string_view count;                   ///< parameter: how many modes there are
    std::span<const std::string_view> modes;  ///< parameters: the features of each
};

/// What some techniques can do and others cannot. A verb that needs one finds those that have it.
struct Abilities {
    std::optional<ShaderVariants> variants = {};
    std::optional<FeatureModes> feature_modes = {};
    /// Of the table that says where its slices of depth lie, in meters: from the first column to the second; empty: it has none.
    std::string_view slices_table = {};
    /// Exact up to rounding: may stand in for the stage's truth where that is too slow, once its own error is known.
    bool stands_in_for_truth = false;
    /// The common way to do the stage: reports give the others' times as multiples of its time.
    bool is_time_unit = false;
    /// Draws objects and particles in an order that the host sorts in every frame (passes/scene/object_order.h).
    bool sorts_objects = false;
    /// Leaves work to the next frame that this then need not do (Remembered::work), so that a frame in which nothing changes
    /// costs less than its first one.
    bool keeps_work = false;
};

}  // namespace strata
