// How restless techniques are while the eye moves: what an error does from one frame to the next is seen long before its size is.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "passes/gbuffer/coverage/judge.h"
#include "replay/report/report.h"

namespace strata {

/// Adds up, frame by frame, how much an error image changes.
class Flicker {
public:
    void add_frame(const ReferenceImage& got, const ReferenceImage& truth);
    /// Mean over texels, channels and steps of |(got - truth) of a frame - (got - truth) of the frame before|; 0 before there are
    /// two frames.
    double mean() const;

private:
    std::vector<glm::dvec3> error_;
    double sum_ = 0;
    std::size_t steps_ = 0;
};

/// Adds up, frame by frame, how much the error of the share of each pixel that masked surfaces cover changes: samples of a pixel
/// that change places cancel, as they do for who looks at the picture.
class CoverageFlicker {
public:
    void add_frame(std::span<const gbuffer::PixelCoverage>);
    /// Mean over steps, and over the pixels that masked surfaces cover in one of a step's frames, of |(got - wanted) of a frame -
    /// (got - wanted) of the frame before|; 0 before there are two frames.
    double mean() const;

private:
    std::vector<gbuffer::PixelCoverage> before_;
    double sum_ = 0;
    std::size_t pixels_ = 0;
};

/// Of one row of a report.
struct MeasuredFlicker {
    double error = 0;                ///< of the stage's first output
    std::optional<double> coverage;  ///< Measurement::coverage_flicker
};

/// A dolly towards what is transparent (or, where nothing is, opaque): a twentieth of the view depth in the middle of all of it
/// that lies before the eye, meters. Nothing where nothing does.
std::optional<double> default_dolly(const Frame&);

/// Of each of the rows against the technique that stands in for the stage's truth; where none does, against the truth in double
/// that the row's settings approximate, which takes as long per frame as the report's own. The report wants flicker, and its walk
/// has a dolly.
Result<std::vector<MeasuredFlicker>> measure_flicker(Session&, const ReportRequest&, std::span<const Request> rows,
                                                     const Progress&);

}  // namespace strata
