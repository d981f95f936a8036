// How restless techniques are while the eye moves: what an error does from one frame to the next is seen long before its size is.
#pragma once

#include <optional>
#include <span>
#include <vector>

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

/// A dolly towards what is transparent (or, where nothing is, opaque): a twentieth of the view depth in the middle of all of it
/// that lies before the eye, metres. Nothing where nothing does.
std::optional<double> default_dolly(const Frame&);

/// Of each of the rows, on the stage's first output, against the technique that stands in for the stage's truth; where none does,
/// against the truth in double, which takes as long per frame as the report's own. The report wants flicker, and its walk has a
/// dolly.
Result<std::vector<double>> measure_flicker(Session&, const ReportRequest&, std::span<const Request> rows, const Progress&);

}  // namespace strata
