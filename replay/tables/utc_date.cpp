#include <chrono>

#include <fmt/chrono.h>

#include "replay/tables/document.h"

namespace strata {

std::string utc_date(std::int64_t seconds) {
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(seconds)));
}

}  // namespace strata
