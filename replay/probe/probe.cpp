#include "replay/probe/probe.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "capture_format/nearest_name.h"
#include "passes/reference/ordering.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/low_resolution/prepass.h"
#include "passes/transparency/sample_blend.h"
#include "replay/probe/probe_frame.h"
#include "replay/session/choice_text.h"

namespace strata {
namespace {

// A probe stands so much nearer than the fragment whose T it measures: more than floats round, less than techniques resolve.
constexpr double just_in_front = 1 - 1e-6;
// What the probe itself may change of the total before a note says so.
constexpr double disturbance_noted = 2e-3;
// Off the steps: farther from every one than this share of the axis.
constexpr double off_steps = .01;

struct ProbedVariant {
    std::string name;
    const Technique* technique = nullptr;
    Request request;
};

Result<ProbedVariant> probed(const std::string& text) {
    auto parsed = parse_variant(Stage::transparency, text);
    if (!parsed) return parsed.error();
    const Technique& technique = *parsed->technique;
    ProbedVariant variant{std::string(technique.name), &technique, {.choices = {}, .outputs = {"color"}}};
    if (const std::string_view slices_table = technique.abilities.slices_table; !slices_table.empty())
        variant.request.outputs.push_back(fmt::format("{}:{}", technique.name, slices_table));
    variant.request.choices.use(technique);
    variant.request.choices.settings = std::move(parsed->settings);
    if (!parsed->text.empty()) variant.name += " " + parsed->text;
    return variant;
}

Result<std::vector<ProbedVariant>> parse_variants(std::span<const std::string> texts) {
    std::vector<ProbedVariant> variants;
    for (const std::string& text : texts) {
        auto variant = probed(text);
        if (!variant) return variant.error();
        if (std::ranges::count(variants, variant->name, &ProbedVariant::name) > 0)
            return fail(Fault::usage, "report.technique_given_twice", "--techniques gives '{variant}' twice", variant->name);
        variants.push_back(*std::move(variant));
    }
    if (texts.empty())
        for (const Technique* technique : techniques_of(Stage::transparency))
            variants.push_back(*probed(std::string(technique->name)));
    return variants;
}

/// The axis as 0 to 1.
struct Axis {
    DepthAxis kind;
    double from, to;
    double depth(double u) const { return kind == DepthAxis::linear ? from + u * (to - from) : from * std::pow(to / from, u); }
    double place(double z) const {
        return kind == DepthAxis::linear ? (z - from) / (to - from) : std::log(z / from) / std::log(to / from);
    }
};

double mean_error(glm::dvec3 a, glm::dvec3 b) {
    const glm::dvec3 error = glm::abs(a - b);
    return (error.x + error.y + error.z) / 3;
}

ProbeMetrics metrics_of(const Probe& probe, const ProbeCurve& curve) {
    ProbeMetrics metrics;
    const Axis axis{probe.axis, probe.from, probe.to};
    const Axis linear{DepthAxis::linear, probe.from, probe.to}, logarithmic{DepthAxis::logarithmic, probe.from, probe.to};
    std::vector<double> steps;
    for (const Fragment& fragment : probe.fragments)
        if (fragment.alpha > 0) steps.push_back(axis.place(fragment.depth));
    const auto is_off_steps = [&](double u) {
        return std::ranges::none_of(steps, [&](double step) { return std::abs(u - step) < off_steps; });
    };
    const double count = static_cast<double>(probe.depths.size());
    for (std::size_t i = 0; i < probe.depths.size(); ++i) {
        const double error = mean_error(curve.through[i], probe.exact[i]), u = static_cast<double>(i) / count;
        const double near = axis.depth(u), far = axis.depth(u + 1 / count);
        metrics.l1_linear += error * (linear.place(far) - linear.place(near));
        metrics.l1_logarithmic += error * (logarithmic.place(far) - logarithmic.place(near));
        if (is_off_steps(u + .5 / count)) metrics.worst_off_steps = std::max(metrics.worst_off_steps.value_or(0), error);
    }
    double weight = 0;
    for (std::size_t i = 0; i < probe.fragments.size(); ++i) {
        const double hidden = mean_error(probe.fragments[i].transmittance, glm::dvec3(1));
        weight += hidden;
        metrics.fragment_weighted += hidden * mean_error(curve.at_fragments[i], probe.before_fragments[i]);
    }
    if (weight > 0) metrics.fragment_weighted /= weight;
    const glm::dvec3 total = curve.total - probe.exact_total;
    metrics.total = (total.x + total.y + total.z) / 3;
    return metrics;
}

using Row = std::vector<glm::dvec3>;

struct Picture {
    Row row;
    std::vector<DepthSpan> slices;
};

/// What the device makes of one frame by each of several techniques: the row of pixels, and the slices of those that have some.
Result<std::vector<Picture>> pictures_of(Session& session, const ProbeScene& scene, std::span<const ProbedVariant> variants) {
    std::vector<Request> requests;
    for (const ProbedVariant& variant : variants) requests.push_back(variant.request);
    const auto runs = session.run(probe_frame(scene), requests);
    if (!runs) return runs.error();
    std::vector<Picture> pictures;
    for (const Run& run : *runs) {
        const HostImage& color = run.images.at("color");
        Picture& picture = pictures.emplace_back();
        for (std::uint32_t x = 0; x < run.width; ++x) picture.row.push_back(texel(color, x, 0));
        for (const auto& [name, table] : run.tables)
            for (const std::vector<double>& slice : table.rows) picture.slices.push_back({slice[0], slice[1]});
    }
    return pictures;
}

/// T at every probe's depth, and behind everything.
struct Measured {
    Row through;
    glm::dvec3 total{0};
    double disturbance = 0;         ///< the most a probe changed of the total
    std::vector<DepthSpan> slices;  ///< while it was probed
    std::size_t own_slices = 0;     ///< that there are without a probe
};

/// Techniques that take the same kind of probe, measured together: a frame is uploaded once for all.
Result<std::vector<Measured>> measure(Session& session, ProbeScene scene, std::span<const ProbedVariant> variants) {
    const bool is_additive = scene.kind == ProbeKind::additive;
    std::vector<std::vector<Picture>> pictures;
    const auto take = [&](ProbeKind kind, float background) -> Result<void> {
        scene.kind = kind;
        scene.background = background;
        auto made = pictures_of(session, scene, variants);
        if (!made) return made.error();
        pictures.push_back(*std::move(made));
        return {};
    };
    const std::pair<ProbeKind, float> additive[] = {
        {ProbeKind::none, 1.f}, {ProbeKind::additive, 0.f}, {ProbeKind::additive, 1.f}};
    const std::pair<ProbeKind, float> thin[] = {
        {ProbeKind::none, 1.f}, {ProbeKind::thin_white, 0.f}, {ProbeKind::thin_black, 0.f}};
    for (const auto& [kind, background] : is_additive ? additive : thin)
        if (const auto taken = take(kind, background); !taken) return taken.error();

    std::vector<Measured> all(variants.size());
    for (std::size_t m = 0; m < variants.size(); ++m) {
        const Row &behind = pictures[0][m].row, &lit = pictures[1][m].row, &other = pictures[2][m].row;
        all[m].slices = pictures[1][m].slices;
        all[m].own_slices = pictures[0][m].slices.size();
        for (std::size_t i = 0; i < lit.size(); ++i) {
            all[m].total += behind[i] / static_cast<double>(lit.size());
            all[m].through.push_back(is_additive ? lit[i] : (lit[i] - other[i]) / thin_probe_alpha);
            if (is_additive) all[m].disturbance = std::max(all[m].disturbance, mean_error(other[i] - lit[i], behind[i]));
        }
    }
    return all;
}

std::vector<std::string> notes_of(const Measured& measured, ProbeKind kind, const Technique& technique) {
    std::vector<std::string> notes;
    if (kind != ProbeKind::additive)
        notes.push_back(fmt::format("it cannot do additive light: probed by cards of alpha 1/{:.0f}, which hide as much",
                                    1 / thin_probe_alpha));
    else if (measured.disturbance >= disturbance_noted)
        notes.push_back(fmt::format(
            "the probe disturbs the technique: T behind everything changes by up to {:.2g}, where the probe takes a layer "
            "of its own or other random numbers are drawn",
            measured.disturbance));
    if (measured.slices.size() != measured.own_slices)
        notes.push_back(fmt::format("the probe's cards take slices, too: {} are in use, {} without them", measured.slices.size(),
                                    measured.own_slices));
    if (technique.abilities.sorts_objects)
        notes.push_back(
            "it sorts objects, and here every fragment is one: how wrong their order is in the frame shows in the display error "
            "alone");
    return notes;
}

/// Fills Probe::curves, in the order of the techniques.
Result<void> measure_all(Session& session, Probe& probe, ProbeScene scene, const std::vector<ProbedVariant>& variants) {
    ProbeScene bare = scene;
    bare.kind = ProbeKind::none;
    const Features features = frame_features(probe_frame(bare));
    probe.curves.resize(variants.size());
    for (const ProbeKind kind : {ProbeKind::additive, ProbeKind::thin_black}) {
        std::vector<ProbedVariant> together;
        std::vector<ProbeCurve*> curves;
        for (std::size_t i = 0; i < variants.size(); ++i) {
            const bool has_additive =
                std::ranges::find(variants[i].technique->cannot, Feature::additive) == variants[i].technique->cannot.end();
            if (has_additive != (kind == ProbeKind::additive)) continue;
            probe.curves[i].variant = variants[i].name;
            if (const auto feature = unsupported(*variants[i].technique, features)) {
                probe.curves[i].not_supported = fmt::format("it cannot do {}", name(*feature));
                continue;
            }
            together.push_back(variants[i]);
            curves.push_back(&probe.curves[i]);
        }
        scene.kind = kind;
        if (together.empty()) continue;
        auto measured = measure(session, scene, together);
        if (!measured) return measured.error();
        for (std::size_t i = 0; i < together.size(); ++i) {
            Measured& of = (*measured)[i];
            const auto samples = of.through.begin() + static_cast<std::ptrdiff_t>(probe.depths.size());
            curves[i]->through.assign(of.through.begin(), samples);
            curves[i]->at_fragments.assign(samples, of.through.end());
            curves[i]->total = of.total;
            curves[i]->notes = notes_of(of, kind, *together[i].technique);
            curves[i]->slices = std::move(of.slices);
            curves[i]->metrics = metrics_of(probe, *curves[i]);
        }
    }
    return {};
}

/// From and to: what was asked for, or around the fragments, within the frame's range.
Result<void> choose_range(Probe& probe, const ProbeOptions& options) {
    const double first = probe.fragments.front().depth, last = probe.fragments.back().depth;
    const double margin = std::max(1.05, std::pow(last / first, .1));
    const double from = options.from > 0 ? options.from : first / margin, to = options.to > 0 ? options.to : last * margin;
    probe.from = std::clamp(from, probe.nearest, probe.farthest);
    probe.to = std::clamp(to, probe.nearest, probe.farthest);
    if (probe.from < probe.to) return {};
    return fail(Fault::usage, "probe.empty_range",
                "there is nothing to probe from {from:.4g} to {to:.4g} m: the frame's transparent geometry is from {nearest:.4g} "
                "to {farthest:.4g} m",
                from, to, probe.nearest, probe.farthest);
}

/// The frame's pixel nearest to `at` that has a fragment.
std::optional<PixelAt> nearest_with_some(const FragmentLists& lists, PixelAt at) {
    std::optional<PixelAt> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x) {
            const double distance = std::hypot(double(x) - double(at.x), double(y) - double(at.y));
            if (distance >= least || lists.at(x, y, at.sample).empty()) continue;
            least = distance;
            best = PixelAt{x, y, at.sample};
        }
    return best;
}

Result<void> check_pixel(Session& session, const Request& request, const FragmentLists& lists, PixelAt at) {
    if (at.x >= lists.width() || at.y >= lists.height())
        return fail(Fault::usage, "frame.no_pixel",
                    "the picture has {width} x {height} pixels, counted from 0; there is no pixel ({x}, {y})", lists.width(),
                    lists.height(), at.x, at.y);
    if (at.sample >= lists.samples())
        return fail(Fault::usage, "frame.no_sample", "there is no sample {sample}: a pixel has {samples}, numbered from 0",
                    at.sample, lists.samples());
    if (!lists.at(at.x, at.y, at.sample).empty()) return {};
    const auto all = session.transparent_fragments(request);
    if (!all) return all.error();
    const auto other = nearest_with_some(**all, at);
    if (!other)
        return fail(Fault::usage, "probe.no_fragment", "no transparent fragment at ({x}, {y}), nor anywhere in the frame", at.x,
                    at.y);
    return fail(Fault::usage, "probe.no_fragment",
                "no transparent fragment at ({x}, {y}); the nearest pixel with some is ({nearest_x}, {nearest_y})", at.x, at.y,
                other->x, other->y);
}

}  // namespace

Result<Probe> probe(Session& session, ProbedStack stack, const ProbeOptions& options) {
    const auto variants = parse_variants(options.variants);
    if (!variants) return variants.error();
    assert(!stack.fragments.empty());
    if (options.samples < 2 || options.samples > most_probe_depths)
        return fail(Fault::usage, "probe.depth_count", "transmittance is evaluated at 2 to {most} depths, not {depths}",
                    most_probe_depths, options.samples);
    if (options.samples + stack.fragments.size() > session.device().max_image_extent)
        return fail(
            Fault::usage, "probe.too_many_depths",
            "{depths} depths and the pixel's fragments ({fragments}) are more than the {limit} that the device evaluates at once",
            options.samples, stack.fragments.size(), session.device().max_image_extent);
    // A depth offset may bring a particle nearer than the range, where techniques stop telling depths apart.
    for (Fragment& fragment : stack.fragments) fragment.depth = std::max(fragment.depth, stack.nearest);
    Probe probe{.axis = options.axis, .nearest = stack.nearest, .farthest = stack.farthest, .device = session.device()};
    probe.fragments = transparency::nearest_first(stack.fragments);
    if (const auto chosen = choose_range(probe, options); !chosen) return chosen.error();

    const Axis axis{probe.axis, probe.from, probe.to};
    for (std::uint32_t i = 0; i < options.samples; ++i) probe.depths.push_back(axis.depth((i + .5) / options.samples));
    std::vector<ProbePoint> points;
    for (const double z : probe.depths) {
        probe.exact.push_back(transparency::transmittance_before(probe.fragments, z));
        points.push_back({z, stack.fragments.size()});
    }
    for (const Fragment& fragment : probe.fragments) {
        const auto submitted = std::ranges::find(stack.fragments, fragment.submission, &Fragment::submission);
        points.push_back({fragment.depth * just_in_front, static_cast<std::size_t>(submitted - stack.fragments.begin())});
        probe.before_fragments.push_back(transparency::transmittance_before(probe.fragments, points.back().depth));
        const glm::dvec3 t = fragment.transmittance;
        probe.colored = probe.colored || t.x != t.y || t.y != t.z;
        probe.exact_total *= t;
    }
    const ProbeScene scene{
        .fragments = stack.fragments, .nearest = stack.nearest, .farthest = stack.farthest, .points = points, .seed = stack.seed};
    if (const auto measured = measure_all(session, probe, scene, *variants); !measured) return measured.error();
    return probe;
}

Result<Probe> probe(Session& session, const Request& request, PixelAt at, const ProbeOptions& options) {
    if (const auto variants = parse_variants(options.variants); !variants) return variants.error();  // before seconds of work
    const auto frame = session.frame(request.variant.frame);
    if (!frame) return frame.error();
    const auto lists = session.row_fragments(request, at.y);
    if (!lists) return lists.error();
    if (const auto checked = check_pixel(session, request, **lists, at); !checked) return checked.error();
    const std::span<const Fragment> fragments = (*lists)->at(at.x, at.y, at.sample);
    const bool undecided = (*lists)->undecided(at.x, at.y, at.sample);
    const auto range = transparent_depth_range(*frame);
    auto made = probe(session,
                      {.fragments = {fragments.begin(), fragments.end()},
                       .nearest = double(range.nearest),
                       .farthest = double(range.farthest),
                       .seed = frame->seed},
                      options);
    if (!made) return made;
    made->frame = request.variant.frame;
    made->at = at;
    made->undecided = undecided;
    if (const auto added = add_display_errors(session, request, *made); !added) return added.error();
    return made;
}

}  // namespace strata
