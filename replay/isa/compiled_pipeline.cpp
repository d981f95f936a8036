#include "replay/isa/compiled_pipeline.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Executable& executable) {
    ordered_json json{{"stage", executable.stage}, {"wave_lanes", executable.wave_lanes}};
    json["statistics"] = json["texts"] = ordered_json::array();
    for (const CompilerStatistic& s : executable.statistics) json["statistics"].push_back({s.name, s.value});
    for (const CompilerText& t : executable.texts) json["texts"].push_back({t.name, t.text});
    return json;
}

Executable executable_from(const ordered_json& json) {
    Executable executable{json.at("stage"), json.at("wave_lanes"), {}, {}};
    for (const ordered_json& s : json.at("statistics")) executable.statistics.push_back({s.at(0), s.at(1)});
    for (const ordered_json& t : json.at("texts")) executable.texts.push_back({t.at(0), t.at(1)});
    return executable;
}

}  // namespace

std::optional<double> Executable::statistic(std::initializer_list<std::string_view> names) const {
    for (const std::string_view name : names) {
        const auto found = std::ranges::find(statistics, name, &CompilerStatistic::name);
        if (found != statistics.end()) return found->value;
    }
    return {};
}

const CompilerText* Executable::code() const {
    if (texts.empty()) return nullptr;
    if (!texts.back().text.starts_with("Shader disassembly is not supported")) return &texts.back();
    const auto ir = std::ranges::find(texts, "ACO IR", &CompilerText::name);
    return ir == texts.end() ? nullptr : &*ir;
}

std::string as_json(const Compilation& compilation) {
    ordered_json json{{"device", compilation.device}, {"driver", compilation.driver}, {"pipelines", ordered_json::array()}};
    for (const CompiledPipeline& pipeline : compilation.pipelines) {
        ordered_json& row = json["pipelines"].emplace_back(ordered_json{{"failure", pipeline.failure}});
        row["executables"] = ordered_json::array();
        for (const Executable& executable : pipeline.executables) row["executables"].push_back(json_of(executable));
    }
    // A driver's text need not be UTF-8.
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

Result<Compilation> compilation_from_json(const std::string& text) {
    try {
        const ordered_json json = ordered_json::parse(text);
        Compilation compilation{json.at("device"), json.at("driver"), {}};
        for (const ordered_json& row : json.at("pipelines")) {
            CompiledPipeline& pipeline = compilation.pipelines.emplace_back();
            pipeline.failure = row.at("failure");
            for (const ordered_json& executable : row.at("executables"))
                pipeline.executables.push_back(executable_from(executable));
        }
        return compilation;
    } catch (const nlohmann::json::exception& problem) {
        return fail(Fault::bad_input, "isa.malformed_compilation", "not a list of compiled pipelines: {reason}", problem.what());
    }
}

}  // namespace strata
