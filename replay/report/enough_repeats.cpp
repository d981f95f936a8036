#include "replay/report/enough_repeats.h"

#include <algorithm>
#include <cmath>

namespace strata {
namespace {

/// No less accurate, and faster by more than both spreads.
bool settles(const Standing& one, const Standing& other) {
    return one.error && one.compared_error() <= other.compared_error() && one.time + one.spread < other.time - other.spread;
}

/// Whether the limit falls within the row's spread, and no row that surely keeps it is more accurate.
bool hangs_on(const Standing& row, double most, std::span<const Standing> rows) {
    if (std::abs(row.time - most) > row.spread) return false;
    return std::ranges::none_of(rows, [&](const Standing& other) {
        return other.error && other.time + other.spread < most && other.compared_error() < row.compared_error();
    });
}

}  // namespace

std::vector<bool> uncertain_rows(std::span<const Standing> rows, const Question& question) {
    std::vector<double> limits;
    for (const Budget& budget : budgets())
        if (budget.cost == &Standing::time) limits.push_back(budget.most);
    if (question.within && question.gpu.empty()) limits.push_back(*question.within);
    std::vector<bool> may_be_on_front;
    for (const Standing& row : rows)
        may_be_on_front.push_back(row.error &&
                                  std::ranges::none_of(rows, [&](const Standing& other) { return settles(other, row); }));
    std::vector<bool> uncertain;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Standing& row = rows[i];
        bool is_uncertain = false;
        for (std::size_t j = 0; j < rows.size() && may_be_on_front[i]; ++j)
            is_uncertain = is_uncertain || (j != i && may_be_on_front[j] && are_level(row, rows[j]));
        if (row.error)
            is_uncertain = is_uncertain || std::ranges::any_of(limits, [&](double most) { return hangs_on(row, most, rows); });
        uncertain.push_back(is_uncertain);
    }
    return uncertain;
}

std::vector<bool> rows_far_behind(std::span<const Standing> rows) {
    std::vector<bool> far(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < rows.size() && !far[i]; ++j)
            far[i] = rows[i].error && rows[j].error && rows[j].compared_error() <= rows[i].compared_error() &&
                     2 * rows[j].time < rows[i].time;
    return far;
}

}  // namespace strata
