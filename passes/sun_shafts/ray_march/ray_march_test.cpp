// Facts of marched sun shafts, on the model: T-SS-1 to T-SS-5 of docs/algorithms/deferred.md 6.7, over shadow maps filled by
// hand.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/frame_images.h"
#include "passes/graph/graph.h"
#include "passes/scene/shadow_views.h"
#include "passes/stage_input.h"
#include "passes/sun_shafts/truth.h"
#include "passes/technique.h"
#include "tests/support/one_pixel.h"

namespace strata::sun_shafts {

Technique ray_march();
ImageSet ray_march_model(const StageInput&, const Settings&);

namespace {

using std::numbers::pi;

/// Rays that all but coincide with the view's axis, through air of .05 per meter to a wall; the sun's irradiance is 1.
struct Tunnel {
    Frame frame = one_pixel(1);
    ImageSet before;
    double meters = 20;

    explicit Tunnel(const glm::vec3& sun, std::uint32_t width = 1, std::uint32_t height = 1) {
        frame.view.width = width;
        frame.view.height = height;
        frame.view.projection[0][0] = 1e6f;
        frame.view.projection[1][1] = -1e6f;
        frame.sun.direction = sun;
        frame.sun.irradiance = glm::vec3(1);
        frame.sun.shadow = {.casts = true, .map_size = 512, .bias = 0};
        frame.sun.cascades = 1;
        frame.sun.shadow_distance = 40;
        frame.sun.shafts = true;
        frame.fog.density = .05f;
        end_at(meters);
        draw([](const glm::dvec2&) { return 0.; });
    }
    void end_at(double away) {
        meters = away;
        before["depth_layers"] =
            ReferenceImage(frame.view.width, frame.view.height, 1, glm::dvec4(double(frame.view.near) / away));
    }
    ShadowView view() const { return shadow_views(frame).at(0); }
    /// In texels and depth, of a place on the axis.
    glm::dvec3 on_map(double t) const {
        const ShadowView map = view();
        return glm::dvec3(double(map.size), double(map.size), 1) * glm::dvec3(map.view_to_map * glm::dvec4(0, 0, t, 1));
    }
    void draw(const std::function<double(const glm::dvec2& texel)>& depth) {
        const std::uint32_t size = view().size;
        ReferenceImage maps(size, size);
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x) maps.at(x, y).x = depth(glm::dvec2(x, y) + .5);
        before["shadow_maps"] = maps;
    }
    /// Something high over the axis casts its shadow from the border of a texel near 5 m on; returns where that is.
    double shadow_second_half() {
        const glm::dvec3 eye = on_map(0), per_meter = on_map(1) - eye;
        const int axis = std::abs(per_meter.x) > std::abs(per_meter.y) ? 0 : 1;
        const double border = std::round(eye[axis] + 5 * per_meter[axis]), sign = per_meter[axis] > 0 ? 1 : -1;
        draw([=](const glm::dvec2& texel) { return sign * (texel[axis] - border) > 0 ? 1. : 0.; });
        return (border - eye[axis]) / per_meter[axis];
    }
    ReferenceImage shafts(const std::vector<std::string>& sets) const {
        static const Technique technique = ray_march();
        Settings settings(technique.params);
        for (const std::string& set : sets) {
            const std::size_t equals = set.find('=');
            EXPECT_TRUE(settings.set(set.substr(0, equals), std::string_view(set).substr(equals + 1))) << set;
        }
        return ray_march_model({frame, before}, settings).at("shafts");
    }
    double shaft(std::vector<std::string> sets) const { return shafts(sets).at(0, 0).x; }
};

const glm::vec3 down{0, -1, 0}, ahead{0, 0, 1};

std::vector<std::string> xray(const std::string& steps, const std::string& stepping = "xray") {
    return {"shaft_normalization=steps",  "shaft_intensity=1", "shaft_steps=" + steps,
            "shaft_stepping=" + stepping, "shaft_jitter=none", "shaft_taps=1"};
}

double mean(const ReferenceImage& image) {
    double sum = 0;
    for (const glm::dvec4& texel : image.texels) sum += texel.x;
    return sum / double(image.texels.size());
}

double deviation(const ReferenceImage& image) {
    const double middle = mean(image);
    double sum = 0;
    for (const glm::dvec4& texel : image.texels) sum += (texel.x - middle) * (texel.x - middle);
    return std::sqrt(sum / double(image.texels.size()));
}

}  // namespace

TEST(RayMarch, OfAFullyLitRayIs1AndOfAShadowedOneIsExactly0) {
    Tunnel tunnel(down);
    for (const char* stepping : {"xray", "stratified"}) EXPECT_NEAR(tunnel.shaft(xray("20", stepping)), 1, 1e-12) << stepping;
    tunnel.draw([](const glm::dvec2&) { return 1.; });
    for (const char* stepping : {"xray", "stratified"}) EXPECT_EQ(tunnel.shaft(xray("20", stepping)), 0) << stepping;
    EXPECT_EQ(tunnel.shaft({}), 0);
}

TEST(RayMarch, OfAHalfSpaceIsAHalfInStrataAndTooDarkByAStepAsXRaySteps) {
    Tunnel tunnel(down, 16, 9);
    tunnel.end_at(2 * tunnel.shadow_second_half() * (1 + 1e-9));
    EXPECT_NEAR(tunnel.shaft(xray("20", "stratified")), .5, 1e-12);
    EXPECT_NEAR(tunnel.shaft(xray("20")), .45, 1e-12);
    EXPECT_NEAR(tunnel.shaft(xray("40")), .475, 1e-12);
    std::vector<std::string> jittered = xray("20", "stratified");
    jittered.push_back("shaft_jitter=interleaved_gradient");
    for (const glm::dvec4& texel : tunnel.shafts(jittered).texels) EXPECT_NEAR(texel.x, .5, 1e-12);
}

TEST(RayMarch, InStrataIsUnbiasedWithTheDeviationOfTheChapter) {
    Tunnel tunnel(down, 64, 36);
    tunnel.end_at(tunnel.shadow_second_half() / .3137);
    std::vector<std::string> sets = xray("20", "stratified");
    sets.push_back("shaft_blur=off");
    sets.push_back("shaft_jitter=hash");
    const ReferenceImage hashed = tunnel.shafts(sets);
    EXPECT_NEAR(mean(hashed), .3137, 3 * .0223 / 48);
    EXPECT_NEAR(deviation(hashed), .0223, .0223 * .05);
    sets.back() = "shaft_jitter=interleaved_gradient";
    EXPECT_NEAR(mean(tunnel.shafts(sets)), .3137, 3 * .0223 / 48);
}

// The chapter's .0369 is the mean over all borders from 0 to 1; over those from .13 on it is .0365.
TEST(RayMarch, AsXRayStepsIsTooDarkByTheChaptersMean) {
    Tunnel tunnel(down, 16, 9);
    const double border = tunnel.shadow_second_half();
    std::vector<std::string> sets = xray("20");
    sets.push_back("shaft_jitter=hash");
    double missing = 0;
    for (int i = 0; i < 87; ++i) {
        const double lit = .13 + (i + .5) / 100;
        tunnel.end_at(border / lit);
        missing += (lit - mean(tunnel.shafts(sets))) / 87;
    }
    EXPECT_NEAR(missing, .0365, .001);
}
TEST(RayMarch, AlongTheSunsRaysCountsTheStepsBeforeTheCaster) {
    Tunnel tunnel(ahead);
    const double caster = tunnel.on_map(7.3).z;
    tunnel.draw([=](const glm::dvec2&) { return caster; });
    EXPECT_NEAR(tunnel.shaft(xray("20", "stratified")), 7. / 20, 1e-12) << "steps at .5, 1.5, .. 6.5 m";
    EXPECT_NEAR(tunnel.shaft(xray("40", "stratified")), 15. / 40, 1e-12) << "steps at .25, .75, .. 7.25 m";
}

TEST(RayMarch, SampledExtinctionHasTheErrorOfTheMidpointRuleAndIntegratedNone) {
    const Tunnel tunnel(down);
    const std::vector<std::string> sampled{"shaft_steps=20", "shaft_jitter=none", "shaft_extinction=sampled"};
    EXPECT_NEAR(4 * pi * tunnel.shaft(sampled), .63205472, 1e-8) << "sigma L = 1";
    for (const char* steps : {"shaft_steps=8", "shaft_steps=20"})
        EXPECT_NEAR(4 * pi * tunnel.shaft({steps}), .63212056, 1e-8) << steps;
    EXPECT_NEAR(tunnel.shaft({}), sun_shafts_truth({tunnel.frame, tunnel.before}).at("shafts").at(0, 0).x, 1e-12)
        << "no caster is drawn";
}

TEST(RayMarch, ScattersAsXRayDoesByTheViewsAngleToTheSun) {
    const auto factor = [](const glm::vec3& sun) {
        const Tunnel tunnel(sun);
        return tunnel.shaft({"shaft_phase=xray"}) / tunnel.shaft({});
    };
    EXPECT_NEAR(factor({0, 0, -1}), 1, 1e-12) << "towards the sun";
    EXPECT_NEAR(factor({0, -1, 0}), .6, 1e-12);
    EXPECT_NEAR(factor({0, 0, 1}), .2, 1e-12);
}

// By hand: (1 - g^2) / (1 + g^2 - 2 g c)^1.5 with c = 1, 0, -1.
TEST(RayMarch, ScattersForwardAsHenyeyAndGreensteinSay) {
    const auto factor = [](const glm::vec3& sun, const char* g) {
        const Tunnel tunnel(sun);
        const std::vector<std::string> sets{"shaft_phase=henyey_greenstein", std::string("shaft_asymmetry=") + g};
        return tunnel.shaft(sets) / tunnel.shaft({});
    };
    EXPECT_NEAR(factor({0, 0, -1}, "0.6"), 10, 1e-6) << "towards the sun: (1 + g) / (1 - g)^2";
    EXPECT_NEAR(factor({0, -1, 0}, "0.6"), .64 / std::pow(1.36, 1.5), 1e-6);
    EXPECT_NEAR(factor({0, 0, 1}, "0.6"), .15625, 1e-6) << "(1 - g) / (1 + g)^2";
    EXPECT_NEAR(factor({0, 0, -1}, "0.8"), 45, 1e-5);
}

// The phase only turns light: over all directions the factor's mean is 1, and cosines weighted by it have the mean g.
TEST(RayMarch, ByHenyeyAndGreensteinScattersAllLightWithTheMeanCosineOfItsName) {
    for (const double g : {.2, .4, .6, .8}) {
        const std::string set = "shaft_asymmetry=0." + std::to_string(std::lround(10 * g));
        constexpr int directions = 1000;
        Tunnel tunnel(down);
        tunnel.frame.sun.shadow.casts = false;
        const double isotropic = tunnel.shaft({});
        double whole = 0, cosines = 0;
        for (int i = 0; i < directions; ++i) {
            const double c = -1 + (i + .5) * 2 / directions;
            tunnel.frame.sun.direction = glm::vec3(0, -std::sqrt(1 - c * c), -c);
            const double factor = tunnel.shaft({"shaft_phase=henyey_greenstein", set}) / isotropic;
            whole += factor / directions;
            cosines += c * factor / directions;
        }
        EXPECT_NEAR(whole, 1, 1e-3) << g;
        EXPECT_NEAR(cosines, g, 1e-3) << g;
    }
}

TEST(RayMarch, HasATruthForEachPhase) {
    const Technique technique = ray_march();
    const Tunnel tunnel(glm::normalize(glm::vec3(.2f, -1, -.7f)));
    std::vector<std::vector<std::string>> kinds{{}, {"shaft_phase=xray"}};
    for (const char* g : {"0.2", "0.4", "0.6", "0.8"})
        kinds.push_back({"shaft_phase=henyey_greenstein", std::string("shaft_asymmetry=") + g});
    double before = 0;
    for (const std::vector<std::string>& sets : kinds) {
        Settings settings(technique.params);
        for (const std::string& set : sets)
            EXPECT_TRUE(settings.set(set.substr(0, set.find('=')), std::string_view(set).substr(set.find('=') + 1)));
        const double truth = truth_of(technique, settings).make({tunnel.frame, tunnel.before}).at("shafts").at(0, 0).x;
        EXPECT_NEAR(tunnel.shaft(sets), truth, 1e-9) << testing::PrintToString(sets);
        EXPECT_NE(truth, before) << testing::PrintToString(sets);
        before = truth;
    }
}

TEST(RayMarch, EndsAtTheShadowDistanceWhereNothingIsNearer) {
    Tunnel tunnel(down);
    tunnel.before["depth_layers"] = ReferenceImage(1, 1, 1, glm::dvec4(0));
    EXPECT_NEAR(4 * pi * tunnel.shaft({}), 1 - std::exp(-.05f * 40.), 1e-8);
}

TEST(RayMarch, AtHalfResolutionLeavesWhatIsLitThroughoutAtEveryDepth) {
    Tunnel tunnel(down, 9, 5);
    for (std::uint32_t x = 0; x < 9; ++x)
        for (std::uint32_t y = 0; y < 5; ++y) tunnel.before["depth_layers"].at(x, y).x = .1 / (2 + x + 3 * y);
    const ReferenceImage full = tunnel.shafts({}), half = tunnel.shafts({"shaft_resolution=half"});
    for (std::size_t i = 0; i < full.texels.size(); ++i) EXPECT_NEAR(half.texels[i].x, full.texels[i].x, 1e-12);
}

// Five and four of eight steps are lit: shares so alike are kept apart by depth alone.
TEST(RayMarch, BlursAlongSurfacesAndNotAcrossTheirEdges) {
    Tunnel tunnel(down, 16, 9);
    const double border = tunnel.shadow_second_half();
    tunnel.end_at(2 * border);
    for (std::uint32_t y = 0; y < 9; ++y)
        for (std::uint32_t x = 0; x < 8; ++x) tunnel.before["depth_layers"].at(x, y).x *= 1.25f;
    const ReferenceImage sharp = tunnel.shafts({"shaft_steps=8", "shaft_jitter=none", "shaft_blur=off"}),
                         blurred = tunnel.shafts({"shaft_steps=8", "shaft_jitter=none"});
    for (std::size_t i = 0; i < sharp.texels.size(); ++i)
        EXPECT_NEAR(blurred.texels[i].x, sharp.texels[i].x, .005 * sharp.texels[i].x);
}

TEST(RayMarch, AtPlainPixelsTheFirstSampleStandsForAll) {
    Tunnel tunnel(down);
    tunnel.frame.view.samples = 4;
    tunnel.before["depth_layers"] = ReferenceImage(1, 1, 4, glm::dvec4(.1 / 20));
    tunnel.before["depth_layers"].at(0, 0, 2).x = .1 / 5;
    tunnel.before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(1));
    const ReferenceImage each = tunnel.shafts({});
    EXPECT_LT(each.at(0, 0, 2).x, .5 * each.at(0, 0, 0).x);
    tunnel.before["edges"] = ReferenceImage(1, 1, 1, glm::dvec4(0));
    const ReferenceImage plain = tunnel.shafts({});
    EXPECT_EQ(plain.at(0, 0, 2).x, plain.at(0, 0, 0).x);
}

TEST(RayMarch, DeclaresNothingInClearAir) {
    const Technique technique = ray_march();
    Frame frame = Tunnel(down).frame;
    frame.fog.density = 0;
    Graph graph;
    FrameImages images;
    images.recorded = &frame;
    images.extent = {9, 5};
    technique.declare(graph, images, Settings(technique.params));
    EXPECT_TRUE(graph.steps().empty());
    EXPECT_FALSE(images.shafts);
}

}  // namespace strata::sun_shafts
