// T(z) of every technique for spreadsheets.
#include "replay/probe/probe.h"

namespace strata {

std::string curves_csv(const Probe& probe) {
    const auto header = [&](std::string_view name) {
        return probe.colored ? fmt::format(",\"{0} r\",\"{0} g\",\"{0} b\"", name) : fmt::format(",\"{}\"", name);
    };
    const auto cells = [&](const glm::dvec3& t) {
        return probe.colored ? fmt::format(",{:.7g},{:.7g},{:.7g}", t.x, t.y, t.z) : fmt::format(",{:.7g}", t.x);
    };
    std::vector<const ProbeCurve*> curves;
    for (const ProbeCurve& curve : probe.curves)
        if (curve.not_supported.empty()) curves.push_back(&curve);
    std::string text = "\"depth [m]\"" + header("exact");
    for (const ProbeCurve* curve : curves) text += header(curve->variant);
    for (std::size_t i = 0; i < probe.depths.size(); ++i) {
        text += fmt::format("\n{:.9g}", probe.depths[i]) + cells(probe.exact[i]);
        for (const ProbeCurve* curve : curves) text += cells(curve->through[i]);
    }
    return text + '\n';
}

}  // namespace strata
