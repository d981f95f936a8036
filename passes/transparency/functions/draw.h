// How every technique that is a transmittance function T(z) draws and resolves: C = sum p T(z), X = sum of optical depths,
// N = sum (1 - t) T(z), E = sum e T(z), then L = L_behind exp(-X) + C (1 - exp(-X)) / N + E. For the exact T the factor is 1:
// sum (1 - t_i) T_i telescopes (docs/algorithms/transparency.md 1 and 7). Techniques differ in T alone. Sums have no order, so
// those of draws at half resolution, which look T(z) up like the others, are added to those at full resolution when they are
// resolved.
#pragma once

#include <functional>
#include <string>

#include "capture_format/frame/draw.h"
#include "passes/debug_views.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/settings.h"
#include "passes/transparency/functions/function.shared.h"

namespace strata::transparency {

/// What D is a sum of: of how far away what is behind is seen, or, for a view, of how far fragments have moved.
enum class Offsets { distortion, motion };

struct SumOptions {
    std::uint32_t accumulation = accumulation_half;  ///< formats: see function.shared.h
    std::uint32_t tint = tint_total;                 ///< another is for techniques with one channel of T(z)
    Offsets offsets = Offsets::distortion;
};

/// X and N have three channels where the frame has colored transmission; with a tint there N has four, see outputs.glsl.
/// E is there only where something emits, the offset D where something distorts or motion is asked for.
struct ResolutionSums {
    Image color, extinction, normalizer, emission, offset;
};
struct FunctionSums {
    ResolutionSums full;     ///< drawn with the frame's samples
    ResolutionSums low;      ///< half the extent, one sample; no images where nothing is drawn so
    FrameImages low_images;  ///< what those draws see
    SumOptions options;      ///< nothing tints in a gray frame
};

/// Cleared sums.
FunctionSums create_sums(Graph&, const FrameImages&, const SumOptions&);

/// Declares the draws that add every fragment to the sums: one, and more in a frame of two resolutions. The fragment shader
/// includes outputs.glsl and calls write_fragment(); `chain` adds the technique's own verbs to each.
void draw_into(Graph&, const std::string& shader, const FrameImages&, FunctionSums&,
               const std::function<void(DrawStep&, Resolution)>& chain);

/// Blends the sums over images.color.
void resolve_sums(Graph&, FrameImages&, const FunctionSums&);

/// The sums as steps after the draw read them, and the beginning of such a step, which includes sums.glsl: X and N are
/// bound.
FunctionSums by_sample(Graph&, const FunctionSums&);
ComputeStep over_sums(Graph&, const std::string& shader, const FrameImages&, const FunctionSums& by_sample);

/// The rows of the `accumulation` and `tint` parameters.
extern const Param accumulation_row, tint_row;

/// Rows of FunctionCounters: what is drawn; with those of the lists in front for techniques that make lists.
std::vector<Counter> function_counters();
std::vector<Counter> function_counters_with_lists();

/// (1 - exp(-X)) / N of the first sample's first channel, 1 where nothing is drawn: how far T(z) is from a function that
/// telescopes.
Image normalization_view(Graph&, const FrameImages&, const FunctionSums&);

/// A technique's own part: everything up to the sums.
using SumsFunction = FunctionSums (*)(Graph&, FrameImages&, const Settings&, Offsets);

/// Technique::add of a technique that is its sums.
template <SumsFunction sums>
void add_function(Graph& graph, FrameImages& images, const Settings& settings) {
    resolve_sums(graph, images, sums(graph, images, settings, Offsets::distortion));
}

/// The row of its normalization view.
DebugView normalization_row(Image (*declare)(Graph&, FrameImages&, const Settings&));
template <SumsFunction sums>
DebugView normalization_row() {
    return normalization_row([](Graph& graph, FrameImages& images, const Settings& settings) {
        return normalization_view(graph, images, sums(graph, images, settings, Offsets::distortion));
    });
}

}  // namespace strata::transparency
