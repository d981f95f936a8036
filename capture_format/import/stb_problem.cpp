#include "capture_format/import/stb_problem.h"

#include <new>

#include <stb_image.h>

namespace strata {

std::string_view stb_problem(std::string_view otherwise) {
    const char* const reason = stbi_failure_reason();
    const std::string_view problem = reason ? reason : "";
    if (problem == "outofmem") throw std::bad_alloc();
    return problem.empty() ? otherwise : problem;
}

}  // namespace strata
