// What the rows of a report are measured against: the stage's truth, or what stands in for it where a frame is too large.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "replay/report/picture_error.h"
#include "replay/report/report.h"
#include "replay/report/variants.h"

namespace strata {

/// With the extent at which models are affordable.
struct RowTruth {
    TruthRow of;
    ImageSet truth;
    std::string name;
    std::optional<StandardError> own_error = {};
    std::uint32_t model_divisor = 1;
    std::optional<PictureTruth> picture = {};  ///< with ErrorAt::picture
};

/// What a request's technique of a stage is judged by.
Result<TruthRow> truth_asked_by(const Request&, Stage, const Frame&);

/// One per truth that some of the rows approximate, in the order of the rows.
struct RowTruths {
    std::vector<RowTruth> all;
    std::vector<std::size_t> of_row;  ///< places in `all`
    ErrorAt error_at = ErrorAt::stage;
    std::string no_picture = {};  ///< Report::no_picture
};
Result<RowTruths> find_row_truths(Session&, const ReportRequest&, std::span<const Variant>, const Frame&);

/// A row's errors against it, and against its technique's model.
Result<Accuracy> measure_accuracy(Session&, const Variant&, Stage, const RowTruth&);

}  // namespace strata
