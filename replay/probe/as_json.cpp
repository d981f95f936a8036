// A probe as JSON: everything that is known of it.
#include <nlohmann/json.hpp>

#include "replay/probe/order.h"
#include "replay/probe/probe.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

ordered_json rgb(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

ordered_json rgb(std::span<const glm::dvec3> values) {
    ordered_json list = ordered_json::array();
    for (const glm::dvec3& v : values) list.push_back(rgb(v));
    return list;
}

ordered_json fragments_of(const Probe& probe) {
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < probe.fragments.size(); ++i) {
        const Fragment& f = probe.fragments[i];
        list.push_back({{"depth", f.depth},
                        {"submission", f.submission},
                        {"alpha", f.alpha},
                        {"t", rgb(f.transmittance)},
                        {"p", rgb(f.color)},
                        {"e", rgb(f.emission)},
                        {"T", rgb(probe.before_events[i])}});
    }
    return list;
}

ordered_json curve_json(const ProbeCurve& curve) {
    ordered_json json{{"method", curve.method}};
    if (!curve.not_supported.empty()) {
        json["not_supported"] = curve.not_supported;
        return json;
    }
    const ProbeFigures& f = curve.figures;
    json["figures"] = {{"l1_logarithmic", f.l1_logarithmic},
                       {"l1_linear", f.l1_linear},
                       {"worst_off_steps", f.worst_off_steps ? ordered_json(*f.worst_off_steps) : ordered_json()},
                       {"event_weighted", f.event_weighted},
                       {"total", f.total}};
    json["total"] = rgb(curve.total);
    json["T"] = rgb(curve.through);
    json["T_at_fragments"] = rgb(curve.at_events);
    for (const DepthSpan& slice : curve.slices) json["slices"].push_back({slice.from, slice.to});
    json["notes"] = curve.notes;
    return json;
}

}  // namespace

std::string as_json(const Probe& probe) {
    ordered_json json{{"schema", "strata.probe"},
                      {"schema_version", 1},
                      {"device", probe.device.name},
                      {"driver", probe.device.driver},
                      {"frame", probe.frame},
                      {"x", probe.at.x},
                      {"y", probe.at.y},
                      {"sample", probe.at.sample},
                      {"undecided", probe.undecided},
                      {"unit", "m"},
                      {"axis", probe.axis == DepthAxis::linear ? "linear" : "log"},
                      {"from", probe.from},
                      {"to", probe.to},
                      {"nearest", probe.nearest},
                      {"farthest", probe.farthest},
                      {"fragments", fragments_of(probe)},
                      {"depths", probe.depths},
                      {"exact", {{"T", rgb(probe.exact)}, {"total", rgb(probe.exact_total)}}}};
    json["curves"] = ordered_json::array();
    for (const ProbeCurve* curve : best_first(probe)) json["curves"].push_back(curve_json(*curve));
    // What is no number is null: JSON has no other way to say it.
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace strata
