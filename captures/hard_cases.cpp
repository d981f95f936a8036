#include "captures/hard_cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/particles.h"
#include "captures/cards.h"

namespace strata {
namespace {

constexpr std::uint32_t extent = 8;
// Depth on [-1, 1], logarithmic from 1 to 50 m: the range every frame has, whatever else is in it.
constexpr double nearest = 1, farthest = 50;
double meters(double w) { return nearest * std::pow(farthest / nearest, .5 * (w + 1)); }

/// Fills the picture.
Card layer(double z, glm::vec3 color, float alpha, AlphaMode mode = AlphaMode::blend) {
    return {.center = {0, 0, z}, .half = float(1.5 * z), .color = glm::vec4(color, alpha), .alpha_mode = mode};
}
Card gray(double z, float color, float alpha) { return layer(z, glm::vec3(color), alpha); }

/// With two cards out of sight that pin the range of depth.
Frame frame_of(std::vector<Card> cards, glm::vec3 background = glm::vec3(0)) {
    for (const double z : {nearest, farthest}) {
        cards.push_back(gray(z, 1, .5f));
        cards.back().center.x = 1e4;
        cards.back().half = .1f;
    }
    Frame frame = frame_of_cards(cards, extent);
    frame.background = background;
    return frame;
}

/// Red in front of green in front of blue, all opaque.
std::vector<Frame> opaque_cards(double spacing) {
    return {
        frame_of({layer(meters(-spacing), {1, 0, 0}, 1), layer(meters(0), {0, 1, 0}, 1), layer(meters(spacing), {0, 0, 1}, 1)})};
}
std::vector<Frame> cards_far_apart() { return opaque_cards(.1); }
std::vector<Frame> cards_at_a_fiftieth() { return opaque_cards(.02); }
std::vector<Frame> cards_at_a_two_thousandth() { return opaque_cards(.0005); }

// A wavelet of rank 2, the default, has cells of 2/7 on [-1, 1]: each card is where one of its own begins.
std::vector<Frame> more_and_more_behind() {
    constexpr double cell = 2. / 7, front = -1 + cell;
    std::vector<Frame> frames;
    for (const int count : {1, 2, 3, 5, 6}) {
        std::vector<Card> cards{gray(meters(front), 1, .9f)};
        for (int i = 1; i < count; ++i) cards.push_back(gray(meters(front + cell * i), 0, .9f));
        frames.push_back(frame_of(cards));
    }
    return frames;
}

/// Drobot's harness: three cards that nothing passes, red, green and blue, while the eye moves over almost two cells of a
/// wavelet.
std::vector<Frame> three_cards_at_33_positions() {
    std::vector<Frame> frames;
    for (int step = 0; step < 33; ++step) {
        const double w = -.25 + .5 * step / 32;
        frames.push_back(frame_of(
            {layer(meters(w), {1, 0, 0}, 1), layer(meters(w + .02), {0, 1, 0}, 1), layer(meters(w + .04), {0, 0, 1}, 1)}));
    }
    return frames;
}

/// Two panes an eighth of an inch apart.
std::vector<Frame> back_to_back_glass() {
    std::vector<Frame> frames;
    for (const double z : {.508, 2.54, 10.16}) frames.push_back(frame_of({gray(z, 1, .5f), gray(z + .003175, 0, .5f)}));
    return frames;
}

std::vector<Frame> two_hundred_thin_layers() {
    std::vector<Card> cards;
    for (int i = 0; i < 200; ++i) {
        const int layer_index = (i * 77) % 200;  // in no order
        cards.push_back(layer(2 + layer_index * .1, {float(layer_index) / 199, 0, 0}, .01f));
    }
    return {frame_of(cards, {0, 1, 0})};
}

std::vector<Frame> with_and_without_alpha_zero() {
    const Card pane = gray(5, .7f, .5f), nothing = gray(3, .9f, 0);
    return {frame_of({pane}, glm::vec3(.3f)), frame_of({pane, nothing}, glm::vec3(.3f))};
}

std::vector<Frame> alpha_one_before_the_background() { return {frame_of({gray(5, .25f, 1)}, glm::vec3(1))}; }

std::vector<Frame> two_walls() { return {frame_of({layer(meters(-.25), {1, 0, 0}, 1), layer(meters(.25), {0, 1, 0}, 1)})}; }

std::vector<Frame> emission_alone() {
    std::vector<Card> cards;
    for (int i = 0; i < 10; ++i) cards.push_back(layer(3 + i, glm::vec3(.2f), 1, AlphaMode::additive));
    return {frame_of(cards, glm::vec3(.1f))};
}

std::vector<Frame> blinding_layers() {
    std::vector<Card> cards;
    for (int i = 0; i < 30; ++i) cards.push_back(gray(1.1 + .01 * i, 9000, .9f));
    return {frame_of(cards)};
}

std::vector<Frame> beyond_half_floats() {
    return {frame_of({gray(1000, 0, .5f), gray(32000, 1, .5f), gray(1e6, 0, .5f)}, glm::vec3(.5f))};
}

/// Every order of submission.
std::vector<Frame> coincident(std::vector<std::pair<float, float>> color_and_alpha) {
    std::ranges::sort(color_and_alpha);
    std::vector<Frame> frames;
    do {
        std::vector<Card> cards;
        for (const auto& [color, alpha] : color_and_alpha) cards.push_back(gray(5, color, alpha));
        frames.push_back(frame_of(cards));
    } while (std::ranges::next_permutation(color_and_alpha).found);
    return frames;
}
std::vector<Frame> three_coincident() { return coincident({{1, .5f}, {.5f, .5f}, {0, .5f}}); }
std::vector<Frame> two_unequal_coincident() { return coincident({{1, .9f}, {0, .1f}}); }

/// Nineteen good particles, and a bad one beside them in each frame after the first.
std::vector<Frame> one_bad_particle() {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    Emitter emitter{.name = "smoke"};
    // Not at 3.5 and 4 m: there the eye's rays meet the corners of cells that are powers of two of meters, and a hash of the cell
    // (hashed alpha) hangs on a float's last bit.
    for (int i = 0; i < 19; ++i)
        emitter.particles.push_back(
            {.center = {0, 0, 3.03 + .1 * i}, .size = 9, .color = glm::vec3(float(i) / 19), .alpha = .1f});
    const Particle bad[] = {{.center = {0, 0, 4}, .size = 9, .alpha = nan},
                            {.center = {0, 0, 4}, .size = 9, .color = glm::vec3(nan), .alpha = 0},
                            {.center = {0, 0, 4}, .size = 9, .alpha = -infinite},
                            {.center = {0, 0, 4}, .size = 9, .alpha = .5f, .depth_offset = nan},
                            {.center = {0, 0, 4}, .size = 9, .alpha = .5f, .depth_offset = infinite},
                            {.center = {0, 0, 4}, .size = 9, .alpha = .5f, .depth_offset = -infinite}};
    std::vector<Frame> frames(1 + std::size(bad), frame_of({}, glm::vec3(.2f)));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].emitters.push_back(emitter);
        if (i > 0) frames[i].emitters[0].particles.push_back(bad[i - 1]);
    }
    return frames;
}

std::vector<Frame> facade_far_away() {
    return {frame_of({gray(150, 1, .5f), gray(150.3, 0, .5f), layer(155, {1, 0, 0}, .95f), gray(152, .8f, .3f)}, glm::vec3(.5f))};
}

/// Three red cards at one depth, each half of what a byte of optical depth holds (T = 255^(-128/255), a code of 128), before a
/// green one: a byte that wraps shows it. Where the codes fall among the slices moves from frame to frame.
std::vector<Frame> more_than_a_byte_in_a_slice() {
    std::vector<Frame> frames;
    for (int step = 0; step < 8; ++step) {
        const double z = meters(.004 * step);
        frames.push_back(frame_of({layer(z, {1, 0, 0}, .9381f), layer(z, {1, 0, 0}, .9381f), layer(z, {1, 0, 0}, .9381f),
                                   layer(meters(.4), {0, 1, 0}, 1)}));
    }
    return frames;
}

/// Five panes at one depth that let no red through, and all green and blue: more red than 10 bits hold, which carries into green.
std::vector<Frame> more_red_than_ten_bits() {
    std::vector<Frame> frames;
    for (int step = 0; step < 8; ++step) {
        Card pane = layer(meters(.004 * step), {.02f, 0, 0}, 1);
        pane.transmission = {0, 1, 1};
        frames.push_back(frame_of({pane, pane, pane, pane, pane, layer(meters(.4), glm::vec3(.8f), 1)}));
    }
    return frames;
}

/// A black wall in the depth buffer.
std::vector<Frame> smoke_before_a_wall() {
    Card wall = gray(8, 0, 1);
    wall.alpha_mode = AlphaMode::opaque;
    return {frame_of({wall, gray(meters(0), 1, .1f)})};
}
std::vector<Frame> smoke_before_a_card() { return {frame_of({gray(meters(0), 1, .1f), gray(meters(.3), 0, 1)})}; }

std::vector<Frame> closer_and_closer() {
    std::vector<Frame> frames;
    for (const double gap : {0., .25, .5, 1., 2., 3.})
        for (int phase = 0; phase < 4; ++phase) {
            const double w = phase / 64.;
            frames.push_back(frame_of({gray(meters(w + gap / 64), 0, .5f), gray(meters(w), 1, .5f)}));
        }
    return frames;
}

std::vector<Frame> nothing_in_sight() {
    Card wall = gray(2, .6f, 1);
    wall.alpha_mode = AlphaMode::opaque;
    return {frame_of({wall, gray(5, 1, .5f)}), frame_of({}, glm::vec3(.4f))};
}

std::vector<Frame> one_layer_mid_range() { return {frame_of({gray(meters(0), .7f, .5f)}, glm::vec3(.2f))}; }

constexpr auto hard_case_table = std::to_array<HardCase>({
    {"H1a cards far apart", "of three opaque cards .1 apart in the logarithm of depth on [-1, 1], is only the first seen?",
     HardMeasure::error, .01, cards_far_apart},
    {"H1b cards close", "the same at .02", HardMeasure::error, .01, cards_at_a_fiftieth},
    {"H1c cards almost touching", "the same at .0005", HardMeasure::error, .02, cards_at_a_two_thousandth},
    {"H2 more behind",
     "does a card of .9 look the same with 0, 1, 2, 4 and 5 cards behind it, each in a wavelet's cell of its own?",
     HardMeasure::unsteadiness, 2e-3, more_and_more_behind},
    {"H3 moving eye", "of three opaque cards .02 apart, how small does the front card's share become at 33 positions of the eye?",
     HardMeasure::share, .01, three_cards_at_33_positions},
    {"H4 back-to-back glass", "which of two panes an eighth of an inch apart is in front, at .5, 2.5 and 10 m?",
     HardMeasure::error, .02, back_to_back_glass},
    {"H5 thin layers", "200 layers of .01 with a ramp of color: what is seen of them, and through them?", HardMeasure::error, .02,
     two_hundred_thin_layers},
    {"H6a alpha 0", "is a card of alpha 0 as good as none, bit by bit?", HardMeasure::change, 0, with_and_without_alpha_zero},
    {"H6b alpha 1", "does a card of alpha 1 hide the background?", HardMeasure::error, 1e-3, alpha_one_before_the_background},
    {"H6c two walls", "does a card of alpha 1 hide another, far behind?", HardMeasure::error, 1e-3, two_walls},
    {"H7 emission alone", "do ten layers of .2 without coverage add up to 2?", HardMeasure::error, .01, emission_alone},
    {"H8 blinding layers", "30 layers of radiance 9000: a number, and which?", HardMeasure::error, .02, blinding_layers},
    {"H9 far away", "layers at 1, 32 and 1000 km", HardMeasure::error, .02, beyond_half_floats},
    {"H10a equal depths", "three layers at one depth: the later in front, or the same in every order?", HardMeasure::tie, 2e-3,
     three_coincident},
    {"H10b unequal alphas", "the same of .9 and .1", HardMeasure::tie, 2e-3, two_unequal_coincident},
    {"H11 not a number", "does one bad particle among twenty change anything, bit by bit?", HardMeasure::change, 0,
     one_bad_particle},
    {"H12a overflow", "are three cards in one slice, of 1.5 times what a byte holds, as opaque as they should be?",
     HardMeasure::error, .02, more_than_a_byte_in_a_slice},
    {"H12b carry", "do five panes in one slice that let no red through keep green and blue as they should be?",
     HardMeasure::error, .03, more_red_than_ten_bits},
    {"H13 at 150 m", "panes .3 m apart, smoke and a car behind, all at 150 m", HardMeasure::error, .02, facade_far_away},
    {"H14a smoke before a wall", "smoke of .1 before a wall in the depth buffer", HardMeasure::error, 2e-3, smoke_before_a_wall},
    {"H14b smoke before a card", "smoke of .1 before a card of alpha 1", HardMeasure::error, .02, smoke_before_a_card},
    {"H15 closer and closer", "two layers of .5 from 3/64 to 0 apart: never more wrong than a tie, .125?", HardMeasure::error,
     .127, closer_and_closer},
    {"H16a nothing in sight", "is a frame whose layers are all hidden left alone?", HardMeasure::error, 1e-7, nothing_in_sight},
    {"H16b one layer mid-range", "one layer at the middle of the range, where a polynomial loses a degree", HardMeasure::error,
     2e-3, one_layer_mid_range},
});

}  // namespace

std::span<const HardCase> hard_cases() { return hard_case_table; }

}  // namespace strata
