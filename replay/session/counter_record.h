// What a technique counted in a run.
#pragma once

#include <cstdint>
#include <string>

namespace strata {

struct CounterRecord {
    std::string technique, name;
    std::uint64_t value = 0;
};

}  // namespace strata
