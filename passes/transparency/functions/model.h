// The draw and the resolve of draw.h in double: for techniques that are a transmittance function.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "passes/blend_rounding.h"
#include "passes/image_set.h"
#include "passes/reference/fragments.h"
#include "passes/transparency/functions/function.shared.h"

namespace strata {

struct StageInput;  // passes/stage_input.h

}  // namespace strata

namespace strata::transparency {

/// T(z) at a fragment, per channel.
using Transmittance = std::function<glm::dvec3(const Fragment&)>;

/// What a fragment with T = 0 in all channels does to the sum of optical depths; to the other sums it adds nothing anyway.
enum class Unseen { counts, adds_nothing };

/// How fragments are summed.
struct Summing {
    /// The sums are rounded to its formats at every blend; accumulation_single stays in double.
    std::uint32_t accumulation = accumulation_single;
    BlendRounding rounding = {};
    bool chromatic = false;
    Unseen unseen = Unseen::counts;
    std::uint32_t tint = tint_total;
};

/// One sample: fragments in submission order weighted by T over what is behind.
glm::dvec3 function_blend(std::span<const Fragment>, glm::dvec3 behind, const Transmittance&, const Summing& = {});

/// tau = -ln t, at most largest_optical_depth.
double optical_depth_in_double(double t);

/// Optical depth of one of `channels` functions, 3 or 1: of a channel, or of the luminance that is let through.
double channel_depth(const Fragment&, std::size_t channel, std::size_t channels);

/// T of a sample from all its fragments, in submission order.
using FunctionOfSample = std::function<Transmittance(std::span<const Fragment>)>;
ImageSet function_model(const StageInput&, std::uint32_t accumulation, const FunctionOfSample&);

/// Number by number; all texels have as many.
void add_numbers(std::vector<double>& sum, std::span<const double> numbers, double share);

/// A technique with a prepass at the extent divided by `divisor`, at one sample per texel.
struct PrepassModel {
    std::uint32_t divisor = 1;
    enum class Filter { linear, nearest } filter = Filter::linear;
    /// Whether opaque surfaces hide fragments from the prepass.
    enum class Tested { against_opaque, against_nothing } tested = Tested::against_opaque;
    Unseen unseen = Unseen::counts;
    std::uint32_t tint = tint_total;
    /// What the prepass keeps of a texel's fragments. Called for a texel when it is read; again if it is read again much later.
    std::function<std::vector<double>(std::span<const Fragment>, glm::uvec2 texel)> project;
    /// Adds a texel's share to what is read.
    std::function<void(std::vector<double>& sum, std::span<const double> numbers, double share)> add = add_numbers;
    /// T of a sample from the (filtered) numbers of its place; `texel` is the nearest.
    std::function<Transmittance(std::span<const double>, glm::uvec2 texel)> function;
};
ImageSet function_model(const StageInput&, std::uint32_t accumulation, const PrepassModel&);

}  // namespace strata::transparency
