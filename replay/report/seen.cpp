#include "replay/report/seen.h"

#include <algorithm>

namespace strata {

std::span<const SeenClass> seen_classes() {
    static constexpr SeenClass all[] = {
        {0, "not seen"}, {.005, "seen only when switching"}, {.01, "seen when looked for"}, {.02, "visible"}, {.05, "obvious"},
        {.10, "wrong"}};
    return all;
}

const SeenClass& seen_as(double error) {
    const auto all = seen_classes();
    const auto above = std::ranges::find_if(all, [&](const SeenClass& one) { return one.from > error; });
    return *std::prev(std::max(above, all.begin() + 1));
}

}  // namespace strata
