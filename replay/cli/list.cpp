// strata list: stages with their techniques and parameters, scenarios, features.
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "capture_format/nearest_name.h"
#include "captures/scenarios.h"
#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/cli/verb_options.h"
#include "replay/json_text.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

struct ListArguments {
    std::string what;
    bool names = false, scenarios = false, images = false, views = false, json = false;
};

std::string range_text(const Param& param) {
    if (param.choices.empty()) return fmt::format("{:g} to {:g}, default {:g}", param.low, param.high, param.fallback);
    std::string text;
    for (const std::string_view choice : param.choices) text += fmt::format("{}{}", text.empty() ? "" : ", ", choice);
    return fmt::format("{}; default {}", text, param.choices[static_cast<std::size_t>(param.fallback)]);
}

std::string_view model_text(ModelKind kind) {
    if (kind == ModelKind::paper) return "written from the paper";
    return "mirrors bit patterns of the shader; the property tests beside it are named in its README";
}

/// " (wboit)", or nothing.
std::string in_brackets(std::span<const std::string_view> aliases) {
    return aliases.empty() ? std::string() : fmt::format(" ({})", fmt::join(aliases, ", "));
}

void print(const Technique& technique, const ListArguments& options) {
    if (options.names) {
        to_stdout("{}\n", technique.name);
        return;
    }
    to_stdout("  {:<32}{}{}. {}\n", technique.name, technique.title, in_brackets(technique.aliases), technique.source);
    if (options.what.empty()) return;
    to_stdout("  {:<32}{}\n", "", technique.summary);
    to_stdout("      model: {}\n", model_text(technique.model_is));
    for (const Param& param : technique.params) {
        if (!param.group.empty()) to_stdout("    {}:\n", param.group);
        to_stdout("      --set {:<18} {} ({})\n", param.name, param.help, range_text(param));
    }
    for (const std::string_view point : technique.variants) to_stdout("      reported also at {}\n", point);
    for (const Counter& counter : technique.counters) to_stdout("      counter {:<16} {}\n", counter.name, counter.help);
    for (const DebugView& view : technique.views) to_stdout("      view {}:{:<12} {}\n", technique.name, view.name, view.help);
    for (const DebugTable& table : technique.tables)
        to_stdout("      table {}:{:<11} {}\n", technique.name, table.name, table.help);
    for (const Feature feature : technique.cannot) to_stdout("      cannot do {}\n", name(feature));
}

ordered_json json_of(const Technique& technique) {
    ordered_json json{{"name", technique.name},
                      {"aliases", technique.aliases},
                      {"stage", name(technique.stage)},
                      {"title", technique.title},
                      {"source", technique.source},
                      {"summary", technique.summary},
                      {"model_is", name(technique.model_is)},
                      {"parameters", ordered_json::array()}};
    std::string_view group;
    for (const Param& param : technique.params) {
        if (!param.group.empty()) group = param.group;
        json["parameters"].push_back({{"name", param.name},
                                      {"group", group},
                                      {"low", param.low},
                                      {"high", param.high},
                                      {"default", param.fallback},
                                      {"choices", param.choices},
                                      {"help", param.help}});
    }
    json["variants"] = technique.variants;
    json["also_at"] = ordered_json::array();
    for (const StageWork& other : technique.at_other_stages) json["also_at"].push_back(name(other.at));
    for (const Counter& counter : technique.counters)
        json["counters"].push_back({{"name", counter.name}, {"help", counter.help}});
    return json;
}

ordered_json json_of(const Scenario& scenario) {
    ordered_json json{{"name", scenario.name}, {"question", scenario.question}, {"witnesses", ordered_json::array()}};
    for (const Witness& witness : scenario.witnesses)
        json["witnesses"].push_back({{"stage", witness.stage},
                                     {"setting", witness.setting},
                                     {"counted", witness.counted},
                                     {"more_than", witness.more_than},
                                     {"samples", witness.samples}});
    return json;
}

/// "transparency packing=rgb10: overflowed > 10", "feature fog".
std::string text_of(const Witness& witness) {
    if (witness.stage.empty()) return fmt::format("feature {}", witness.counted);
    return fmt::format("{}{}{}: {} > {:g}{}", witness.stage, witness.setting.empty() ? "" : " ", witness.setting, witness.counted,
                       witness.more_than, witness.samples == 1 ? "" : fmt::format(" at {} samples", witness.samples));
}

Result<void> list_scenarios(const ListArguments& options) {
    if (options.json) {
        ordered_json json{{"schema", "strata.scenarios"}, {"schema_version", 1}, {"scenarios", ordered_json::array()}};
        for (const Scenario& scenario : scenarios()) json["scenarios"].push_back(json_of(scenario));
        write_stdout(json_text(json));
        return {};
    }
    std::size_t width = 0;
    for (const Scenario& scenario : scenarios()) width = std::max(width, scenario.name.size());
    for (const Scenario& scenario : scenarios()) {
        if (options.names) {
            to_stdout("{}\n", scenario.name);
            continue;
        }
        to_stdout("  {:<{}}  {}\n", scenario.name, width, scenario.question);
        for (const Witness& witness : scenario.witnesses) to_stdout("  {:<{}}    witness {}\n", "", width, text_of(witness));
    }
    return {};
}

/// What --outputs takes.
struct Output {
    std::string name;
    std::string_view stage, help;
};

std::vector<Output> images_of_frames() {
    std::vector<Output> images;
    for (const FrameImageRow& row : frame_images())
        for (const StageInfo& stage : stages())
            if (std::ranges::count(stage.outputs, row.name) > 0) {
                images.push_back({std::string(row.name), stage.name, row.help});
                break;  // the first stage that writes it
            }
    return images;
}

std::vector<Output> views_of_techniques() {
    std::vector<Output> views;
    for (const Technique& technique : techniques()) {
        const auto add = [&](const auto& each) {
            views.push_back({fmt::format("{}:{}", technique.name, each.name), name(technique.stage), each.help});
        };
        std::ranges::for_each(technique.views, add);
        std::ranges::for_each(technique.tables, add);
    }
    return views;
}

Result<void> list_outputs(const ListArguments& options, const char* schema, const char* key, const std::vector<Output>& outputs) {
    if (options.json) {
        ordered_json json{{"schema", schema}, {"schema_version", 1}, {key, ordered_json::array()}};
        for (const Output& output : outputs)
            json[key].push_back({{"name", output.name}, {"stage", output.stage}, {"help", output.help}});
        write_stdout(json_text(json));
        return {};
    }
    std::size_t width = 0;
    for (const Output& output : outputs) width = std::max(width, output.name.size());
    for (const Output& output : outputs)
        if (options.names) to_stdout("{}\n", output.name);
        else to_stdout("  {:<{}}  {}\n", output.name, width, output.help);
    return {};
}

/// A stage without techniques of its own, by those of other stages that do its work.
void print_served(const StageInfo& stage) {
    to_stdout("{}{}: {}\n", stage.name, in_brackets(stage.aliases), stage.purpose);
    for (const Technique& technique : techniques())
        if (std::ranges::count(technique.at_other_stages, stage.stage, &StageWork::at) > 0)
            to_stdout("  {:<32}{}. A technique of stage {} that also has steps at this stage\n", technique.name, technique.title,
                      name(technique.stage));
}

Result<void> list(const ListArguments& options) {
    if (options.scenarios) return list_scenarios(options);
    if (options.images) return list_outputs(options, "strata.images", "images", images_of_frames());
    if (options.views) return list_outputs(options, "strata.views", "views", views_of_techniques());
    const auto called = techniques_called(options.what);
    const auto stage_called = find_stage(options.what);
    bool found = options.what.empty();
    ordered_json json{{"schema", "strata.list"}, {"schema_version", 2}, {"techniques", ordered_json::array()}};
    for (const StageInfo& stage : stages()) {
        const bool whole_stage = options.what.empty() || stage_called == stage.stage;
        bool headed = false;
        for (const Technique* technique : techniques_of(stage.stage)) {
            if (!whole_stage && std::ranges::count(called, technique) == 0) continue;
            found = true;
            json["techniques"].push_back(json_of(*technique));
            if (options.json) continue;
            if (!headed && !options.names) to_stdout("{}{}: {}\n", stage.name, in_brackets(stage.aliases), stage.purpose);
            headed = true;
            print(*technique, options);
        }
        if (whole_stage && !options.what.empty()) found = true;
        if (whole_stage && techniques_of(stage.stage).empty() && !options.json && !options.names) print_served(stage);
    }
    if (!found) {
        std::vector<std::string_view> known;
        for (const StageInfo& stage : stages()) {
            known.push_back(stage.name);
            known.insert(known.end(), stage.aliases.begin(), stage.aliases.end());
        }
        const auto words = words_for_techniques();
        known.insert(known.end(), words.begin(), words.end());
        return fail(Fault::usage, "list.unknown", "there is no stage and no technique '{name}'{suggestion}", options.what,
                    did_you_mean(options.what, known));
    }
    if (options.json) write_stdout(json_text(json));
    return {};
}

}  // namespace

std::function<Result<void>()> declare_list(CLI::App& app) {
    const auto options = std::make_shared<ListArguments>();
    CLI::Option* what =
        app.add_option("what,--stage", options->what, "stage or technique to list with parameters, counters and views");
    CLI::Option* scenarios = app.add_flag("--scenarios", options->scenarios,
                                          "list the scenarios of strata record, with what their frames must contain (witnesses)")
                                 ->excludes(what);
    CLI::Option* images = app.add_flag("--images", options->images, "list the images of a frame, for --outputs")
                              ->excludes(what)
                              ->excludes(scenarios);
    app.add_flag("--views", options->views, "list the views and tables of every technique, for --outputs")
        ->excludes(what)
        ->excludes(scenarios)
        ->excludes(images);
    CLI::Option* names = app.add_flag("--names", options->names, "print only names, one per line");
    app.add_flag("--json", options->json, "print JSON instead of text")->excludes(names);
    return [options] { return list(*options); };
}

}  // namespace strata
