// Options that have another name now: each is refused with the name it has.
#pragma once

#include <string_view>

namespace strata {

struct RenamedOption {
    std::string_view before, now;
};

inline constexpr RenamedOption renamed_options[] = {
    {"--methods", "--techniques"},
    {"--points", "--variants"},
    {"--repeat", "--repeats"},
};

}  // namespace strata
