// What light volumes give at a place, from cells whose light is known.
#include "passes/indirect/volume_light.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "passes/image_set.h"
#include "passes/indirect/light_grid.shared.h"
#include "passes/stage_input.h"

namespace strata::indirect {
namespace {

using std::numbers::pi;

/// One grid of cells alike, from (-cell, -cell, -cell) times half their number.
struct Uniform {
    std::uint32_t cells = 8;
    double cell = .5, border = .5;
    std::uint32_t rule = irradiance_cell;
    glm::dvec4 light{1, 0, 0, 0};
};

ImageSet image_of(const Uniform& wanted) {
    const std::uint32_t count = wanted.cells * wanted.cells * wanted.cells;
    ReferenceImage image(volume_texels_per_row,
                         (3 * (count + records_per_grid) + volume_texels_per_row - 1) / volume_texels_per_row);
    const double low = -wanted.cell * wanted.cells / 2;
    image.texels[0] = {low, low, low, wanted.cell};
    image.texels[1] = glm::dvec4(glm::dvec3(wanted.cells), wanted.border);
    image.texels[2] = {0, wanted.rule, 1, 0};
    image.texels[3] = {.5, 0, 0, 0};  // read half a cell before surfaces, whichever way sources face
    for (std::uint32_t i = 3 * records_per_grid; i < 3 * (count + records_per_grid); ++i) image.texels[i] = wanted.light;
    return {{"volume_light", image}};
}

/// Mean radiance of the second channel where there is no normal.
double around(const Uniform& wanted, const glm::dvec3& position = glm::dvec3(0)) {
    const ImageSet before = image_of(wanted);
    return volume_light(Frame{}, before)(position, glm::dvec3(0)).y;
}

// l0 = 1 is 2 sqrt(pi) W through a cell, from everywhere. What crosses a mean section of 1.5 cell^2 is 4 pi L.
TEST(VolumeLight, OfAnEvenCellIsItsFluxByTheMeanSectionAndAllDirections) {
    EXPECT_NEAR(around({.cell = .5}), 2 * std::sqrt(pi) / (1.5 * .5 * .5) / (4 * pi), 1e-12);
    EXPECT_NEAR(around({.cell = 2}), 1 / (3 * std::sqrt(pi) * 4), 1e-12);
}

TEST(VolumeLight, OfAFaceIsSixOverPiTimesAsMuchFromEverywhere) {
    EXPECT_NEAR(around({.rule = irradiance_face}) / around({.rule = irradiance_cell}), 6 / pi, 1e-12);
}

TEST(VolumeLight, OfAllDirectionsIsTheMeanOfWhatPlanesTakeOfLightThatNoneTakesBackwards) {
    const Uniform leaning{.light = {1, .3, -.2, .1}};
    const ImageSet before = image_of(leaning);
    const LightAround light = volume_light(Frame{}, before);
    glm::dvec3 sum(0);
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1., 1.}) {
            glm::dvec3 normal(0);
            normal[axis] = sign;
            sum += light(glm::dvec3(0), normal);
        }
    EXPECT_NEAR(sum.y / 6, around(leaning), 1e-12);
}

TEST(VolumeLight, FadesOverTheBorderToNothing) {
    EXPECT_NEAR(around({}, {1.75, 0, 0}), around({}) / 2, 1e-12);
    EXPECT_EQ(around({}, {2, 0, 0}), 0);
    EXPECT_EQ(around({}, {0, 0, 5}), 0);
}

TEST(VolumeLight, IsNoneWhereNoVolumeIsHandedOn) { EXPECT_FALSE(volume_light(Frame{}, {})); }

}  // namespace
}  // namespace strata::indirect
