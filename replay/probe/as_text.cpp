// A probe for a terminal and for spreadsheets.
#include <cmath>

#include "replay/plural.h"
#include "replay/probe/order.h"
#include "replay/probe/probe.h"

namespace strata {
namespace {

// Of a longer list the middle is left out: JSON has it.
constexpr std::size_t listed = 40;

std::string rgb_text(const glm::dvec3& v) { return fmt::format("{:.3f} {:.3f} {:.3f}", v.x, v.y, v.z); }

std::string fragment_lines(const Probe& probe) {
    std::string text = fmt::format("  {:>4}  {:>10}  {:>7}  {:>7}  {:<17}  {:<17}  {:<17}  {:<17}\n", "#", "depth [m]", "submit",
                                   "alpha", "t", "p", "e", "T in front");
    const std::size_t count = probe.fragments.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (count > listed && i == listed / 2) {
            text += fmt::format("  ... {} more\n", count - listed);
            i = count - listed / 2;
        }
        const Fragment& f = probe.fragments[i];
        text += fmt::format("  {:>4}  {:>10.5g}  {:>7}  {:>7.4f}  {}  {}  {}  {}\n", i + 1, f.depth, f.submission, f.alpha,
                            rgb_text(f.transmittance), rgb_text(f.color), rgb_text(f.emission), rgb_text(probe.before_events[i]));
    }
    return text;
}

std::string figure_lines(const Probe& probe) {
    std::size_t width = 6;
    for (const ProbeCurve& curve : probe.curves) width = std::max(width, curve.method.size());
    std::string text = fmt::format("  {:<{}}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}\n", "method", width, "L1 log z", "L1 z",
                                   "Linf off", "E_w", "total");
    for (const ProbeCurve* curve : best_first(probe)) {
        const ProbeFigures& f = curve->figures;
        text += fmt::format("  {:<{}}", curve->method, width);
        if (!curve->not_supported.empty()) {
            text += fmt::format("  not supported: {}\n", curve->not_supported);
            continue;
        }
        const double total = std::abs(f.total) < 5e-6 ? 0 : f.total;  // no -0.00000
        const std::string off = f.worst_off_steps ? fmt::format("{:.5f}", *f.worst_off_steps) : "-";
        text += fmt::format("  {:>9.5f}  {:>9.5f}  {:>9}  {:>9.5f}  {:>+9.5f}\n", f.l1_logarithmic, f.l1_linear, off,
                            f.event_weighted, total);
    }
    return text;
}

}  // namespace

std::string as_text(const Probe& probe) {
    std::string text = fmt::format("{}: {}, exact T behind them {}\n", place_of(probe),
                                   plural(probe.fragments.size(), "fragment"), rgb_text(probe.exact_total));
    if (probe.undecided) text += "rounding decides which fragments exist here: the device may see others\n";
    text += '\n' + fragment_lines(probe);
    text += fmt::format(
        "\nT(z) at {} depths from {:.5g} to {:.5g} m (the frame's transparent geometry: {:.5g} to {:.5g} m) on {}\n\n",
        probe.depths.size(), probe.from, probe.to, probe.nearest, probe.farthest, probe.device.name);
    text += figure_lines(probe);
    text +=
        "\nL1: mean |T - exact| over the probed range, on a logarithmic and a linear axis. Linf off: largest error, at least 1% "
        "of\n"
        "the axis away from every step. E_w: mean error over the fragments, weighted by what each hides. total: T - exact "
        "behind\n"
        "all fragments. T of a method is the share of a probe's light that arrives. Along the ray, probes are submitted last,\n"
        "which a method that keeps the first fragments treats as too late; at fragments, each probe is submitted with its "
        "fragment.\n"
        "Every fragment is drawn as a card of its own.\n";
    for (const ProbeCurve& curve : probe.curves)
        for (const std::string& note : curve.notes) text += fmt::format("{}: {}\n", curve.method, note);
    return text;
}

std::string as_csv(const Probe& probe) {
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
    for (const ProbeCurve* curve : curves) text += header(curve->method);
    for (std::size_t i = 0; i < probe.depths.size(); ++i) {
        text += fmt::format("\n{:.9g}", probe.depths[i]) + cells(probe.exact[i]);
        for (const ProbeCurve* curve : curves) text += cells(curve->through[i]);
    }
    return text + '\n';
}

}  // namespace strata
