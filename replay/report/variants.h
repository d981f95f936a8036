// The rows of a report before anything is measured: techniques with their settings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "replay/report/report.h"

namespace strata {

struct Variant {
    const Technique* technique = nullptr;
    Request request;
    std::string settings;  ///< "falloff=20 weight=w9"
};

/// Technique and settings in one.
std::string label(std::string_view technique, std::string_view settings);
/// The same without the stage, where that is named once above all.
std::string below_stage(std::string_view label);
/// Names any row that has a technique and settings, without the stage: "weighted weight=w9".
template <typename Row>
std::string short_label(const Row& row) {
    return below_stage(label(row.technique, row.settings));
}

/// "key=value ..." of the technique, or "name key=value ..." of another of its stage, which may not be on the list any more.
Result<Variant> variant_of(const Technique&, std::string_view way, const Request& base);

/// Fails (usage) for a stage without techniques.
Result<void> check_has_techniques(Stage);

/// Every technique of the stage at its defaults and at each of its variants; or, with sweeps, with every combination of those
/// whose keys it has. Fails for a key that no technique has.
Result<std::vector<Variant>> variants(const ReportRequest&);

}  // namespace strata
