// A probe as a plot: T(z), what techniques get wrong of it, and the fragments, above one axis of depth.
#include <algorithm>
#include <array>
#include <cmath>

#include "passes/luminance.h"
#include "passes/transparency/sample_blend.h"
#include "replay/images/image_io.h"
#include "replay/plural.h"
#include "replay/probe/order.h"
#include "replay/probe/probe.h"
#include "replay/probe/svg.h"
#include "replay/tables/table.h"

namespace strata {
namespace {

using svg::Anchor, svg::Box, svg::Drawing, svg::Pen;

constexpr double legend_line = 32;
constexpr Box through_box{70, 64, 800, 340}, error_box{70, 428, 800, 150}, fragment_box{70, 602, 800, 84};

// Okabe and Ito's colors but black and yellow: told apart by color-blind eyes, on white and on black.
constexpr std::string_view colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8c6bb1", "#a0522d"};
constexpr std::string_view dashes[] = {"", "7 3", "2 2", "9 3 2 3"};

Pen pen_of(std::size_t curve) {
    return {colors[curve % std::size(colors)], "curve", 1.6, dashes[curve / std::size(colors) % std::size(dashes)]};
}

class Plot {
public:
    explicit Plot(const Probe& probe)
        : probe_(probe),
          order_(best_first(probe)),
          height_(std::max(750., 128 + legend_line * double(order_.size() + 1))),
          drawing_(1180, height_) {
        std::vector<double> errors;  // the most of each curve
        for (const ProbeCurve* curve : order_) {
            double most = 0;
            for (std::size_t i = 0; i < curve->through.size(); ++i) {
                highest_ = std::max(highest_, luminance(curve->through[i]));
                most = std::max(most, std::abs(luminance(curve->through[i] - probe.exact[i])));
            }
            if (!curve->through.empty()) errors.push_back(most);
        }
        for (const Fragment& f : probe.fragments) thickest_ = std::max(thickest_, alpha_of(f));
        highest_ = std::min(std::ceil(highest_ * 10) / 10, 2.) + .02;
        if (errors.empty()) return;
        // The better half is wholly seen: one technique that is far off would make lines of all others.
        std::ranges::sort(errors);
        widest_ = std::clamp(1.2 * errors[errors.size() / 2], .001, 1.);
        is_cut_ = errors.back() > widest_;
    }

    std::string take() {
        titles();
        depth_axis();
        value_axes();
        fragments();
        slices();
        curves();
        steps();
        legend();
        return drawing_.take();
    }

private:
    double x(double z) const {
        const bool linear = probe_.axis == DepthAxis::linear;
        const double u = linear ? (z - probe_.from) / (probe_.to - probe_.from)
                                : std::log(z / probe_.from) / std::log(probe_.to / probe_.from);
        return through_box.left + std::clamp(u, 0., 1.) * through_box.width;
    }
    /// The end of the range is a float: the farthest fragment may be a little behind it.
    bool is_seen(const Fragment& f) const { return f.depth >= probe_.from && f.depth <= probe_.to * (1 + 1e-6); }
    double y_through(double t) const { return through_box.bottom() - t / highest_ * through_box.height; }
    double y_error(double e) const { return error_box.top + error_box.height * (.5 - .5 * e / widest_); }
    double y_alpha(double alpha) const { return fragment_box.bottom() - alpha / thickest_ * (fragment_box.height - 12); }
    static double alpha_of(const Fragment& f) { return luminance(1. - f.transmittance); }

    void titles() {
        drawing_.text({70, 28}, "Transmittance along the ray: " + place_of(probe_), Anchor::start, 17);
        drawing_.text({70, 48}, fmt::format("{}; T behind them {:.4g}. Techniques on {}, mapped to {:.4g} to {:.4g} m",
                                            plural(probe_.fragments.size(), "fragment"), luminance(probe_.exact_total),
                                            probe_.device.name, probe_.nearest, probe_.farthest));
    }

    void depth_axis() {
        const bool linear = probe_.axis == DepthAxis::linear;
        for (const double z : svg::ticks(probe_.from, probe_.to, linear ? svg::Spacing::even : svg::Spacing::logarithmic)) {
            for (const Box& box : {through_box, error_box, fragment_box})
                drawing_.line({x(z), box.top}, {x(z), box.bottom()}, {.color = "#ddd", .css = "faint"});
            drawing_.text({x(z), fragment_box.bottom() + 18}, fmt::format("{:.5g}", z), Anchor::middle);
        }
        drawing_.text({fragment_box.left + fragment_box.width / 2, fragment_box.bottom() + 40},
                      fmt::format("view depth z [m], {}", linear ? "linear" : "logarithmic"), Anchor::middle, 13);
    }

    void value_axes() {
        const auto tick = [&](const Box& box, double y, double value) {
            drawing_.line({box.left, y}, {box.right(), y}, {.color = "#ddd", .css = "faint"});
            drawing_.text({box.left - 6, y + 4}, fmt::format("{:.3g}", value), Anchor::end);
        };
        for (const double t : svg::ticks(0, highest_, svg::Spacing::even)) tick(through_box, y_through(t), t);
        const double step = svg::ticks(0, widest_, svg::Spacing::even).back();
        for (const double e : {-step, 0., step}) tick(error_box, y_error(e), e);
        for (const double alpha : {0., svg::ticks(0, thickest_, svg::Spacing::even).back()})
            tick(fragment_box, y_alpha(alpha), alpha);
        drawing_.line({error_box.left, y_error(0)}, {error_box.right(), y_error(0)}, {});
        for (const Box& box : {through_box, error_box, fragment_box}) drawing_.frame(box);
        drawing_.upright_text({22, through_box.top + through_box.height / 2},
                              probe_.colored ? "T(z), luminance [1]" : "transmittance T(z) [1]");
        drawing_.upright_text({22, error_box.top + error_box.height / 2},
                              is_cut_ ? "T(z) - exact, cut off [1]" : "T(z) - exact [1]");
        drawing_.upright_text({22, fragment_box.top + fragment_box.height / 2}, probe_.colored ? "1 - t [1]" : "alpha [1]");
    }

    /// A stem of the height of its alpha with what it scatters, or of glass what it lets through; light without coverage stands
    /// on the ground.
    void fragments() {
        for (const Fragment& f : probe_.fragments) {
            if (!is_seen(f)) continue;
            const double alpha = alpha_of(f);
            glm::dvec3 light = f.alpha > 0 ? f.color / f.alpha + f.emission : f.emission + f.color;
            light /= 1. + light;
            if (f.transmittance.x != f.transmittance.y || f.transmittance.y != f.transmittance.z) light = f.transmittance;
            drawing_.line({x(f.depth), y_alpha(0)}, {x(f.depth), y_alpha(alpha)}, {.color = "#666", .css = "ink"});
            drawing_.dot({x(f.depth), y_alpha(alpha)}, probe_.fragments.size() > 60 ? 2.5 : 4, shown(light));
        }
    }

    /// Under T(z), a comb for each technique that cuts depth into slices: low along a slice, high where there is none.
    void slices() {
        std::vector<std::size_t> sliced;
        for (std::size_t i = 0; i < order_.size(); ++i)
            if (!order_[i]->slices.empty()) sliced.push_back(i);
        if (sliced.empty()) return;
        const Box strip{through_box.left, through_box.bottom(), through_box.width, error_box.top - through_box.bottom()};
        const double step = std::min(strip.height / double(sliced.size()), 12.);
        drawing_.text({strip.left - 6, strip.top + 12}, "slices", Anchor::end, 10);
        for (std::size_t row = 0; row < sliced.size(); ++row) {
            const double top = strip.top + (double(row) + .25) * step, bottom = top + .5 * step;
            std::vector<glm::dvec2> comb;
            for (const DepthSpan& slice : order_[sliced[row]]->slices) {
                if (slice.to < probe_.from || slice.from > probe_.to) continue;
                const double left = x(slice.from), right = x(slice.to);
                comb.insert(comb.end(), {{left, top}, {left, bottom}, {right, bottom}, {right, top}});
            }
            drawing_.polyline(comb, strip, {pen_of(sliced[row]).color, "curve", .8});
        }
    }

    static std::string shown(glm::dvec3 light) {
        std::array<unsigned, 3> bytes{};
        for (int c = 0; c < 3; ++c) bytes[std::size_t(c)] = unsigned(display_byte(light[c]));
        return fmt::format("#{:02x}{:02x}{:02x}", bytes[0], bytes[1], bytes[2]);
    }

    /// Up and down more often than transmittance falls: noise.
    static bool is_noisy(const ProbeCurve& curve) {
        double traveled = 0;
        for (std::size_t i = 1; i < curve.through.size(); ++i)
            traveled += std::abs(luminance(curve.through[i] - curve.through[i - 1]));
        return traveled > 4;
    }

    /// Noise behind everything, and the best on top.
    void curves() {
        for (const bool noisy : {true, false})
            for (std::size_t i = order_.size(); i-- > 0;)
                if (is_noisy(*order_[i]) == noisy) curve(i, noisy ? .7 : pen_of(i).width);
    }

    void curve(std::size_t i, double width) {
        Pen pen = pen_of(i);
        pen.width = width;
        std::vector<glm::dvec2> through, error;
        for (std::size_t s = 0; s < order_[i]->through.size(); ++s) {
            const double t = luminance(order_[i]->through[s]), at = x(probe_.depths[s]);
            through.push_back({at, y_through(t)});
            error.push_back({at, y_error(t - luminance(probe_.exact[s]))});
        }
        drawing_.polyline(through, through_box, pen);
        drawing_.polyline(error, error_box, pen);
    }

    void steps() {
        const Pen black{.color = "#111", .css = "ink", .width = 1.2};
        if (!probe_.colored) return step(black, [](const glm::dvec3& t) { return luminance(t); });
        step({"#e02020", "curve", 1}, [](const glm::dvec3& t) { return t.x; });
        step({"#10a010", "curve", 1}, [](const glm::dvec3& t) { return t.y; });
        step({"#3050ff", "curve", 1}, [](const glm::dvec3& t) { return t.z; });
        step(black, [](const glm::dvec3& t) { return luminance(t); });
    }

    template <typename Channel>
    void step(const Pen& pen, Channel channel) {
        glm::dvec3 t = transparency::transmittance_before(probe_.fragments, probe_.from);
        std::vector<glm::dvec2> points{{x(probe_.from), y_through(channel(t))}};
        for (const Fragment& f : probe_.fragments) {
            if (!is_seen(f)) continue;
            points.push_back({x(f.depth), y_through(channel(t))});
            t *= f.transmittance;
            points.push_back({x(f.depth), y_through(channel(t))});
        }
        points.push_back({x(probe_.to), y_through(channel(t))});
        drawing_.polyline(points, through_box, pen);
    }

    static std::string figures_of(const ProbeMetrics& metrics) {
        const std::string of_fragments = fmt::format("L1 {:.4f}   E_w {:.4f}", metrics.l1_logarithmic, metrics.fragment_weighted);
        if (!metrics.display_error) return of_fragments;
        return fmt::format("off {} %   {}", short_number(100 * *metrics.display_error), of_fragments);
    }

    void legend() {
        constexpr double left = 892;
        double y = through_box.top + 10;
        drawing_.line({left, y}, {left + 30, y}, {.color = "#111", .css = "ink", .width = 1.2});
        drawing_.text({left + 38, y + 4}, probe_.colored ? "exact steps (and red, green, blue)" : "exact steps");
        for (std::size_t i = 0; i < order_.size(); ++i) {
            y += legend_line;
            const ProbeCurve& curve = *order_[i];
            const bool has_curve = curve.not_supported.empty();
            if (has_curve) drawing_.line({left, y}, {left + 30, y}, pen_of(i));
            // All are of one stage. Long settings get smaller letters, .62 of their size wide: 246 pixels are left.
            const std::string variant = curve.variant.substr(curve.variant.find('/') + 1);
            drawing_.text({left + 38, y + 4}, variant, Anchor::start, std::clamp(246 / (.62 * double(variant.size())), 6., 12.));
            drawing_.text({left + 38, y + 18}, has_curve ? figures_of(curve.metrics) : curve.not_supported, Anchor::start, 10);
        }
        drawing_.text({left, y + 42}, "off: the pixel of the frame as displayed, of white", Anchor::start, 10);
        drawing_.text({left, y + 56}, "L1: mean error over the depth axis", Anchor::start, 10);
        drawing_.text({left, y + 70}, "E_w: over fragments, weighted by what each hides", Anchor::start, 10);
    }

    const Probe& probe_;
    std::vector<const ProbeCurve*> order_;
    double height_, highest_ = 1, widest_ = .001, thickest_ = .01;
    bool is_cut_ = false;  ///< whether an error is larger than its panel
    Drawing drawing_;
};

}  // namespace

std::string as_svg(const Probe& probe) { return Plot(probe).take(); }

}  // namespace strata
