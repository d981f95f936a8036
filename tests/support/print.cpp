// PrintTo for our values: without it GoogleTest prints bytes, and names of parametrized tests change between builds.
#include "tests/support/print.h"

#include <algorithm>
#include <ostream>

namespace strata {

void PrintTo(const Technique& technique, std::ostream* out) { *out << technique.name; }

std::string as_identifier(std::string text) {
    std::ranges::replace(text, '/', '_');
    return text;
}

std::string technique_test_name(const testing::TestParamInfo<Technique>& tested) {
    return as_identifier(std::string(tested.param.name));
}

}  // namespace strata
