// A run against what its capture expects: exact hashes first, then a tolerance where images are kept; and the first pass that
// is not as it should be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "replay/expectations/expectation.h"

namespace strata {

/// How an image differs from the expected one. Errors are relative to the root mean square of the expected image's channels.
struct ImageDeviation {
    double rmse = 0;  ///< relative; infinite where only one of the two is a number
    std::size_t texels = 0, differing = 0;
    WorstTexel worst;  ///< wanted: what was expected
};
ImageDeviation deviation_of(const std::string& name, const HostImage& got, const HostImage& expected);

enum class Agreement { exact, within_tolerance, diverges, no_expectation };

struct ImageVerdict {
    std::string pass, image;
    Agreement agreement = Agreement::exact;
    std::optional<ImageDeviation> deviation;  ///< where the expected image is kept and the hashes differ
    std::string expected_hash, hash;          ///< either may be empty: an image more, or one less
};

struct ExpectationVerdict {
    Agreement agreement = Agreement::no_expectation;
    std::optional<ExpectedOn> elsewhere;  ///< whose expectation it was, where it was not this device's
    std::vector<ImageVerdict> images;     ///< pass by pass; empty without an expectation
    /// The first image that is not as expected; null when there is none.
    const ImageVerdict* first_divergence() const;
};

/// The newest expectation for this device, or null.
const Expectation* newest_for(std::span<const Expectation>, const Expectation& got);

/// `got` describes `run`. This device's expectation decides; without one another device's does when it is met exactly, or within
/// a tolerance above zero.
Result<ExpectationVerdict> check_expectations(const Capture&, std::span<const Expectation>, const Run& run,
                                              const Expectation& got, double tolerance);
/// Every image against one expectation.
Result<ExpectationVerdict> compare_with(const Capture&, const Expectation& expected, const Run& run, const Expectation& got,
                                        double tolerance);

/// One sentence: which pass and image, how far, the worst texel with both values.
std::string sentence(const ImageVerdict&);

}  // namespace strata
