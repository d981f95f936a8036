// strata graph: the compiled plan of a frame, without running it.
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "passes/graph/describe.h"
#include "passes/stages.h"
#include "replay/cli/left_out.h"
#include "replay/cli/verb_options.h"
#include "replay/json_text.h"
#include "replay/session/eye_move.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct GraphArguments {
    OpenOptions open;
    ChoiceOptions choices;
    std::size_t frame = 0;
    std::string eye;
    bool dot = false, json = false;
};

ordered_json json_of(const Session::PlannedFrame& planned, std::size_t frame) {
    const Plan& plan = planned.plan;
    ordered_json json{{"schema", "strata.graph"}, {"schema_version", 1}, {"frame", frame}};
    json["image_bytes"] = plan.image_bytes;
    json["buffer_bytes"] = plan.buffer_bytes;
    json["steps"] = json["memory"] = json["culled"] = json["left_out"] = ordered_json::array();
    for (const PlannedStep& step : plan.steps) {
        ordered_json row{{"index", json["steps"].size()},
                         {"scope", text_of(plan.scopes[step.step.scope])},
                         {"name", step.step.name},
                         {"barriers", ordered_json::array()}};
        for (const Barrier& barrier : step.barriers) row["barriers"].push_back(describe(plan, barrier));
        json["steps"].push_back(std::move(row));
    }
    for (const MemorySlot& slot : plan.slots) {
        ordered_json row{{"bytes", slot.bytes}, {"images", ordered_json::array()}};
        for (const std::uint32_t image : slot.images) row["images"].push_back(plan.images[image].name);
        json["memory"].push_back(std::move(row));
    }
    for (const CulledStep& step : plan.culled)
        json["culled"].push_back({{"scope", text_of(step.scope)}, {"name", step.name}, {"reason", step.reason}});
    for (const SkippedStage& skipped : planned.skipped)
        json["left_out"].push_back({{"stage", name(skipped.stage)}, {"reason", skipped.reason}});
    return json;
}

Result<void> graph(const GraphArguments& options) {
    auto session = open(options.open);
    if (!session) return session.error();
    auto request = request_of(options.choices);
    if (!request) return request.error();
    request->variant.frame = options.frame;
    const auto eye = eye_move_of(options.eye);
    if (!eye) return eye.error();
    request->variant.eye = *eye;
    if (const auto told = LeftOutNotes().tell(**session, *request); !told) return told;
    const auto planned = (*session)->plan(*request);
    if (!planned) return planned.error();
    if (options.json) {
        write_stdout(json_text(json_of(*planned, options.frame)));
        return {};
    }
    if (options.dot) {
        to_stdout("{}", describe_dot(planned->plan));
        return {};
    }
    to_stdout("{}", describe(planned->plan));
    for (const SkippedStage& skipped : planned->skipped) to_stdout("left out: {}: {}\n", name(skipped.stage), skipped.reason);
    return {};
}

}  // namespace

std::function<Result<void>()> declare_graph(CLI::App& app) {
    const auto options = std::make_shared<GraphArguments>();
    add_options(app, options->open);
    add_options(app, options->choices);
    app.add_option("--frame", options->frame, "index of the frame, default 0");
    add_eye(app, options->eye);
    CLI::Option* dot = app.add_flag("--dot", options->dot, "print Graphviz instead of text");
    app.add_flag("--json", options->json, "print JSON instead of text")->excludes(dot);
    return [options] { return graph(*options); };
}

}  // namespace strata
