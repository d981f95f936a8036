// What the rows of a report are measured against: the stage's truth, or what stands in for it where a frame is too large.
#pragma once

#include <string>

#include "replay/report/picture_error.h"
#include "replay/report/report.h"
#include "replay/report/variants.h"

namespace strata {

/// With the extent at which models are affordable.
struct Yardstick {
    ImageSet truth;
    std::string name;
    std::uint32_t model_divisor = 1;
    std::optional<PictureTruth> picture = {};  ///< with ErrorAt::picture
};

Result<Yardstick> find_yardstick(Session&, const ReportRequest&, const View&);

/// A row's errors against it, and against its technique's model.
Result<Accuracy> measure_accuracy(Session&, const Variant&, Stage, const Yardstick&);

}  // namespace strata
