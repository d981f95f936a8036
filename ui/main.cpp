// strata: the verbs of the command line, and the inspector's.
#include "replay/cli/tool.h"
#include "replay/standard_streams.h"

namespace strata {
std::function<Result<void>()> declare_inspect(CLI::App&);
}

int main(int count, char** arguments) {
    strata::open_standard_streams();
    std::vector<strata::Verb> verbs(strata::verbs().begin(), strata::verbs().end());
    verbs.push_back({"inspect", "open a capture in a window", strata::declare_inspect});
    return strata::run_tool({arguments + 1, arguments + count}, verbs);
}
