// The truth of edges where words are equal: what depths alone say, on depths computed by hand.
#include <array>

#include <gtest/gtest.h>

#include "passes/edges/truth.h"
#include "passes/stage_input.h"
#include "tests/4_references/tiny_frame.h"

namespace strata {
namespace {

constexpr std::uint32_t width = 32, height = 8;
constexpr std::array<glm::dvec2, 4> samples = {{{.375, .125}, {.875, .375}, {.125, .625}, {.625, .875}}};

/// Two surfaces that meet at x = 20.5, as inverse depths that are linear over the picture, and their G-buffer: the same words.
struct TwoSurfaces {
    struct Slope {
        double at_zero, per_column;
        double inverse_z(double x) const { return at_zero + per_column * x; }
    };
    Slope left, right;

    Frame frame() const {
        Frame made = tiny::frame(width, height, 4);
        const auto add = [&](const Slope& s, double begin, double end) {
            const auto corner = [&](double x, double y) { return tiny::under(made, x, y, 1 / s.inverse_z(x)); };
            const std::array corners{corner(begin, -8), corner(end, -8), corner(begin, 30),
                                     corner(end, -8),   corner(end, 30), corner(begin, 30)};
            tiny::add_triangles(made, corners);
        };
        add(left, -8, 20.5);
        add(right, 20.5, 40);
        return made;
    }

    ImageSet before(const Frame& frame) const {
        ReferenceImage depth(width, height, 4), normal = depth, words(width, height, 4, {1, 2, 3, 4});
        for (std::uint32_t i = 0; i < 4; ++i)
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x) {
                    const double at = x + samples[i].x, inverse_z = (at < 20.5 ? left : right).inverse_z(at);
                    // As a device's floats have it.
                    depth.at(x, y, i).x = float(double(frame.view.near) * inverse_z);
                    normal.at(x, y, i) = {0, 0, -1, float(1 / inverse_z)};
                }
        return {{"depth_layers", depth}, {"surface_normal", normal}, {"gbuffer0", words}, {"emission", words}};
    }
};

/// Columns that are marked; every row must say the same.
std::vector<std::uint32_t> marked(const ImageSet& truth) {
    const ReferenceImage& edges = truth.at("edges");
    std::vector<std::uint32_t> columns;
    for (std::uint32_t x = 0; x < width; ++x) {
        for (std::uint32_t y = 1; y < height; ++y) EXPECT_EQ(edges.at(x, y).x, edges.at(x, 0).x) << x;
        if (edges.at(x, 0).x != 0) columns.push_back(x);
    }
    return columns;
}

std::vector<std::uint32_t> marked(const TwoSurfaces& surfaces) {
    const Frame frame = surfaces.frame();
    return marked(edges_truth({frame, surfaces.before(frame)}));
}

using Columns = std::vector<std::uint32_t>;

TEST(edges_truth, marks_a_step_of_depth_between_equal_words) {
    EXPECT_EQ(marked({{1. / 2, 0}, {1. / 6, 0}}), Columns{20}) << "2 m and 6 m away, facing the eye";
    EXPECT_EQ(marked({{1. / 2, .001}, {1. / 6, -.002}}), Columns{20}) << "leaning";
    EXPECT_EQ(marked({{.3, .001}, {.3 + 20.5 * .002, -.001}}), Columns{20}) << "a crease, without a step";
    EXPECT_EQ(marked({{1. / 6, .001}, {1.001 / 6, .001}}), Columns{20}) << "6 mm apart";
}

TEST(edges_truth, marks_no_plane_however_much_it_leans) {
    for (const double slope : {0., .001, -.004, .01}) EXPECT_EQ(marked({{.3, slope}, {.3, slope}}), Columns{}) << slope;
}

/// A layout that stores depth with its words has one depth for all samples: light sees no step.
TEST(edges_truth, marks_no_step_that_the_stored_depth_does_not_have) {
    const TwoSurfaces surfaces{{1. / 6, .001}, {1.001 / 6, .001}};
    const Frame frame = surfaces.frame();
    ImageSet before = surfaces.before(frame);
    for (glm::dvec4& texel : before.at("surface_normal").texels) texel.w = 6;
    EXPECT_EQ(marked(edges_truth({frame, before})), Columns{});
    before.erase("surface_normal");
    EXPECT_EQ(marked(edges_truth({frame, before})), Columns{20}) << "nobody decoded the layout";
}

TEST(edges_truth, marks_words_that_differ_on_one_plane) {
    const TwoSurfaces surfaces{{.3, .001}, {.3, .001}};
    const Frame frame = surfaces.frame();
    ImageSet before = surfaces.before(frame);
    for (std::uint32_t y = 0; y < height; ++y) before.at("gbuffer0").at(7, y, 2).w = 5;
    EXPECT_EQ(marked(edges_truth({frame, before})), Columns{7});
}

}  // namespace
}  // namespace strata
