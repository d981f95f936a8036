// Another program run to its end, with what it says kept apart from ours.
#pragma once

#include <string>
#include <vector>

#include "capture_format/result.h"

namespace strata {

struct ProcessRequest {
    std::vector<std::string> arguments;    ///< the program first: a path, or a name to find along PATH
    std::vector<std::string> environment;  ///< "NAME=value"
    std::string input = {};
};

/// How it ended, as waitpid() tells, and what it wrote.
struct EndedProcess {
    int status = 0;
    std::string out, err;
};

/// Fails (device failed) when it cannot be started.
Result<EndedProcess> run_process(ProcessRequest);

}  // namespace strata
