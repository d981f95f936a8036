// A run against the results accepted for a capture: exact hashes first, then a tolerance where images are kept; and the first
// pass that is not as it should be. Where several results are accepted, each image may agree with another one of them.
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
    std::optional<ImageDeviation> deviation;  ///< from the nearest accepted image that is kept, where no hash is equal
    std::string expected_hash, hash;          ///< either may be empty: an image more, or one less
    std::size_t accepted = 1;                 ///< results that were accepted
};

struct ExpectationVerdict {
    Agreement agreement = Agreement::no_expectation;
    std::optional<ExpectedOn> elsewhere;  ///< whose expectation it was, where it was not this device's
    std::vector<ImageVerdict> images;     ///< pass by pass; empty without an expectation
    /// The first image that is not as expected; null when there is none.
    const ImageVerdict* first_divergence() const;
};

/// The results accepted for the device, frame and choice of `got`, newest first: the newest, and those before it up to the one
/// that replaced all before. Empty where there are none.
std::vector<const Expectation*> accepted_for(std::span<const Expectation>, const Expectation& got);

/// `got` describes `run`; the capture is the one that keeps the expectations. The results accepted for this device decide;
/// without any those of another device do when they are met exactly, or within a tolerance above zero.
Result<ExpectationVerdict> check_expectations(const Capture&, std::span<const Expectation>, const Run& run,
                                              const Expectation& got, double tolerance);
/// Every image against the nearest one of the results of accepted_for(), of which there is one or more.
Result<ExpectationVerdict> compare_with(const Capture&, std::span<const Expectation* const> accepted, const Run& run,
                                        const Expectation& got, double tolerance);

/// One sentence: which pass and image, how far, the worst texel with both values.
std::string sentence(const ImageVerdict&);

}  // namespace strata
