// What techniques of transparency make of one pixel: T(z) of each, sampled along the ray by the device's own code path, beside
// the exact step function of the pixel's fragments. Command line and inspector make the same call.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "passes/reference/fragments.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

struct PixelAt {
    std::uint32_t x = 0, y = 0, sample = 0;
};

enum class DepthAxis { logarithmic, linear };

inline constexpr std::uint32_t most_probe_depths = 8192;

struct ProbeOptions {
    /// "transparency/name key=value ..."; what is not set is the technique's default. Empty: every technique of the stage.
    std::vector<std::string> variants;
    std::uint32_t samples = 512;  ///< along the ray, evenly on the axis: 2 to 8192
    DepthAxis axis = DepthAxis::logarithmic;
    double from = 0, to = 0;  ///< meters; 0: around the pixel's fragments. Kept within the frame's range
};

/// Errors against the exact step function (docs/algorithms/transparency.md 9.3), averaged over the color channels.
struct ProbeMetrics {
    double l1_logarithmic = 0, l1_linear = 0;  ///< integral of |T^ - T| over the probed range as 0 to 1 in ln z, and in z
    /// The most |T^ - T| farther from every step than 1% of the axis; nothing where steps are everywhere.
    std::optional<double> worst_off_steps;
    double fragment_weighted = 0;  ///< sum of (1 - t) |T^ - T| over the fragments / sum of 1 - t
    double total = 0;              ///< T^ - T behind everything
    /// Root mean square of the distance of the recorded frame's pixel from the exact one, of white (add_display_errors).
    std::optional<double> display_error = {};
};

/// From one depth to another, meters.
struct DepthSpan {
    double from = 0, to = 0;
};

struct ProbeCurve {
    std::string variant;                   ///< as asked for
    std::string not_supported;             ///< why there is no curve, where the technique cannot do these fragments
    std::vector<glm::dvec3> through;       ///< T^ at Probe::depths
    std::vector<glm::dvec3> at_fragments;  ///< T^ a millionth in front of each of Probe::fragments
    glm::dvec3 total{1};                   ///< T^ behind everything
    ProbeMetrics metrics;
    /// Where a technique cuts depth into slices: its table "slices", whose first columns are where each begins and ends.
    std::vector<DepthSpan> slices;
    std::vector<std::string> notes;
};

struct Probe {
    std::size_t frame = 0;
    PixelAt at;
    DepthAxis axis = DepthAxis::logarithmic;
    double from = 0, to = 0;                   ///< meters
    double nearest = 0, farthest = 0;          ///< the frame's range of depth, which techniques map by
    bool colored = false;                      ///< whether any fragment lets colors through differently
    bool undecided = false;                    ///< the list of fragments hangs on rounding
    std::vector<Fragment> fragments;           ///< nearest first
    std::vector<glm::dvec3> before_fragments;  ///< exact T in front of each
    std::vector<double> depths;                ///< of the samples, meters
    std::vector<glm::dvec3> exact;             ///< T at them
    glm::dvec3 exact_total{1};
    std::vector<ProbeCurve> curves;
    DeviceInfo device;
    std::string capture_id = {}, capture_name = {}, date = {};  ///< for JSON, the caller's; utc_date()
};

/// Display errors among the figures. Fails (usage) for a pixel outside the picture or without a fragment, and for techniques and
/// settings that do not exist.
Result<Probe> probe(Session&, const Request&, PixelAt, const ProbeOptions&);

/// Fills ProbeMetrics::display_error of the curves that lack it, where an exact technique can do the frame. Draws of one object,
/// their order and the layers that a technique keeps are those of the frame, which fragments alone do not show.
Result<void> add_display_errors(Session&, const Request&, Probe&);

/// The same of given fragments, at least one, in submission order, no two of one number; nearest to farthest is the range of
/// depth techniques map by.
struct ProbedStack {
    std::vector<Fragment> fragments;
    double nearest = 1, farthest = 2;
    std::uint64_t seed = 0;
};
Result<Probe> probe(Session&, ProbedStack, const ProbeOptions&);

/// Fragments in order, then figures by technique, best first.
Page page_of(const Probe&);
std::string as_text(const Probe&);
std::string as_json(const Probe&);
/// The fragments and the figures as one table.
std::string as_csv(const Probe&);
/// A line per sample; T in three columns where glass is colored.
std::string curves_csv(const Probe&);
/// T(z), T^ - T and the fragments over a common axis of depth.
std::string as_svg(const Probe&);

}  // namespace strata
