#include "replay/report/ranking.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "replay/tables/table.h"

namespace strata {

std::string RankingError::text(double error) const {
    return is_of_white ? short_number(100 * error) + " %" : short_number(error);
}

bool are_level(const Standing& a, const Standing& b) { return std::abs(a.time - b.time) <= a.spread + b.spread; }

std::vector<bool> pareto_front(std::span<const Standing> rows, Cost cost) {
    const auto beats = [&](const Standing& one, const Standing& other) {
        const double apart = cost == &Standing::time ? one.spread + other.spread : 0;
        const double error = one.compared_error(), of_other = other.compared_error();
        return error <= of_other && one.*cost <= other.*cost + apart && (error < of_other || one.*cost + apart < other.*cost);
    };
    std::vector<bool> front;
    for (const Standing& row : rows)
        front.push_back(row.error && std::ranges::none_of(rows, [&](const Standing& r) { return r.error && beats(r, row); }));
    return front;
}

std::vector<bool> ties_in_time(std::span<const Standing> rows) {
    std::vector<Standing> medians(rows.begin(), rows.end());
    for (Standing& row : medians) row.spread = 0;
    const std::vector<bool> front = pareto_front(rows, &Standing::time), by_median = pareto_front(medians, &Standing::time);
    std::vector<bool> ties;
    for (std::size_t i = 0; i < rows.size(); ++i) ties.push_back(by_median[i] && !front[i]);
    return ties;
}

std::span<const Budget> budgets() {
    static constexpr Budget all[] = {{&Standing::time, 1},
                                     {&Standing::time, 2},
                                     {&Standing::time, 4},
                                     {&Standing::bytes_per_pixel, 16},
                                     {&Standing::bytes_per_pixel, 32},
                                     {&Standing::bytes_per_pixel, 64}};
    return all;
}

std::string name(const Budget& budget) {
    return fmt::format("{} <= {}", budget.cost == &Standing::time ? "time" : "bytes per pixel", budget.most);
}

std::optional<std::size_t> best_within(std::span<const Standing> rows, const Budget& budget) {
    std::optional<std::size_t> best;
    const auto spent = [&](const Standing& row) { return row.*budget.cost + (budget.cost == &Standing::time ? row.spread : 0); };
    const auto rank = [&](const Standing& row) { return std::pair(row.compared_error(), spent(row)); };
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (rows[i].error && spent(rows[i]) <= budget.most && (!best || rank(rows[i]) < rank(rows[*best]))) best = i;
    return best;
}

}  // namespace strata
