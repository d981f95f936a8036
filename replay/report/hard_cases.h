// What every technique of transparency makes of the frames on which such methods come to grief (captures/hard_cases.h): a matrix
// of technique and case. A failure is documented where the technique says how large it is (Technique::known_failures).
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "captures/hard_cases.h"
#include "replay/session.h"

namespace strata {

struct HardOutcome {
    /// undocumented: a failure the technique does not know of, or of another size than it says: a bug of code or of record.
    /// undeserved: it holds what it says it does not.
    enum class Verdict { holds, documented, undocumented, undeserved, not_applicable } verdict = Verdict::holds;
    double error = 0;        ///< as the case measures; infinite where a pixel is no number
    double documented = 0;   ///< what the technique says, where it does
    double model_worst = 0;  ///< GPU against model over the case's frames, relative
    std::string reason;      ///< why it does not apply, or why it fails
};

struct HardCaseRow {
    std::string technique, settings;
    std::vector<HardOutcome> outcomes;  ///< in the order of hard_cases()
};

struct HardCaseReport {
    DeviceInfo device;
    std::vector<HardCaseRow> rows;
};

/// Measures hard_cases() with every technique of the stage at its defaults.
Result<HardCaseReport> measure_hard_cases(const DeviceChoice&,
                                          const std::function<void(std::string_view what, double done)>& = {});

std::string as_text(const HardCaseReport&);
std::string as_json(const HardCaseReport&);
std::string_view name(HardOutcome::Verdict);

}  // namespace strata
