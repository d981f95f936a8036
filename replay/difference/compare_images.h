// One image of A against the same image of B: the measures that fit what it holds, and whether that is allowed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "replay/measure/flip.h"
#include "replay/measure/image_error.h"

namespace strata {

struct DebugView;

/// From good to bad.
enum class Verdict {
    same,          ///< bit for bit
    not_compared,  ///< the two are not the same thing: the reason says why
    within,        ///< different, and allowed
    warning,       ///< allowed, but over the limits of a warning
    over,          ///< not allowed
};
std::string_view name(Verdict);

/// A measure that a limit is on, as CI systems want it.
struct Judged {
    std::string metric;  ///< "pixels over 0.01", "worst", "flip mean", ...
    double value = 0, threshold = 0;
};

struct ImageComparison {
    std::string image;
    Verdict verdict = Verdict::same;
    std::string reason;          ///< why it is not `same`, in words
    std::vector<Judged> judged;  ///< the limits in force; the first is the one that decided
    ImageError error;
    std::optional<Flip> flip;  ///< of light only
};

/// What a debug view shows: radiance where its unit is one of light per solid angle, else numbers.
Content content_of(const DebugView&);

/// The measures and the verdict. Fails when the two cannot be compared.
Result<ImageComparison> compare_images(const std::string& name, const HostImage& a, const HostImage& b, const ErrorLimits&);

}  // namespace strata
