// The keys of an expectation's passes in JSON. Captures keep the expectations that programs before schema version 2 stored, so
// this is the one reader that knows the words of version 1.
#pragma once

namespace strata {

inline constexpr int expectation_version = 2;

struct ExpectationKeys {
    const char *passes, *pass;
};

constexpr ExpectationKeys expectation_keys(int version) {
    return version == 1 ? ExpectationKeys{"acts", "act"} : ExpectationKeys{"passes", "pass"};
}

}  // namespace strata
