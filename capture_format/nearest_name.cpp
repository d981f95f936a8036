#include "capture_format/nearest_name.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace strata {
namespace {

constexpr std::size_t shortest_beginning = 3;  // letters of a name that say which one is meant

/// Levenshtein distance, one row at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

}  // namespace

std::string_view nearest_name(std::string_view typed, std::span<const std::string_view> known) {
    std::string_view best;
    // Of a word of three letters one may be wrong: 9x9 is no misspelt 2x2.
    std::size_t best_distance =
        std::min(std::max<std::size_t>(typed.size() / 3, 2), std::max<std::size_t>(typed.size() / 2, 1)) + 1;
    for (const std::string_view name : known) {
        const std::size_t lengths = std::max(name.size(), typed.size()) - std::min(name.size(), typed.size());
        if (lengths >= best_distance) continue;  // no distance is less: a word of megabytes is told by its length
        const std::size_t distance = edit_distance(typed, name);
        if (distance < best_distance) {
            best = name;
            best_distance = distance;
        }
    }
    if (!best.empty() || typed.size() < shortest_beginning) return best;
    const auto begins = std::ranges::find_if(known, [&](std::string_view name) { return name.starts_with(typed); });
    return begins == known.end() ? best : *begins;
}

std::string did_you_mean(std::string_view typed, std::span<const std::string_view> known) {
    const std::string_view best = nearest_name(typed, known);
    return best.empty() ? std::string() : "; did you mean " + std::string(best) + "?";
}

}  // namespace strata
