// Facts about light that travels from cell to cell, on the model: the numbers of docs/algorithms/lighting.md 5.10, and an
// evaluation face by face that shares no code with it.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "passes/indirect/lpv/grids_model.h"
#include "passes/indirect/lpv/propagation/propagation_model.h"

namespace strata::indirect::in_double {
namespace {

using glm::dvec3, glm::dvec4, glm::uvec3;
using std::numbers::pi;

constexpr PropagationRule linear_center{propagation_linear, faces_centre}, linear_exact{propagation_linear, faces_exact};
constexpr PropagationRule all_rules[] = {linear_center,
                                         linear_exact,
                                         {propagation_clamped, faces_centre},
                                         {propagation_clamped, faces_exact},
                                         {propagation_energy_true, faces_centre},
                                         {propagation_energy_true, faces_exact},
                                         {propagation_linear, faces_centre, lobes_flow},
                                         {propagation_energy_true, faces_exact, lobes_flow}};

struct FaceAngles {
    double far = 4 * std::asin(0.1), side = (2 * pi / 3 - 4 * std::asin(0.1)) / 4;
};

/// The table of docs/algorithms/lighting.md 5.4, face by face.
dvec4 face_by_face(const dvec4& source, const dvec3& way, double least_flux, uint lobes = lobes_face) {
    dvec4 sum(0);
    const auto add = [&](double angle, const dvec3& towards, const dvec3& normal) {
        const double y0 = 0.5 / std::sqrt(pi), y1 = std::sqrt(3 / pi) / 2;
        const double intensity = source.x * y0 + y1 * (source.y * towards.x + source.z * towards.y + source.w * towards.z);
        const double flux = std::max(angle * intensity, least_flux);
        sum += flux / pi * dvec4(std::sqrt(pi) / 2, std::sqrt(pi / 3) * (lobes == lobes_face ? normal : towards));
    };
    add(FaceAngles().far, way, way);
    for (glm::length_t axis = 0; axis < 3; ++axis)
        for (const double sign : {-1., 1.}) {
            dvec3 side(0);
            side[axis] = sign;
            if (glm::dot(side, way) == 0) add(FaceAngles().side, glm::normalize(way + side / 2.0), side);
        }
    return sum;
}

dvec3 direction_of(const Travel& travel) {
    dvec3 way(0);
    way[travel.axis] = travel.sign;
    return way;
}

constexpr std::array<Travel, 6> six_ways = {{{0, 1}, {0, -1}, {1, 1}, {1, -1}, {2, 1}, {2, -1}}};

double largest_difference(const dvec4& a, const dvec4& b) {
    const dvec4 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z, d.w});
}

#define EXPECT_COEFFICIENTS(actual, expected, tolerance) EXPECT_LE(largest_difference(actual, expected), tolerance)

/// Coefficients without a pattern, some of them pointing more than they hold.
dvec4 arbitrary(std::mt19937& random) {
    const auto number = [&] { return double(random()) / 4294967296.0; };
    const double l0 = number(), x = number(), y = number(), z = number();
    return {l0, 2 * x - 1, 2 * y - 1, 2 * z - 1};
}

struct Room {
    uvec3 cells{16};
    std::size_t at(const uvec3& cell) const { return cell_index(cells, cell); }
    Channel with(const uvec3& cell, const dvec4& light) const {
        Channel channel(std::size_t{cells.x} * cells.y * cells.z);
        channel[at(cell)] = light;
        return channel;
    }
};

double held(const Channel& channel) {
    double sum = 0;
    for (const dvec4& cell : channel) sum += cell.x;
    return sum;
}

// T5.3
TEST(PropagatedLight, GoesToSixNeighborsWithoutLoss) {
    double all = 0;
    for (const Travel& way : six_ways) {
        const dvec4 sent = arriving({1, 0, 0, 0}, way, linear_center);
        EXPECT_NEAR(sent.x, 1. / 6, 1e-12);
        all += sent.x;
    }
    EXPECT_NEAR(all, 1, 1e-12);
    // l1 of a neighbor holds the far face alone: (C1 / pi) Y0 times its solid angle.
    const double far = arriving({1, 0, 0, 0}, {2, 1}, linear_center).w * pi * 2 * std::sqrt(pi) / std::sqrt(pi / 3);
    EXPECT_NEAR(far, 0.400669684646, 1e-12);
    EXPECT_NEAR(far + 4 * 0.423431354437, 2 * pi / 3, 4e-12);
}

TEST(PropagatedLight, IsTheSumOverFiveFaces) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        const dvec4 source = arbitrary(random);
        for (const Travel& way : six_ways) {
            EXPECT_COEFFICIENTS(arriving(source, way, linear_center), face_by_face(source, direction_of(way), -INFINITY), 1e-12);
            EXPECT_COEFFICIENTS(arriving(source, way, {propagation_clamped, faces_centre}),
                                face_by_face(source, direction_of(way), 0), 1e-12);
            EXPECT_COEFFICIENTS(arriving(source, way, {propagation_linear, faces_centre, lobes_flow}),
                                face_by_face(source, direction_of(way), -INFINITY, lobes_flow), 1e-12);
            EXPECT_COEFFICIENTS(arriving(source, way, {propagation_clamped, faces_centre, lobes_flow}),
                                face_by_face(source, direction_of(way), 0, lobes_flow), 1e-12);
        }
    }
}

TEST(PropagatedLight, HasThePublishedConstants) {
    const dvec4 along = arriving({0, 0, 0, 1}, {2, 1}, linear_center), across = arriving({0, 1, 0, 0}, {2, 1}, linear_center);
    EXPECT_COEFFICIENTS(along, dvec4(0.264029168570, 0, 0, 0.063768560859), 1e-12);
    EXPECT_COEFFICIENTS(across, dvec4(0, 0.060276515559, 0, 0), 1e-12);
    EXPECT_COEFFICIENTS(arriving({1, 0, 0, 0}, {2, 1}, linear_center), dvec4(1. / 6, 0, 0, 0.036816795778), 1e-12);
    const dvec4 exact_along = arriving({0, 0, 0, 1}, {2, 1}, linear_exact),
                exact_across = arriving({0, 1, 0, 0}, {2, 1}, linear_exact);
    EXPECT_COEFFICIENTS(exact_along, dvec4(0.239943780037, 0, 0, 0.061658794703), 1e-12);
    EXPECT_COEFFICIENTS(exact_across, dvec4(0, 0.069828636322, 0, 0), 1e-12);
    EXPECT_COEFFICIENTS(arriving({1, 0, 0, 0}, {2, 1}, linear_exact), dvec4(1. / 6, 0, 0, 0.036816795778), 1e-12);
}

/// The mean over a face of the neighbor along z by the midpoint rule: what clamping sees with exact faces.
struct SummedFace {
    double angle = 0;
    dvec3 directions{0};
};
SummedFace summed_face(const dvec3& middle, const dvec3& u, const dvec3& v) {
    constexpr int steps = 400;
    SummedFace sum;
    const dvec3 normal = glm::cross(u, v);
    for (int i = 0; i < steps * steps; ++i) {
        const dvec3 at = middle + u * ((i % steps + 0.5) / steps - 0.5) + v * ((i / steps + 0.5) / steps - 0.5);
        const double r = glm::length(at), angle = std::abs(glm::dot(at, normal)) / (r * r * r) / (steps * steps);
        sum.angle += angle;
        sum.directions += angle * at / r;
    }
    return sum;
}

TEST(PropagatedLight, ClampsTheMeanOfAFaceWhereFacesAreExact) {
    const SummedFace far = summed_face({0, 0, 1.5}, {1, 0, 0}, {0, 1, 0}), side = summed_face({0.5, 0, 1}, {0, 1, 0}, {0, 0, 1});
    EXPECT_NEAR(far.directions.z, 0.3874136329, 1e-6);
    EXPECT_NEAR(side.directions.z, 0.3383564674, 2e-6);
    EXPECT_NEAR(side.directions.x, 0.2193731309, 2e-6);
    const double y0 = 0.5 / std::sqrt(pi), y1 = std::sqrt(3 / pi) / 2;
    // Against +x, so that some side faces send nothing.
    const dvec4 source(0.4, -0.7, 0.2, 0.1);
    const auto flux = [&](double angle, const dvec3& directions) {
        return std::max(0.0, y0 * source.x * angle + y1 * glm::dot(dvec3(source.y, source.z, source.w), directions));
    };
    const double a = side.directions.z, b = side.directions.x;
    const double ahead = flux(far.angle, far.directions), left = flux(side.angle, {-b, 0, a}),
                 right = flux(side.angle, {b, 0, a});
    const double below = flux(side.angle, {0, -b, a}), above = flux(side.angle, {0, b, a});
    EXPECT_EQ(right, 0);
    const double c0 = std::sqrt(pi) / 2 / pi, c1 = std::sqrt(pi / 3) / pi;
    EXPECT_COEFFICIENTS(arriving(source, {2, 1}, {propagation_clamped, faces_exact}),
                        dvec4(c0 * (ahead + left + right + below + above), c1 * (right - left), c1 * (above - below), c1 * ahead),
                        1e-5);
}

// T5.4
TEST(PropagatedLight, OfAnEvenSourceSpreadsAsPublished) {
    const Room room{uvec3(13)};
    const Links links{room.cells};
    Channel light = next_step(links, room.with({6, 6, 6}, {1, 0, 0, 0}), linear_center);
    EXPECT_COEFFICIENTS(light[room.at({6, 6, 7})], dvec4(1. / 6, 0, 0, 0.0368167958), 1e-10);
    light = next_step(links, light, linear_center);
    EXPECT_NEAR(light[room.at({6, 6, 6})].x, 0.1083424188, 1e-10);
    EXPECT_COEFFICIENTS(light[room.at({6, 6, 8})], dvec4(0.0374984858, 0, 0, 0.0084838867), 1e-10);
    EXPECT_COEFFICIENTS(light[room.at({7, 6, 7})], dvec4(0.0555555556, 0.0083553208, 0, 0.0083553208), 1e-10);
    for (int i = 2; i < 6; ++i) light = next_step(links, light, linear_center);
    EXPECT_NEAR(held(light), 1, 1e-12);
}

// T5.5, T5.6
TEST(PropagatedLight, OfALobeSpreadsAsPublished) {
    const dvec4 lobe(0.2820948, 0, 0, 0.3257350);
    const Travel ahead{2, 1}, aside{0, 1}, behind{2, -1};
    EXPECT_COEFFICIENTS(arriving(lobe, ahead, linear_center), dvec4(.13301934, 0, 0, .03115748), 2e-8);
    EXPECT_COEFFICIENTS(arriving(lobe, aside, linear_center), dvec4(.04701580, .01038583, 0, .01963417), 2e-8);
    EXPECT_COEFFICIENTS(arriving(lobe, behind, linear_center), dvec4(-.03898774, 0, 0, .01038583), 2e-8);
    const PropagationRule clamped{propagation_clamped, faces_centre}, energy_true{propagation_energy_true, faces_centre};
    EXPECT_EQ(arriving(lobe, behind, clamped), dvec4(0));
    double sum = 0, true_sum = 0;
    const double share = sent_share(lobe, energy_true);
    for (const Travel& way : six_ways) {
        sum += arriving(lobe, way, clamped).x / lobe.x;
        true_sum += share * arriving(lobe, way, energy_true).x / lobe.x;
    }
    EXPECT_NEAR(sum, 1.138208, 1e-6);
    EXPECT_NEAR(true_sum, 1, 1e-12);
    EXPECT_COEFFICIENTS(share * arriving(lobe, ahead, energy_true), dvec4(.11686735, 0, 0, .02737415), 2e-8);
    EXPECT_COEFFICIENTS(share * arriving(lobe, aside, energy_true), dvec4(.04130686, .00912472, 0, .01725007), 2e-8);
    EXPECT_COEFFICIENTS(arriving(lobe, ahead, linear_exact), dvec4(.12517389, 0, 0, .03047025), 2e-8);
    EXPECT_COEFFICIENTS(arriving(lobe, aside, linear_exact), dvec4(.04701580, .01038583, 0, .02274563), 2e-8);
}

/// l0 that leaves the grid in the next step.
double leaving(const Room& room, const Channel& light) {
    double sum = 0;
    for (std::uint32_t i = 0; i < light.size(); ++i) {
        const uvec3 cell(i % room.cells.x, i / room.cells.x % room.cells.y, i / room.cells.x / room.cells.y);
        for (const Travel& way : six_ways)
            if (cell[way.axis] == (way.sign > 0 ? room.cells[way.axis] - 1 : 0)) sum += arriving(light[i], way, linear_center).x;
    }
    return sum;
}

// T5.7
TEST(PropagatedLight, IsAbsorbedByTheWallsOfARoom) {
    const Room room{uvec3(4)};
    const Links links{room.cells};
    Channel light = room.with({1, 1, 1}, {1, 0, 0, 0});
    const Channel injected = light;
    constexpr double remaining[] = {1.0, .887504543, .724451627, .565415231, .434419149, .332567020, .254460374, .194760923};
    double absorbed = 0;
    for (int step = 1; step <= 16; ++step) {
        absorbed += leaving(room, light);
        light = next_step(links, light, linear_center);
        if (step <= 8) {
            EXPECT_NEAR(held(light), remaining[step - 1], 1e-9) << "after step " << step;
        }
        EXPECT_NEAR(held(light) + absorbed, 1, 1e-12);
    }
    EXPECT_NEAR(held(light), .023083860, 1e-9);
    const Channel sum = propagated(links, injected, linear_center, 16);
    EXPECT_NEAR(sum[room.at({1, 1, 1})].x, 1.191701824, 1e-9);
    EXPECT_NEAR(sum[room.at({2, 2, 2})].x, .074755251, 1e-9);
    EXPECT_NEAR(sum[room.at({3, 3, 3})].x, .009297610, 1e-9);
}

// T5.8. In 32 steps light cannot leave a grid of 41 cells and come back to 8 cells from its middle.
TEST(PropagatedLight, FallsWithDistanceAsPublished) {
    const Room room{uvec3(41)};
    const Channel sum = propagated({room.cells}, room.with(uvec3(20), {0.5 / std::sqrt(pi), 0, 0, 0}), linear_center, 32);
    struct Row {
        std::uint32_t r;
        double l0, l1;
    };
    for (const Row& row : {Row{1, 9.143692e-2, 1.278159e-2}, Row{2, 3.670566e-2, 4.148318e-3}, Row{4, 8.495548e-3, 7.197236e-4},
                           Row{8, 5.461394e-4, 4.815268e-5}}) {
        const dvec4 cell = sum[room.at({20, 20, 20 + row.r})];
        EXPECT_NEAR(cell.x / row.l0, 1, 5e-7) << row.r << " cells away";
        EXPECT_NEAR(cell.w / row.l1, 1, 5e-7) << row.r << " cells away";
    }
}

// T5.9
TEST(PropagatedLight, ReachesEverySecondCellInOneStep) {
    const Room room{uvec3(12)};
    for (const PropagationRule& rule : all_rules) {
        Channel light = room.with({6, 6, 6}, cosine_lobe({0.6, 0, 0.8}));
        for (int i = 0; i < 5; ++i) light = next_step({room.cells}, light, rule);
        for (std::uint32_t i = 0; i < light.size(); ++i) {
            const bool is_even = (i % 12 + i / 12 % 12 + i / 144) % 2 == 0;
            ASSERT_TRUE(!is_even || light[i] == dvec4(0));
        }
    }
}

// docs/algorithms/lighting.md 5.8, the table of irradiance relative to 1 / r^2 on the axis of a source.
TEST(PropagatedLight, IsWrongByDistanceAsPublished) {
    const Room room{uvec3(41)};
    const double y0 = 0.5 / std::sqrt(pi), y1 = std::sqrt(3 / pi) / 2;
    constexpr std::uint32_t distances[] = {1, 2, 3, 4, 5, 6, 8};
    struct Row {
        dvec4 source;
        double intensity;  ///< of the source towards +z
        std::uint32_t steps;
        std::array<double, 7> ratios;
    };
    const dvec4 lobe = cosine_lobe({0, 0, 1}), even(y0 * 4 * pi, 0, 0, 0);
    for (const Row& row : {Row{lobe, 1, 8, {.837, .994, .624, .345, .103, .041, .001}},
                           Row{lobe, 1, 16, {.884, 1.146, .917, .651, .367, .214, .041}},
                           Row{even, 1, 32, {1.610, 2.489, 2.490, 2.210, 1.718, 1.309, .571}}}) {
        const Channel sum =
            propagated({room.cells}, room.with(uvec3(20), row.source), {propagation_clamped, faces_centre}, row.steps);
        for (std::size_t i = 0; i < row.ratios.size(); ++i) {
            const dvec4 cell = sum[room.at({20, 20, 20 + distances[i]})];
            const double irradiance = 4 * (y0 * cell.x + y1 * cell.w), exact = row.intensity / (distances[i] * distances[i]);
            EXPECT_NEAR(irradiance / exact, row.ratios[i], 6e-4) << distances[i] << " cells away after " << row.steps << " steps";
        }
    }
}

/// A room whose cells and links have no pattern.
struct ArbitraryRoom {
    Room room{uvec3(5)};
    Links links{room.cells};
    Channel light;

    ArbitraryRoom() {
        std::mt19937 random(7);
        for (int i = 0; i < 125; ++i) {
            light.push_back(arbitrary(random));
            links.open.push_back(glm::abs(dvec3(arbitrary(random))));
        }
    }
    std::uint32_t last() const { return room.cells.x - 1; }
};

/// After six steps: that the other room has the light of the scene at the places that `moved` gives, with what `changed` makes of
/// it.
template <typename Moved, typename Changed>
void expect_moved_light(const ArbitraryRoom& scene, const ArbitraryRoom& other, const Moved& moved, const Changed& changed) {
    for (const PropagationRule& rule : all_rules) {
        const Channel here = propagated(scene.links, scene.light, rule, 6), there = propagated(other.links, other.light, rule, 6);
        for (std::uint32_t i = 0; i < 125; ++i)
            EXPECT_COEFFICIENTS(there[scene.room.at(moved({i % 5, i / 5 % 5, i / 25}))], changed(here[i]), 4e-15);
    }
}

// T5.15
TEST(PropagatedLight, TurnsWithTheScene) {
    const ArbitraryRoom scene;
    // Cells go from (x, y, z) to (last - y, x, z): a quarter turn around z. Links move with the cells they leave in the +
    // direction.
    const auto moved = [&](uvec3 c) { return uvec3(scene.last() - c.y, c.x, c.z); };
    const auto turned = [](const dvec4& c) { return dvec4(c.x, -c.z, c.y, c.w); };
    ArbitraryRoom other;
    for (std::uint32_t i = 0; i < 125; ++i) {
        const uvec3 cell(i % 5, i / 5 % 5, i / 25);
        const std::size_t to = scene.room.at(moved(cell));
        other.light[to] = turned(scene.light[i]);
        other.links.open[to].y = scene.links.open[i].x;
        other.links.open[to].z = scene.links.open[i].z;
        if (cell.y < scene.last()) other.links.open[scene.room.at(moved(cell + uvec3(0, 1, 0)))].x = scene.links.open[i].y;
    }
    expect_moved_light(scene, other, moved, turned);
}

TEST(PropagatedLight, IsMirroredWithTheScene) {
    const ArbitraryRoom scene;
    const auto moved = [&](uvec3 c) { return uvec3(scene.last() - c.x, c.y, c.z); };
    const auto mirrored = [](const dvec4& c) { return dvec4(c.x, -c.y, c.z, c.w); };
    ArbitraryRoom other;
    for (std::uint32_t i = 0; i < 125; ++i) {
        const uvec3 cell(i % 5, i / 5 % 5, i / 25);
        const std::size_t to = scene.room.at(moved(cell));
        other.light[to] = mirrored(scene.light[i]);
        other.links.open[to].y = scene.links.open[i].y;
        other.links.open[to].z = scene.links.open[i].z;
        if (cell.x < scene.last()) other.links.open[scene.room.at(moved(cell + uvec3(1, 0, 0)))].x = scene.links.open[i].x;
    }
    expect_moved_light(scene, other, moved, mirrored);
}

// T5.16
TEST(PropagatedLight, ScalesWithItsSource) {
    const ArbitraryRoom scene;
    Channel brighter = scene.light;
    for (dvec4& cell : brighter) cell *= 1024;
    for (const PropagationRule& rule : all_rules) {
        Channel sum = propagated(scene.links, scene.light, rule, 8);
        for (dvec4& cell : sum) cell *= 1024;
        EXPECT_EQ(propagated(scene.links, brighter, rule, 8), sum);
    }
}

// N11
TEST(PropagatedLight, DoesNotGrowBeyondWhatClampingAdds) {
    const Room room{uvec3(17)};
    const dvec3 directions[] = {{0, 0, 1}, glm::normalize(dvec3(1, 0, 1)), glm::normalize(dvec3(1, 1, 1))};
    constexpr double first_growth[] = {1.13820, 1.12259, 1.12583};
    for (const PropagationRule& rule : all_rules) {
        const double limit = rule.propagation == propagation_clamped ? 1.34 : 1 + 1e-4;
        for (std::size_t i = 0; i < 4; ++i) {
            // The last is the projection of a delta: its l1 is sqrt(3) of its l0.
            const dvec4 source = i < 3 ? cosine_lobe(directions[i]) : dvec4(1, 0, 0, std::sqrt(3.));
            Channel light = room.with(uvec3(8), source);
            for (int step = 0; step < 8; ++step) {
                light = next_step({room.cells}, light, rule);
                EXPECT_LE(held(light), source.x * limit) << "step " << step << " of source " << i;
                if (step > 0 || rule.propagation != propagation_clamped || rule.faces != faces_centre) continue;
                EXPECT_NEAR(held(light) / source.x, i < 3 ? first_growth[i] : 1.33669, 1e-5) << "of source " << i;
            }
        }
    }
}

}  // namespace
}  // namespace strata::indirect::in_double
