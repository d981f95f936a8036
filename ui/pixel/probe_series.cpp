#include "ui/pixel/probe_series.h"

#include <algorithm>
#include <cmath>

#include "capture_format/frame/frame.h"
#include "passes/technique.h"
#include "ui/window/theme.h"

namespace strata::ui {
namespace {

/// The stack of a pixel as a probe gives it back, for further techniques: the frame is neither loaded nor rasterized again.
ProbedStack stack_of(const Probe& probe, std::uint64_t seed) {
    ProbedStack stack{probe.fragments, probe.nearest, probe.farthest, seed};
    std::ranges::sort(stack.fragments, {}, &Fragment::submission);
    return stack;
}

const ProbeCurve* curve_of(const std::optional<Probe>& probe, const std::string& variant) {
    if (!probe) return nullptr;
    const auto found = std::ranges::find(probe->curves, variant, &ProbeCurve::variant);
    return found == probe->curves.end() ? nullptr : &*found;
}

/// T after each fragment within the probed range, from its beginning on.
PlotSeries exact_steps(const Probe& probe, ProbeChannel channel) {
    PlotSeries series{.label = "exact", .kind = SeriesKind::step, .color = palette().text};
    glm::dvec3 through(1);
    for (std::size_t i = 0; i < probe.fragments.size(); ++i) {
        const Fragment& fragment = probe.fragments[i];
        if (fragment.depth < probe.from) {
            through *= fragment.transmittance;
            continue;
        }
        if (fragment.depth > probe.to) break;
        if (series.points.empty()) {
            series.points.push_back({probe.from, in_channel(through, channel)});
            series.notes.push_back("where the plot begins");
        }
        through *= fragment.transmittance;
        series.points.push_back({fragment.depth, in_channel(through, channel)});
        series.notes.push_back(fmt::format("fragment {} of {}, alpha {:.3g}", i + 1, probe.fragments.size(), fragment.alpha));
    }
    return series;
}

}  // namespace

double in_channel(const glm::dvec3& value, ProbeChannel channel) {
    if (channel == ProbeChannel::mean) return (value.x + value.y + value.z) / 3;
    return value[static_cast<int>(channel) - 1];
}

Result<Probe> probe_each(Session& session, Progress& progress, const ProbeQuestion& question, const std::optional<Probe>& known) {
    const PixelAt at{question.pixel.x, question.pixel.y, question.sample};
    std::optional<Probe> made = known;
    if (made) made->curves.clear();
    std::optional<std::uint64_t> seed;
    for (std::size_t i = 0; i < question.variants.size(); ++i) {
        const std::string& variant = question.variants[i];
        if (const ProbeCurve* curve = curve_of(known, variant)) {
            made->curves.push_back(*curve);
            continue;
        }
        const double share = static_cast<double>(i) / static_cast<double>(question.variants.size());
        if (!progress.at(share, short_variant(variant))) return fail(Fault::stopped, "session.stopped", "stopped");
        const ProbeOptions options{.variants = {variant}, .axis = question.axis};
        if (!made) {
            auto first = probe(session, question.request, at, options);
            if (!first) return first.error();
            made = *std::move(first);
            continue;
        }
        if (!seed) {
            const auto frame = session.frame(question.request.variant.frame);
            if (!frame) return frame.error();
            seed = frame->seed;
        }
        auto next = probe(session, stack_of(*made, *seed), options);
        if (!next) return next.error();
        made->curves.push_back(std::move(next->curves.front()));
    }
    if (made)
        if (const auto added = add_display_errors(session, question.request, *made); !added) return added.error();
    return *std::move(made);
}

std::vector<PlotSeries> series_of(const Probe& probe, ProbeQuantity quantity, ProbeChannel channel) {
    std::vector<PlotSeries> all;
    if (quantity == ProbeQuantity::transmittance) all.push_back(exact_steps(probe, channel));
    for (std::size_t m = 0; m < probe.curves.size(); ++m) {
        const ProbeCurve& curve = probe.curves[m];
        if (!curve.not_supported.empty()) continue;
        PlotSeries& series = all.emplace_back(PlotSeries{.label = short_variant(curve.variant), .color = color_of_variant(m)});
        for (std::size_t i = 0; i < probe.depths.size(); ++i) {
            const double exact = in_channel(probe.exact[i], channel), got = in_channel(curve.through[i], channel);
            series.points.push_back({probe.depths[i], quantity == ProbeQuantity::error ? got - exact : got});
            series.notes.push_back(fmt::format("T {:.5f}, exact {:.5f}, {:+.5f}", got, exact, got - exact));
        }
    }
    return all;
}

std::string variant_of(const Choice& choice) {
    std::string variant(choice.technique->name);
    const std::vector<std::string> now = choice.settings.lines(), defaults = Settings(choice.technique->params).lines();
    for (std::size_t i = 0; i < now.size(); ++i)
        if (now[i] != defaults[i]) variant += fmt::format(" {}", now[i]);
    return variant;
}

std::string short_variant(std::string_view variant) { return std::string(variant.substr(variant.find('/') + 1)); }

ImVec4 color_of_variant(std::size_t place) {
    // A fifth of a turn ahead of the stages' colors, whose first would be the accent again.
    ImVec4 color(0, 0, 0, 1);
    ImGui::ColorConvertHSVtoRGB(std::fmod(.08f + static_cast<float>(place) * .381966f, 1.0f), .62f, .95f, color.x, color.y,
                                color.z);
    return color;
}

}  // namespace strata::ui
