// strata graph: the compiled plan of a frame, without running it.
#include <memory>

#include <CLI/CLI.hpp>

#include "passes/graph/describe.h"
#include "replay/cli/verb_options.h"

namespace strata {
namespace {

struct GraphArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::size_t frame = 0;
    bool dot = false;
};

Result<void> graph(const GraphArguments& options) {
    auto session = open(options.open);
    if (!session) return session.error();
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    const auto planned = (*session)->plan(*request);
    if (!planned) return planned.error();
    if (options.dot) {
        fmt::print("{}", describe_dot(planned->plan));
        return {};
    }
    fmt::print("{}", describe(planned->plan));
    for (const SkippedStage& skipped : planned->skipped) fmt::print("left out: {}: {}\n", name(skipped.stage), skipped.reason);
    return {};
}

}  // namespace

std::function<Result<void>()> declare_graph(CLI::App& app) {
    const auto options = std::make_shared<GraphArguments>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--frame", options->frame, "which frame, default 0");
    app.add_flag("--dot", options->dot, "Graphviz instead of text");
    return [options] { return graph(*options); };
}

}  // namespace strata
