// Light volumes whose cells hold half floats (cell_storage=half), on the device: every number that is stored is the nearest half
// float to that of the model, what rounding takes of the light is bounded, and all that reads cells reads these as well.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passes/frame_images.h"
#include "passes/gbuffer/codes.h"
#include "passes/indirect/lpv/propagation/propagation_model.h"
#include "passes/registry.h"
#include "tests/5_techniques/kept_volumes.h"
#include "tests/5_techniques/light_volume_scenes.h"
#include "tests/support/agreement.h"
#include "tests/support/not_finite.h"
#include "tests/support/test_frame.h"

namespace strata::half_cells {
namespace {

using gbuffer::half_bits, gbuffer::half_value, gbuffer::nearest_half;
using indirect::GridPlace, indirect::in_double::Channel, indirect::in_double::PropagationRule;

constexpr glm::uvec3 room{6, 5, 7};
constexpr std::size_t room_cells = 6 * 5 * 7;

using Field = indirect::in_double::Field;

std::uint32_t two_halves(double low, double high) { return std::uint32_t{half_bits(low)} | std::uint32_t{half_bits(high)} << 16; }

void append_words(std::vector<std::uint32_t>& words, const glm::dvec4& light) {
    words.push_back(two_halves(light.x, light.y));
    words.push_back(two_halves(light.z, light.w));
}

std::vector<std::uint32_t> words_of(const Field& field) {
    std::vector<std::uint32_t> words;
    for (std::size_t cell = 0; cell < room_cells; ++cell)
        for (const Channel& channel : field) append_words(words, channel[cell]);
    return words;
}

Field field_of(const std::vector<std::uint32_t>& words, std::size_t first) {
    Field field;
    field.fill(Channel(room_cells));
    const auto half = [&](std::size_t i) { return half_value(static_cast<std::uint16_t>(words[first + i / 2] >> (i % 2 * 16))); };
    for (std::size_t cell = 0; cell < room_cells; ++cell)
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (glm::length_t c = 0; c < 4; ++c) field[channel][cell][c] = half(12 * cell + 4 * channel + std::size_t(c));
    return field;
}

/// Cells of any brightness, as halves: from below the least half float to above 8192, every ninth dark, lobes in any direction.
Field arbitrary_light(unsigned seed) {
    Numbers numbers(seed);
    Field field;
    for (Channel& channel : field)
        for (std::size_t cell = 0; cell < room_cells; ++cell) {
            const double l0 = cell % 9 == 0 ? 0 : std::exp2(double(numbers.from(-16, 13.5f)));
            const glm::dvec4 light = l0 * glm::dvec4(1, 2 / std::sqrt(3.) * glm::dvec3(numbers.direction()));
            glm::dvec4& stored = channel.emplace_back();
            for (glm::length_t i = 0; i < 4; ++i) stored[i] = nearest_half(light[i]);
        }
    return field;
}

struct Stepped {
    Field after, total;
};

/// A step on the device, of cells that hold halves.
Stepped step_on_device(const Field& before, const Field& total, const PropagationRule& rule) {
    TestFrame frame;
    const std::string shader = "indirect/lpv/propagation/propagate.comp";
    frame.library.add(*ShaderLibrary::built_in().find(shader));
    std::vector<std::uint32_t> total_words(indirect::unit_words);
    for (const std::uint32_t word : words_of(total)) total_words.push_back(word);
    const Buffer light = import_values(frame.graph, "before", ImportId{5}, words_of(before));
    Buffer sum = import_values(frame.graph, "total", ImportId{6}, total_words);
    Buffer after = frame.graph.create("after", room_cells * 24);
    frame.graph.clear(after, 0);
    frame.graph.compute(shader)
        .loads("Before", light)
        .loads("Links", light)
        .stores("After", after)
        .updates("Total", sum)
        .fixes("has_links", 0u)
        .fixes("propagation", rule.propagation)
        .fixes("faces", rule.faces)
        .fixes("cell_storage", indirect::storage_half)
        .push(GridPlace{.origin = glm::vec3(0), .cell = 1, .cells = room})
        .over({room.x, room.y, room.z});
    frame.graph.keep(after);
    frame.graph.keep(sum);
    const Execution run = frame.run();
    return {field_of(values_of<std::uint32_t>(run.buffers.at(after.id)), 0),
            field_of(values_of<std::uint32_t>(run.buffers.at(sum.id)), indirect::unit_words)};
}

/// Counts numbers that are stored, and how many are not the half that is nearest to the model's; the device rounds in float
/// before.
struct Stored {
    std::size_t all = 0, beside = 0;
    void expect_nearest(double stored, double model, double size) {
        const double rounded = 2e-6 * size;
        ++all;
        beside += stored != nearest_half(model);
        ASSERT_GE(stored, nearest_half(model - rounded)) << model;
        ASSERT_LE(stored, nearest_half(model + rounded)) << model;
    }
};

void expect_step(const Field& before, const Field& total, const PropagationRule& rule, Stored& stored) {
    const Stepped device = step_on_device(before, total, rule);
    const PropagationRule sending{
        rule.propagation == indirect::propagation_energy_true ? indirect::propagation_clamped : rule.propagation, rule.faces};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const Channel next = indirect::in_double::next_step({room}, before[channel], sending);
        const Channel sizes =
            indirect::in_double::next_step({room}, before[channel], {indirect::propagation_clamped, rule.faces});
        for (std::size_t cell = 0; cell < room_cells; ++cell) {
            const double share = sent_share(next[cell], rule), size = sizes[cell].x;
            for (glm::length_t i = 0; i < 4; ++i) {
                stored.expect_nearest(device.after[channel][cell][i], share * next[cell][i], size);
                const double sum = total[channel][cell][i] + next[cell][i] / 32;
                stored.expect_nearest(device.total[channel][cell][i], sum, size / 32 + std::abs(sum));
            }
        }
    }
}

TEST(HalfCells, StoreTheNearestHalfFloatAfterEveryStep) {
    Stored stored;
    for (const std::uint32_t propagation :
         {indirect::propagation_linear, indirect::propagation_clamped, indirect::propagation_energy_true})
        for (const std::uint32_t faces : {indirect::faces_centre, indirect::faces_exact})
            expect_step(arbitrary_light(propagation + 1), arbitrary_light(faces + 7), {propagation, faces}, stored);
    EXPECT_EQ(stored.all, 6 * room_cells * 24);
    // Where the model's number lies as near to the middle of two halves as floats are rounded.
    EXPECT_LT(double(stored.beside), 4e-3 * double(stored.all));
    RecordProperty("beside", std::to_string(stored.beside));
}

NumberTable energy_of(Session& session, std::size_t frame, std::vector<std::string> sets) {
    sets.emplace_back("cell_storage=half");
    Request request = indirect_of(frame, sets);
    request.outputs = {"indirect/lpv:energy"};
    return must(session.run(request)).tables.at("indirect/lpv:energy");
}

/// Of the light that is held, gained or lost in a step of halves at most. A number is rounded by 2^-11 of itself. What a cell
/// sends is a sum over thirty faces of radiances, each of l0 and of l1 along it: of the rounding of l1, which is 2 / sqrt(3) of
/// l0 at most and rounded along each axis, they add up to 1.47 times that of l0. Numbers below the least normal half float, 2^-14
/// of 4096, are wrong by half of it: l0 and three of l1, 3.2 in all, in each cell and channel.
double most_of_a_step(std::uint32_t cells) { return 2.47 * 0x1p-11 + 3.2 * 3 * cells * 0x1p-15 / 4096; }

TEST(HalfCells, LoseNoMoreLightThanRoundingMay) {
    std::vector<Frame> frames{two_rooms()[1], scenario_frames("cornell_box").front()};
    const auto session = session_of(frames);
    for (const std::size_t frame : {0u, 1u})
        for (const char* propagation : {"propagation=energy_true", "propagation=linear"}) {
            if (frame == 1 && propagation == std::string("propagation=linear")) continue;
            const NumberTable table = energy_of(*session, frame, {propagation, "iterations=64"});
            ASSERT_EQ(table.rows.size(), 65u);
            const glm::uvec3 cells = frames[frame].light_volumes[0].cells;
            const double injected = table.rows.front()[1], bound = most_of_a_step(cells.x * cells.y * cells.z);
            double measured = 0;
            for (const std::vector<double>& row : table.rows) {
                const double wrong = std::abs(row[1] + row[2] + row[3] - injected) / injected;
                EXPECT_LE(wrong, (row[0] + 1) * bound) << "step " << row[0];
                measured = std::max(measured, wrong);
                if (row[0] == 16 || row[0] == 64)
                    RecordProperty(
                        "frame_" + std::to_string(frame) + "_" + (propagation + 12) + "_" + std::to_string(int(row[0])),
                        std::to_string(1e6 * (row[1] + row[2] + row[3] - injected) / injected));
            }
            EXPECT_LT(measured, 3e-5) << "rounding to the nearest is even-handed; towards zero would lose some percent";
            EXPECT_GT(measured, 1e-7) << "halves";
        }
}

HostImage light_of(Session& session, std::size_t frame, const std::vector<std::string>& sets) {
    return must(session.run(indirect_of(frame, sets))).images.at("indirect");
}

/// RMS of the difference by that of the first.
double relative_difference(const HostImage& a, const HostImage& b) {
    double squares = 0, all = 0;
    for (std::uint32_t y = 0; y < a.shape.extent.height; ++y)
        for (std::uint32_t x = 0; x < a.shape.extent.width; ++x) {
            const glm::dvec3 one(texel(a, x, y)), difference = one - glm::dvec3(texel(b, x, y));
            squares += glm::dot(difference, difference), all += glm::dot(one, one);
        }
    return std::sqrt(squares / all);
}

Frame small_rooms() {
    Frame frame = two_rooms()[1];
    frame.view.width = 64, frame.view.height = 36;
    return frame;
}

TEST(HalfCells, AreWhatTheModelSaysWithTwoBouncesAndAllOcclusion) {
    const auto session = session_of({small_rooms()});
    for (const std::vector<std::string>& sets : {std::vector<std::string>{"cell_storage=half", "bounces=2", "occlusion=both"},
                                                 {"cell_storage=half", "propagation=linear", "damping=2"}}) {
        const Request request = indirect_of(0, sets);
        const Accuracy accuracy = must(session->judge(request, Stage::indirect, Against::model));
        expect_within_tolerance(accuracy, *must(find_technique("indirect/lpv")), request, "two_rooms");
        EXPECT_GE(accuracy.compared - accuracy.trivial, 500u);
    }
}

TEST(HalfCells, GiveAlmostTheLightOfFloats) {
    const auto session = session_of({small_rooms()});
    for (std::vector<std::string> sets : {std::vector<std::string>{}, {"iterations=64"}}) {
        const HostImage floats = light_of(*session, 0, sets);
        sets.emplace_back("cell_storage=half");
        const double difference = relative_difference(floats, light_of(*session, 0, sets));
        EXPECT_LT(difference, 2e-3) << testing::PrintToString(sets);
        EXPECT_GT(difference, 0);
        RecordProperty("difference_" + std::to_string(sets.size()), std::to_string(difference));
    }
}

TEST(HalfCells, AreKeptOverFramesLikeFloats) {
    std::vector<Frame> frames = kept_volumes::still_rooms();
    frames.push_back(frames[1]);
    frames.back().lights[0].intensity *= 1.5f;
    const auto session = session_of(frames);
    const std::string half = "cell_storage=half";
    std::vector<HostImage> wanted, floats;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        wanted.push_back(kept_volumes::lit(*session, i, {half}).indirect);
        floats.push_back(kept_volumes::lit_anew(*session, i));
    }
    for (const std::size_t i : {0u, 1u, 1u, 3u, 0u, 2u}) {
        EXPECT_TRUE(kept_volumes::kept(*session, i, {half}).indirect.texels == wanted[i].texels) << i;
        if (i != 1) continue;
        EXPECT_TRUE(kept_volumes::kept(*session, i).indirect.texels == floats[i].texels) << "nothing of halves is kept";
    }
    EXPECT_EQ(kept_volumes::kept(*session, 2, {half}).work(), kept_volumes::no_work);
    session->forget_memo();
    EXPECT_TRUE(kept_volumes::kept(*session, 1, {half, "slice=3"}).indirect.texels == wanted[1].texels);
    for (int i = 1; i <= 3; ++i)
        EXPECT_TRUE(kept_volumes::kept(*session, 3, {half, "slice=3"}).indirect.texels == wanted[i < 3 ? 1 : 3].texels) << i;
}

/// W that volumes hold in a frame after some steps.
double held_after(const NumberTable& table, std::size_t step) { return table.rows[step][1]; }

TEST(HalfCells, TakeLightOfAnyBrightness) {
    std::vector<Frame> frames(4, small_rooms());
    frames[1].lights[0].intensity = glm::vec3(1e30f);
    frames[2].lights[0].intensity = glm::vec3(1e-20f);
    frames[3].lights.push_back(frames[3].lights[0]);
    frames[3].lights[1].intensity = glm::vec3(NAN);
    const auto session = session_of(frames);
    const std::vector<std::string> sets{"iterations=8", "map_size=32"};
    const std::vector<std::string> twice{"bounces=2", "iterations=8", "map_size=32", "cell_storage=half"};
    const NumberTable usual = energy_of(*session, 0, sets);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const NumberTable table = energy_of(*session, i, sets);
        EXPECT_GT(held_after(table, 0), 0) << i;
        EXPECT_NEAR(held_after(table, 8) / held_after(table, 0) * held_after(usual, 0) / held_after(usual, 8), 1, 2e-3) << i;
        EXPECT_EQ(texel_that_is_no_number(light_of(*session, i, twice)), std::nullopt) << i;
    }
    EXPECT_GT(mean(rooms_of(frames[1], must(session->run(indirect_of(1, twice)))).lit), 1e3);
}

TEST(HalfCells, AreShownByViewsAsFloatsAre) {
    const auto session = session_of({small_rooms()});
    for (const std::string view : {"indirect/lpv:cells", "indirect/lpv:injected"}) {
        const auto picture = [&](const std::string& set) {
            Request request = indirect_of(0, {set, "iterations=8", "map_size=32"});
            request.outputs = {view};
            return must(session->run(request)).images.at(view);
        };
        const double difference = relative_difference(picture("cell_storage=float"), picture("cell_storage=half"));
        EXPECT_LT(difference, 1e-3) << view;
        EXPECT_GT(difference, 0) << view;
    }
}

}  // namespace
}  // namespace strata::half_cells
