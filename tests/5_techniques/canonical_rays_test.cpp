// Four rays through known fragments (docs/algorithms/transparency.md 9.3): the area between T(z) of a technique and the exact
// steps, on the device through a probe and in double by the technique's model.
#include <cmath>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/registry.h"
#include "passes/technique.h"
#include "passes/transparency/moments/model.h"
#include "passes/transparency/moments/moments.shared.h"
#include "passes/transparency/voxel/volume/column.h"
#include "passes/transparency/wavelet/model.h"
#include "replay/probe/probe.h"
#include "tests/support/session.h"

namespace strata {
namespace {

using namespace transparency;

constexpr double nearest = 1, farthest = 50;

/// Depth d of the range as 0 to 1, which these techniques divide evenly in ln z.
struct RayFragment {
    double d, alpha;
};
using Ray = std::vector<RayFragment>;

Ray one_card() { return {{.43, .9}}; }
Ray five_cards() { return {{.1, .5}, {.3, .5}, {.5005, .5}, {.7, .5}, {.9, .5}}; }
Ray even_smoke() {
    Ray ray;
    for (int i = 0; i < 100; ++i) ray.push_back({(i + .5) / 100, -std::expm1(-.03)});
    return ray;
}
Ray smoke_before_a_wall() {
    Ray ray;
    for (int i = 0; i < 20; ++i) ray.push_back({.2 + .2 * (i + .5) / 20, .1});
    ray.push_back({.8, -std::expm1(-10.)});
    return ray;
}
std::array<Ray, 4> rays() { return {one_card(), five_cards(), even_smoke(), smoke_before_a_wall()}; }

struct VariantOfTable {
    const char* variant;
    std::array<double, 4> area;  ///< of rays A to D
};
constexpr VariantOfTable table[] = {
    {"transparency/moments kind=power4", {.0003, .0954, .0866, .0444}},
    {"transparency/moments kind=power6", {.0003, .0693, .0650, .0200}},
    {"transparency/moments kind=power8", {.0007, .0502, .0523, .0210}},
    {"transparency/moments kind=trig2", {.0000, .1065, .0878, .0498}},
    {"transparency/moments kind=trig3", {.0000, .0889, .0628, .0209}},
    {"transparency/moments kind=trig4", {.0000, .0713, .0484, .0136}},
    {"transparency/wavelet rank=1 correction=none storage=single", {.0973, .1281, .1204, .1388}},
    {"transparency/wavelet rank=2 correction=none storage=single", {.0409, .0712, .0604, .0605}},
    {"transparency/wavelet rank=3 correction=none storage=single", {.0234, .0355, .0300, .0257}},
    {"transparency/wavelet rank=4 correction=none storage=single", {.0098, .0148, .0150, .0152}},
};
constexpr double tolerance = 2e-3;  // docs/algorithms/transparency.md 9.3

ProbedStack stack_of(const Ray& ray) {
    ProbedStack stack{.nearest = nearest, .farthest = farthest};
    for (const RayFragment& fragment : ray)
        stack.fragments.push_back({.depth = nearest * std::pow(farthest / nearest, fragment.d),
                                   .transmittance = glm::dvec3(1 - fragment.alpha),
                                   .alpha = fragment.alpha,
                                   .submission = static_cast<std::uint32_t>(stack.fragments.size())});
    return stack;
}

TEST(CanonicalRays, TheDeviceLeavesTheAreaOfTheTable) {
    ProbeOptions options{.samples = 400, .from = nearest, .to = farthest};
    for (const VariantOfTable& row : table) options.variants.emplace_back(row.variant);
    for (std::size_t r = 0; r < rays().size(); ++r) {
        const Probe made = must(probe(session_of_scenarios(), stack_of(rays()[r]), options));
        for (std::size_t m = 0; m < std::size(table); ++m)
            EXPECT_NEAR(made.curves[m].metrics.l1_logarithmic, table[m].area[r], tolerance) << made.curves[m].variant << ", ray "
                                                                                            << "ABCD"[r];
    }
}

double exact(const Ray& ray, double d) {
    double through = 1;
    for (const RayFragment& fragment : ray)
        if (fragment.d < d) through *= 1 - fragment.alpha;
    return through;
}

/// The area between a curve over 0 to 1 and the exact steps.
double area(const Ray& ray, const std::function<double(double d)>& curve) {
    constexpr int samples = 2000;  // ten times as many move no area by more than 6e-5
    double sum = 0;
    for (int i = 0; i < samples; ++i) sum += std::abs(curve((i + .5) / samples) - exact(ray, (i + .5) / samples));
    return sum / samples;
}

TEST(CanonicalRays, TheModelOfMomentsLeavesTheSameArea) {
    for (std::uint32_t kind = moments_power4; kind <= moments_trig4; ++kind)
        for (std::size_t r = 0; r < rays().size(); ++r) {
            const Ray ray = rays()[r];
            const MomentsParams params{.kind = kind, .storage = storage_single, .bias = 1, .overestimation = .25f};
            std::vector<WarpedFragment> projected;
            for (const RayFragment& fragment : ray)
                projected.push_back({2 * fragment.d - 1, std::min(-std::log1p(-fragment.alpha), 10.)});
            const double made = area(ray, [&](double d) { return transmittance_in_double(params, projected, 2 * d - 1); });
            EXPECT_NEAR(made, table[kind].area[r], tolerance) << table[kind].variant << ", ray "
                                                              << "ABCD"[r];
        }
}

TEST(CanonicalRays, TheModelOfWaveletsLeavesTheSameArea) {
    for (std::uint32_t rank = 1; rank <= 4; ++rank)
        for (std::size_t r = 0; r < rays().size(); ++r) {
            const Ray ray = rays()[r];
            const double last = double(2u << rank) - 1;
            std::vector<CellFragment> projected;
            for (const RayFragment& fragment : ray) projected.push_back({fragment.d * last, -std::log1p(-fragment.alpha)});
            const std::vector<double> coefficients = haar_coefficients(rank, projected);
            const double made = area(ray, [&](double d) { return std::exp(-haar_depth(coefficients, d * last)); });
            EXPECT_NEAR(made, table[5 + rank].area[r], tolerance) << table[5 + rank].variant << ", ray "
                                                                  << "ABCD"[r];
        }
}

TEST(CanonicalRays, AColumnOfVoxelsThatIsReadOneSliceInFrontIsWavelets) {
    for (std::uint32_t rank = 1; rank <= 4; ++rank)
        for (const Ray& ray : rays()) {
            const std::uint32_t slices = 2u << rank;
            std::vector<CellFragment> projected;
            std::vector<double> integral(slices, 0.);
            for (const RayFragment& fragment : ray) {
                projected.push_back({fragment.d * (slices - 1), -std::log1p(-fragment.alpha)});
                const SlicePlace place = slice_place(projected.back().place + .5, slices, splatting_linear);
                for (std::uint32_t k = place.slice; k < slices; ++k)
                    integral[k] += (k == place.slice ? 1 - place.share : 1) * projected.back().optical_depth;
            }
            const std::vector<double> coefficients = haar_coefficients(rank, projected);
            for (int i = 0; i <= 100; ++i) {
                const double place = i / 100. * (slices - 1);
                EXPECT_NEAR(sampled_integral(integral, place + .5 - 1, sampling_linear), haar_depth(coefficients, place), 1e-12);
            }
        }
}

/// A pixel of the picture with many fragments.
PixelAt deep_pixel(const FragmentLists& lists) {
    PixelAt at;
    std::size_t most = 0;
    for (std::uint32_t y = 0; y < lists.height(); ++y)
        for (std::uint32_t x = 0; x < lists.width(); ++x)
            if (const std::size_t count = lists.at(x, y).size(); count > most && !lists.undecided(x, y)) {
                most = count;
                at = {x, y};
            }
    return at;
}

TEST(Probe, OfAnExactVariantIsTheExactStepFunction) {
    std::size_t exact_variants = 0;
    for (const char* scenario : {"three_panes", "glass_and_smoke"}) {
        const Request request = on_scenario(scenario);
        const PixelAt at = deep_pixel(*must(session_of_scenarios().transparent_fragments(request)));
        for (const Technique* technique : techniques_of(Stage::transparency)) {
            if (!technique->abilities.stands_in_for_truth) continue;
            ++exact_variants;
            const Probe made = must(probe(session_of_scenarios(), request, at, {.variants = {std::string(technique->name)}}));
            for (std::size_t i = 0; i < made.depths.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(made.curves[0].through[i][c], made.exact[i][c], 1e-5)
                        << technique->name << " in " << scenario << " at " << made.depths[i] << " m";
            EXPECT_LT(made.curves[0].metrics.fragment_weighted, 1e-5) << technique->name << " in " << scenario;
        }
    }
    EXPECT_GT(exact_variants, 0u);
}

TEST(Probe, TellsTheSlicesOfAVariantThatHasSome) {
    const ProbeOptions options{.variants = {"transparency/voxel volume=dense slices=64", "transparency/voxel", table[0].variant},
                               .samples = 64,
                               .from = nearest,
                               .to = farthest};
    const Probe made = must(probe(session_of_scenarios(), stack_of(five_cards()), options));
    const std::vector<DepthSpan>& even = made.curves[0].slices;
    ASSERT_EQ(even.size(), 64u);
    EXPECT_NEAR(even.front().from, nearest, 1e-5);
    EXPECT_NEAR(even.back().to, farthest, 1e-3);
    for (std::size_t i = 1; i < even.size(); ++i) EXPECT_EQ(even[i].from, even[i - 1].to);
    EXPECT_TRUE(made.curves[0].notes.empty());
    // Where there is something, and the probe's cards are something, too: five cards would take two slices or three each.
    EXPECT_LE(made.curves[1].slices.size(), 128u);
    ASSERT_EQ(made.curves[1].notes.size(), 1u);
    EXPECT_NE(made.curves[1].notes[0].find("slices"), std::string::npos);
    EXPECT_TRUE(made.curves[2].slices.empty());
    EXPECT_NE(as_json(made).find("\"slices\":[["), std::string::npos);
    EXPECT_NE(as_svg(made).find(">slices<"), std::string::npos);
    EXPECT_NE(as_svg(made).find(">E_w: over fragments"), std::string::npos) << "a figure of the legend without its meaning";
}

TEST(Probe, ACaptureIsTheSameAfterwards) {
    const Request request = on_scenario("three_panes");
    const strata::Run before = must(session_of_scenarios().run(request));
    must(probe(session_of_scenarios(), stack_of(one_card()), {.variants = {table[0].variant}}));
    const strata::Run after = must(session_of_scenarios().run(request));
    EXPECT_EQ(before.images.at("display").texels, after.images.at("display").texels);
}

TEST(Probe, SaysWhatEveryTechniqueLetsThroughOrWhyNot) {
    const Request request = on_scenario("glass_and_smoke");
    const PixelAt at = deep_pixel(*must(session_of_scenarios().transparent_fragments(request)));
    const Probe made = must(probe(session_of_scenarios(), request, at, {.samples = 64}));
    ASSERT_EQ(made.curves.size(), techniques_of(Stage::transparency).size());
    for (const ProbeCurve& curve : made.curves) {
        EXPECT_NE(curve.not_supported.empty(), curve.through.empty()) << curve.variant;
        for (const glm::dvec3& t : curve.through) EXPECT_TRUE(std::isfinite(t.x + t.y + t.z)) << curve.variant;
    }
}

}  // namespace
}  // namespace strata
