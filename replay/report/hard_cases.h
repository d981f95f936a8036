// What every technique of transparency makes of the frames on which such techniques come to grief (captures/hard_cases.h): a
// matrix of settings and case. A failure is documented where the technique says how large it is (Technique::known_failures), of
// its defaults alone.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "captures/hard_cases.h"
#include "replay/report/variants.h"
#include "replay/session/session.h"
#include "replay/tables/sheet.h"

namespace strata {

/// Shares of the front card over a case's frames.
struct Shares {
    double smallest = 0, largest = 0;
};

struct HardOutcome {
    /// undocumented: a failure the technique does not know of, or of another size than it says: a bug of code or of record.
    /// undeserved: it holds what it says it does not. fails: at other settings than the defaults, of which techniques say
    /// nothing.
    enum class Verdict { holds, documented, undocumented, undeserved, fails, not_applicable } verdict = Verdict::holds;
    double error = 0;                   ///< as the case measures; infinite where a pixel is no number
    double documented = 0;              ///< what the technique says, where it does
    double model_worst = 0;             ///< GPU against model over the case's frames, relative
    std::string reason;                 ///< why it does not apply, or why it fails
    std::optional<Shares> shares = {};  ///< of a case that measures them (HardMeasure::share)
};

struct HardCaseRow {
    std::string technique, settings;    ///< as in Measurement
    std::vector<HardOutcome> outcomes;  ///< in the order of hard_cases()
};

struct HardCaseReport {
    DeviceInfo device;
    std::vector<HardCaseRow> rows;
    std::string stopped = {};  ///< what is missing because a stop was asked for: rows have the outcomes of the first cases
    std::string date = {};     ///< utc_date(); the caller's
};

/// Of techniques of transparency with their settings: variants(). Once a stop is requested it gives the cases that were measured
/// for all rows, or fails where there is none.
Result<HardCaseReport> measure_hard_cases(const DeviceChoice&, std::span<const Variant> rows,
                                          const std::function<void(std::string_view what, double done)>& = {},
                                          std::stop_token = {});

/// Whether a case's error is the recorded one, up to what may move with a device's last bits.
bool as_recorded(double error, double recorded);
/// "H14b": what a case's name begins with.
std::string_view id(const HardCase&);

/// A row for every case of every technique.
Sheet sheet_of(const HardCaseReport&);
/// The cases beside each other.
Page page_of(const HardCaseReport&);
std::string as_text(const HardCaseReport&);
std::string as_json(const HardCaseReport&);
std::string as_csv(const HardCaseReport&);
std::string_view name(HardOutcome::Verdict);
/// "ok", or the error with what it means: "!" a bug, "?" better than its record.
std::string matrix_cell(const HardOutcome&);

}  // namespace strata
