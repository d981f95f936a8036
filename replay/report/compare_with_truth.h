// A replay beside the truth of one of its stages, image by image: what A is in a comparison that says where an error stands.
#pragma once

#include <string>

#include "replay/difference/comparison.h"
#include "replay/report/report.h"

namespace strata {

struct TruthComparison {
    FrameComparison frame;  ///< of one pass
    std::string truth;      ///< its name, as a report has it
};

/// ErrorAt::stage: the images that the stage's technique gives, beside the truth on what the stages before it gave.
/// ErrorAt::picture: the picture, beside the one that the later stages make of the truth. Texels whose truth rounding decides are
/// compared with the nearest value that it allows; where that is not known they count as equal, and a note says how many. Fails
/// where a report of the stage has no such truth, and at a stage that makes no light.
Result<TruthComparison> compare_with_truth(const RunToCompare&, Stage, ErrorAt, const ErrorLimits&, const SeeImages&);

}  // namespace strata
