#include "replay/report/warnings.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "passes/metric.h"
#include "replay/plural.h"
#include "replay/report/report_columns.h"
#include "replay/report/variants.h"
#include "replay/session/choice_text.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

// A sample with more of the truth's energy decides errors of radiance.
constexpr double largest_brightest_share = .25;
// Over this share of the pixels shown white or black an error of light that does not show is the rule.
constexpr double largest_clipped_share = .25;
// Figures that order the rows less alike ask two questions.
constexpr double least_agreement = .8;
// A row of which the worst thousandth of the pixels has more of the squared error is off in a place, not everywhere.
constexpr double largest_concentration = .5;

std::optional<double> value_of(const std::vector<Metric>& metrics, std::string_view name) {
    const auto found = std::ranges::find(metrics, name, &Metric::name);
    return found == metrics.end() ? std::nullopt : std::optional(found->value);
}

/// Rows with both figures over what the stage touches.
struct BothFigures {
    std::vector<const Measurement*> rows;
    std::vector<double> display, relative;
};

BothFigures both_figures(const Report& report) {
    BothFigures both;
    for (const Measurement& row : report.rows) {
        const auto display = value_of(row.accuracy.touched, display_rmse);
        const auto relative = value_of(row.accuracy.touched, "relative rmse");
        if (row.has_other_truth || !display || !relative || !std::isfinite(*display) || !std::isfinite(*relative)) continue;
        both.rows.push_back(&row);
        both.display.push_back(*display), both.relative.push_back(*relative);
    }
    return both;
}

/// Its place among the values, from 1 on.
std::size_t place(const std::vector<double>& values, std::size_t i) {
    return 1 + std::size_t(std::ranges::count_if(values, [&](double value) { return value < values[i]; }));
}

void add_disagreement(const Report& report, std::vector<Warning>& warnings) {
    const BothFigures both = both_figures(report);
    const auto agreement = rank_agreement(both.display, both.relative);
    if (!agreement || *agreement >= least_agreement) return;
    std::size_t most = 0, furthest = 0;
    for (std::size_t i = 0; i < both.rows.size(); ++i) {
        const std::size_t a = place(both.display, i), b = place(both.relative, i), apart = a > b ? a - b : b - a;
        if (apart > most) most = apart, furthest = i;
    }
    warnings.push_back(
        {"metrics_disagree",
         fmt::format(
             "display rmse and relative rmse order the rows differently (rank agreement {:.2f}): {} is number {} of {} by "
             "the one and number {} by the other",
             *agreement, short_label(*both.rows[furthest]), place(both.display, furthest), both.rows.size(),
             place(both.relative, furthest))});
}

void add_concentrated(const Report& report, std::vector<Warning>& warnings) {
    std::vector<std::string> rows;
    for (const Measurement& row : report.rows) {
        const auto display = value_of(row.accuracy.touched, display_rmse);
        if (row.accuracy.footing && row.accuracy.footing->concentration > largest_concentration && display &&
            *display > exact_below)
            rows.push_back(short_label(row));
    }
    if (rows.empty()) return;
    warnings.push_back({"concentrated", fmt::format("over half of the squared error is in the worst thousandth of the pixels: {}",
                                                    first_of(rows))});
}

}  // namespace

bool changes_too_little(const Report& report) {
    const Measurement* row = first_measured(report);
    return row && row->accuracy.footing && row->accuracy.footing->pixels < fewest_pixels;
}

std::optional<double> rank_agreement(const std::vector<double>& a, const std::vector<double>& b) {
    double alike = 0, ordered_in_a = 0, ordered_in_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const int in_a = (a[i] > a[j]) - (a[i] < a[j]), in_b = (b[i] > b[j]) - (b[i] < b[j]);
            alike += in_a * in_b;
            ordered_in_a += in_a != 0, ordered_in_b += in_b != 0;
        }
    if (ordered_in_a == 0 || ordered_in_b == 0) return std::nullopt;
    return alike / std::sqrt(ordered_in_a * ordered_in_b);
}

std::vector<Warning> warnings_of(const Report& report) {
    std::vector<Warning> warnings;
    const Measurement* row = first_measured(report);
    if (!row || !row->accuracy.footing) return warnings;
    const Footing& footing = *row->accuracy.footing;
    if (footing.pixels < few_pixels)
        warnings.push_back({"few_pixels", fmt::format("the stage changes {}: {}", plural(footing.pixels, "pixel"),
                                                      changes_too_little(report)
                                                          ? "too few for an answer"
                                                          : "few; from another view the order of techniques may differ")});
    if (footing.brightest_share > largest_brightest_share)
        warnings.push_back({"one_sample", fmt::format("relative rmse rests on one sample: that of pixel ({}, {}) has {:.3g} % of "
                                                      "the energy that the stage changes",
                                                      footing.x, footing.y, 100 * footing.brightest_share)});
    if (footing.clipped_share > largest_clipped_share)
        warnings.push_back(
            {"clipped", fmt::format("{:.3g} % of the pixels that the stage changes are shown white or black, where "
                                    "display rmse sees no error; FLIP, which tries several exposures, does",
                                    100 * footing.clipped_share)});
    add_disagreement(report, warnings);
    add_concentrated(report, warnings);
    return warnings;
}

}  // namespace strata
