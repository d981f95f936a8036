#include "capture_format/import/stb_problem.h"

#include <cerrno>
#include <new>

#include <stb_image.h>

namespace strata {
namespace {

/// Reason that stb gives for no bytes, and never for a file whose first bytes are those of a PNG or JPEG.
constexpr std::string_view said_of_nothing = "unknown image type";

}  // namespace

void forget_stb_problem() {
    constexpr stbi_uc nothing = 0;
    int width = 0, height = 0, channels = 0;
    (void)stbi_info_from_memory(&nothing, 0, &width, &height, &channels);
}

bool stb_gave_a_reason() {
    const char* const reason = stbi_failure_reason();
    return reason && reason != said_of_nothing;
}

std::string_view stb_problem(std::string_view otherwise) {
    const char* const reason = stbi_failure_reason();
    const std::string_view problem = reason ? reason : "";
    if (problem == "outofmem" || (problem == "can't fopen" && errno == ENOMEM)) throw std::bad_alloc();
    return problem.empty() ? otherwise : problem;
}

}  // namespace strata
