// strata report --needs: what frames make and how much of it is read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "replay/cli/table_output.h"
#include "replay/cli/verb_options.h"

namespace strata {

struct NeedsArguments {
    std::span<const std::filesystem::path> captures;
    OpenOptions open;
    ChoiceOptions choices;
    std::string frames, eye;
    std::size_t repeats = 3;
    TableOutput output;
};
Result<void> report_needs(const NeedsArguments&);

}  // namespace strata
