#include "replay/probe/probe_columns.h"

#include <array>

#include <nlohmann/json.hpp>

#include "replay/json_text.h"
#include "replay/plural.h"
#include "replay/probe/order.h"
#include "replay/tables/document.h"

namespace strata {
namespace {

using nlohmann::ordered_json;

// Of a longer list the middle is left out: JSON has it.
constexpr std::size_t listed = 40;

/// A fragment by its index, nearest first.
struct ListedFragment {
    const Probe& probe;
    std::size_t index = 0;
    const Fragment& fragment() const { return probe.fragments[index]; }
};
using FragmentColumns = std::vector<Column<ListedFragment>>;
using Rgb3 = glm::dvec3 (*)(const ListedFragment&);

std::string rgb_text(const glm::dvec3& v) { return fmt::format("{:.3f} {:.3f} {:.3f}", v.x, v.y, v.z); }

ordered_json rgb(const glm::dvec3& v) { return {cell_json(v.x), cell_json(v.y), cell_json(v.z)}; }

ordered_json rgb(std::span<const glm::dvec3> values) {
    ordered_json list = ordered_json::array();
    for (const glm::dvec3& v : values) list.push_back(rgb(v));
    return list;
}

/// Three numbers: one column of text, three of CSV; an array in JSON.
struct Color {
    std::string key, title, help;
};
void add_colors(FragmentColumns& columns, const Color& color, Rgb3 value) {
    constexpr std::array channels = {"red", "green", "blue"};
    columns.push_back(
        {{.key = color.key, .title = color.title, .help = color.help, .kind = CellKind::text, .shown = in_text, .width = 17},
         [value](const ListedFragment& row) { return rgb_text(value(row)); }});
    for (const int channel : {0, 1, 2}) {
        const std::string name = channels[static_cast<std::size_t>(channel)];
        columns.push_back({{.key = fmt::format("{}_{}", color.key, name.front()),
                            .title = color.title,
                            .help = fmt::format("{}, {}", color.help, name),
                            .shown = in_csv},
                           [=](const ListedFragment& row) { return value(row)[channel]; }});
    }
}

FragmentColumns fragment_columns() {
    FragmentColumns columns{
        {{.key = "number",
          .title = "#",
          .help = "from the nearest on",
          .kind = CellKind::count,
          .shown = in_text | in_csv,
          .width = 4},
         [](const ListedFragment& row) { return std::uint64_t{row.index + 1}; }},
        {{.key = "depth", .title = "depth [m]", .help = "view depth in meters", .digits = ".5g", .width = 10},
         [](const ListedFragment& row) { return row.fragment().depth; }},
        {{.key = "submission", .title = "submit", .help = "order of submission", .kind = CellKind::count, .width = 7},
         [](const ListedFragment& row) { return std::uint64_t{row.fragment().submission}; }},
        {{.key = "alpha", .title = "alpha", .help = "coverage", .digits = ".4f", .width = 7},
         [](const ListedFragment& row) { return row.fragment().alpha; }}};
    add_colors(columns, {"t", "t", "transmittance of the fragment"},
               [](const ListedFragment& row) { return row.fragment().transmittance; });
    add_colors(columns, {"p", "p", "premultiplied color"}, [](const ListedFragment& row) { return row.fragment().color; });
    add_colors(columns, {"e", "e", "emission"}, [](const ListedFragment& row) { return row.fragment().emission; });
    add_colors(columns, {"T", "T in front", "exact transmittance in front of it"},
               [](const ListedFragment& row) { return row.probe.before_fragments[row.index]; });
    return columns;
}

using Curve = const ProbeCurve*;

Column<Curve> metric_column(Described is, std::function<CellValue(const ProbeMetrics&)> value) {
    is.better = Better::less;
    if (is.digits.empty()) is.digits = ".5f";
    is.json = "/figures/" + is.key;
    is.width = 9;
    return {std::move(is), [value = std::move(value)](const Curve& curve) { return value(curve->metrics); }};
}

std::vector<Column<Curve>> variant_columns() {
    using Of = Column<Curve>::Of;
    using Metrics = const ProbeMetrics&;
    return {
        {{.key = "variant",
          .title = "variant",
          .help = "the technique and its settings",
          .kind = CellKind::text,
          .shown = in_text | in_files},
         [](const Curve& curve) { return curve->variant; },
         Of::every_row},
        {{.key = "not_supported",
          .title = "not supported",
          .help = "why the technique cannot do these fragments",
          .kind = CellKind::text,
          .shown = in_files},
         [](const Curve& curve) { return cell_if_any(curve->not_supported); },
         Of::every_row},
        metric_column(
            {.key = "display_error",
             .title = "display %",
             .help = "display error of the pixel in the recorded frame: root mean square over its color channels, share of white",
             .kind = CellKind::share,
             .digits = ".3g"},
            [](Metrics metrics) { return cell_or_unknown(metrics.display_error); }),
        metric_column({.key = "l1_logarithmic",
                       .title = "L1 log z",
                       .help = "mean |T - exact| over the probed range, on a logarithmic axis",
                       .short_title = "L1 ln z"},
                      [](Metrics metrics) { return metrics.l1_logarithmic; }),
        metric_column({.key = "l1_linear", .title = "L1 z", .help = "the same on a linear axis"},
                      [](Metrics metrics) { return metrics.l1_linear; }),
        metric_column({.key = "worst_off_steps",
                       .title = "Linf off",
                       .help = "largest error, at least 1% of the axis away from every step",
                       .short_title = "off steps"},
                      [](Metrics metrics) { return cell_or_unknown(metrics.worst_off_steps); }),
        metric_column({.key = "fragment_weighted",
                       .title = "E_w",
                       .help = "mean error over the fragments, weighted by what each hides",
                       .short_title = "at fragments"},
                      [](Metrics metrics) { return metrics.fragment_weighted; }),
        metric_column({.key = "total",
                       .title = "total",
                       .help = "T - exact behind all fragments",
                       .digits = "+.5f",
                       .short_title = "behind"},
                      [](Metrics metrics) { return metrics.total; })};
}

/// The middle of a long list is left out.
Sheet listed_fragments(const Probe& probe) {
    Sheet sheet = fragments_of(probe);
    const std::size_t count = sheet.rows.size();
    if (count <= listed) return sheet;
    const auto middle = sheet.rows.begin() + listed / 2;
    sheet.rows.erase(middle, sheet.rows.end() - listed / 2);
    sheet.rows.insert(sheet.rows.begin() + listed / 2,
                      {{.marks = "", .label = "", .instead = fmt::format("... {} more", count - listed)},
                       std::vector<CellValue>(sheet.columns.size())});
    return sheet;
}

ordered_json fragments_json(const Probe& probe) {
    ordered_json list = rows_json(fragments_of(probe));
    for (std::size_t i = 0; i < probe.fragments.size(); ++i) {
        const Fragment& f = probe.fragments[i];
        list[i].update(
            {{"t", rgb(f.transmittance)}, {"p", rgb(f.color)}, {"e", rgb(f.emission)}, {"T", rgb(probe.before_fragments[i])}});
    }
    return list;
}

ordered_json curves_json(const Probe& probe) {
    const std::vector<Curve> curves = best_first(probe);
    ordered_json list = rows_json(variants_of(curves));
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const ProbeCurve& curve = *curves[i];
        if (!curve.not_supported.empty()) continue;
        ordered_json& json = list[i];
        json["total"] = rgb(curve.total);
        json["T"] = rgb(curve.through);
        json["T_at_fragments"] = rgb(curve.at_fragments);
        for (const DepthSpan& slice : curve.slices) json["slices"].push_back({slice.from, slice.to});
        json["notes"] = curve.notes;
    }
    return list;
}

}  // namespace

Sheet fragments_of(const Probe& probe) {
    std::vector<ListedFragment> rows;
    for (std::size_t i = 0; i < probe.fragments.size(); ++i) rows.push_back({probe, i});
    return sheet_of<ListedFragment>(fragment_columns(), rows, [](const ListedFragment&) { return RowName(); });
}

Sheet variants_of(std::span<const ProbeCurve* const> curves) {
    return sheet_of<Curve>(variant_columns(), curves, [](const Curve& curve) {
        return RowName{"", curve->variant, curve->not_supported.empty() ? "" : "not supported: " + curve->not_supported};
    });
}

Page page_of(const Probe& probe) {
    std::string text = fmt::format("{}: {}, exact T behind them {}\n", place_of(probe),
                                   plural(probe.fragments.size(), "fragment"), rgb_text(probe.exact_total));
    if (probe.undecided) text += "rounding decides which fragments exist here: the device may see others\n";
    Page page{text + '\n', Lines{listed_fragments(probe)}};
    page.emplace_back(fmt::format(
        "\nT(z) at {} depths from {:.5g} to {:.5g} m (the frame's transparent geometry: {:.5g} to {:.5g} m) on {}\n\n",
        probe.depths.size(), probe.from, probe.to, probe.nearest, probe.farthest, probe.device.name));
    page.emplace_back(Lines{variants_of(best_first(probe))});
    text =
        "\ndisplay %: distance of the recorded frame's pixel from the exact one as a display shows both. The other figures "
        "measure "
        "the\nfragments alone.\n"
        "L1: mean |T - exact| over the probed range, on a logarithmic and a linear axis. Linf off: largest error, at least 1% "
        "of\n"
        "the axis away from every step. E_w: mean error over the fragments, weighted by what each hides. total: T - exact "
        "behind\n"
        "all fragments. T of a technique is the share of a probe's light that arrives. Along the ray, probes are submitted "
        "last,\n"
        "which a technique that keeps the first fragments treats as too late; at fragments, each probe is submitted with its "
        "fragment.\n"
        "Every fragment is drawn as a card of its own.\n";
    for (const ProbeCurve& curve : probe.curves)
        for (const std::string& note : curve.notes) text += fmt::format("{}: {}\n", curve.variant, note);
    page.emplace_back(text);
    return page;
}

std::string as_text(const Probe& probe) { return as_text(page_of(probe)); }

std::string as_csv(const Probe& probe) {
    std::vector<Sheet> sheets{fragments_of(probe), variants_of(best_first(probe))};
    sheets[0].of_every_row = {{"table", "fragments"}};
    sheets[1].of_every_row = {{"table", "techniques"}};
    return as_csv(sheets);
}

std::string as_json(const Probe& probe) {
    ordered_json json = document({.schema = "strata.probe",
                                  .date = probe.date,
                                  .device = &probe.device,
                                  .capture_id = probe.capture_id,
                                  .capture_name = probe.capture_name});
    json.update({{"device", probe.device.name},
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
                 {"fragments", fragments_json(probe)},
                 {"depths", probe.depths},
                 {"exact", {{"T", rgb(probe.exact)}, {"total", rgb(probe.exact_total)}}},
                 {"curves", curves_json(probe)}});
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace strata
