// Which texels of a shadow map masked casters fill, by the parameter caster_mask: what docs/algorithms/deferred.md 4.4 says of
// far textures (T-AT-1), what the model says of a fence and of foliage, and how much of a fence's shadow is left far away.
#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/texture.h"
#include "captures/cards.h"
#include "passes/frame_images.h"
#include "passes/gbuffer/coverage/coverage.shared.h"
#include "passes/reference/textures.h"
#include "passes/scene/shadow_views.h"
#include "passes/shadows/cast_model.h"
#include "replay/images/host_image.h"
#include "tests/support/chessboard.h"
#include "tests/support/session.h"

namespace strata::shadow_casters {
namespace {

/// A value of caster_mask, and the mode of the G-buffer that a model of it is.
struct Mode {
    const char* name;
    std::uint32_t of_gbuffer;
};
constexpr std::array modes{Mode{"clip", gbuffer::masked_clip}, Mode{"mip_coverage", gbuffer::masked_mip_coverage},
                           Mode{"dither", gbuffer::masked_dithered}};

Request maps_by(const Mode& mode, const char* allocation = "own") {
    return {
        .choices = chosen({"shadows/pcf"}, {fmt::format("caster_mask={}", mode.name), fmt::format("allocation={}", allocation)}),
        .outputs = {"shadow_maps"}};
}

/// Whole maps of all casters, not only what lookups read.
ReferenceImage maps_of(Session& session, Request request) {
    request.variant.force.assign(all_features().begin(), all_features().end());
    return in_double(must(session.run(request)).images.at("shadow_maps"));
}

/// Texels of a view that hold a caster.
std::size_t texels_filled(const ReferenceImage& maps, const ShadowView& view) {
    std::size_t filled = 0;
    for (std::uint32_t y = 0; y < view.size; ++y)
        for (std::uint32_t x = 0; x < view.size; ++x) filled += maps.at(view.offset.x + x, view.offset.y + y, view.layer).x > 0;
    return filled;
}

std::size_t texels_filled(Session& session, const Request& request, std::size_t view = 0) {
    const Frame frame = must(session.frame(request.variant.frame));
    return texels_filled(maps_of(session, request), shadow_views(frame)[view]);
}

/// A card of 42 texels across before the sun, with a chessboard on it.
Frame far_chessboard(AlphaMode mode, float cutoff = .5f) {
    Frame frame = frame_of_cards(std::vector<Card>{{.center = {0, 0, 2}, .half = 1, .alpha_mode = mode}}, 32);
    paint_chessboard(frame, cutoff);
    frame.sun.direction = {0, 0, 1};
    frame.sun.irradiance = {1, 1, 1};
    frame.sun.cascades = 1;
    frame.sun.shadow_distance = 4;
    frame.sun.shadow = {.casts = true, .map_size = 256};
    return frame;
}

TEST(CasterMasks, OfAFarChessboardVanishOrGrowSolidByTheCutoffStayByMipAndAreHalfByDither) {
    const auto session = session_of(
        {far_chessboard(AlphaMode::opaque), far_chessboard(AlphaMode::mask, 200.f / 255), far_chessboard(AlphaMode::mask, .5f)});
    const auto area = [&](const Mode& mode, std::size_t frame) {
        Request request = maps_by(mode);
        request.variant.frame = frame;
        return double(texels_filled(*session, request));
    };
    const double solid = area(modes[0], 0);
    EXPECT_GT(solid, 1000);
    const double wanted[3][2] = {{0, 1}, {1, 1}, {.5, .5}};  // with a cutoff of 200 / 255, and of .5
    for (std::size_t m = 0; m < modes.size(); ++m)
        for (std::size_t cutoff = 0; cutoff < 2; ++cutoff) {
            // A dither of 4 texels is half full but for what the card's sides cut off: half a texel of each row's four or so.
            const double share = area(modes[m], 1 + cutoff) / solid;
            if (wanted[m][cutoff] == .5) EXPECT_NEAR(share, .5, 2 / std::sqrt(solid)) << modes[m].name;
            else EXPECT_EQ(share, wanted[m][cutoff]) << modes[m].name;
        }
}

/// Three cascades and a spot, of 128 texels. The picture has four samples per pixel, the maps have one per texel.
Frame fence_and_spot() {
    Frame frame = scenario_frames("fence_and_foliage", 4).front();
    frame.sun.shadow.map_size = 128;
    frame.lights.push_back({.type = LightType::round_spot,
                            .position = {0.5, 3, -2},
                            .direction = {0, -0.8f, -0.6f},
                            .axis_u = {1, 0, 0},
                            .range = 12,
                            .outer_angle = 0.9f,
                            .shadow = {.casts = true, .map_size = 128}});
    return frame;
}

struct Compared {
    std::size_t texels = 0, decided = 0, differing = 0;
};

Compared compare(const Frame& frame, const ReferenceImage& maps, const Mode& mode, Allocation allocation) {
    Compared all;
    for (const ShadowView& view : shadow_views(frame, allocation)) {
        const ReferenceImage model = shadows::cast_model(
            frame, {.view_to_map = view.view_to_map, .size = view.size, .offset = view.offset}, mode.of_gbuffer);
        for (std::uint32_t y = 0; y < view.size; ++y)
            for (std::uint32_t x = 0; x < view.size; ++x) {
                const std::size_t i = model.index(x, y);
                ++all.texels;
                if (model.undecided[i]) continue;
                ++all.decided;
                const double got = maps.at(view.offset.x + x, view.offset.y + y, view.layer).x;
                all.differing += std::abs(got - model.texels[i].x) > model.texels[i].y;
            }
    }
    return all;
}

void expect_agreement(Session& session, const Frame& frame, const Mode& mode, Allocation allocation) {
    const ReferenceImage maps = maps_of(session, maps_by(mode, allocation == Allocation::need ? "need" : "own"));
    const Compared found = compare(frame, maps, mode, allocation);
    testing::Test::RecordProperty(fmt::format("{} {}", mode.name, allocation == Allocation::need ? "need" : "own"),
                                  fmt::format("{} texels, {} decided, {} differ", found.texels, found.decided, found.differing));
    EXPECT_EQ(found.differing, 0u) << mode.name << " of " << found.decided;
    EXPECT_GT(double(found.decided), .9 * double(found.texels)) << mode.name;
}

TEST(CasterMasks, AreInEveryTexelWhatTheModelSays) {
    const Frame frame = fence_and_spot();
    const auto session = session_of({frame});
    for (const Mode& mode : modes) expect_agreement(*session, frame, mode, Allocation::own);
    // Packed maps: a dither counts texels of the layer.
    expect_agreement(*session, frame, modes[2], Allocation::need);
}

TEST(CasterMasks, FillOtherTexelsByEachMode) {
    const auto session = session_of({fence_and_spot()});
    const ReferenceImage clipped = maps_of(*session, maps_by(modes[0]));
    for (std::size_t m = 1; m < modes.size(); ++m) {
        const ReferenceImage maps = maps_of(*session, maps_by(modes[m]));
        std::size_t others = 0;
        for (std::size_t i = 0; i < maps.texels.size(); ++i) others += maps.texels[i].x != clipped.texels[i].x;
        EXPECT_GT(others, 500u) << modes[m].name;
    }
}

TEST(CasterMasks, CostNothingInFramesWithoutMaskedSurfaces) {
    const auto session = scenario_session("sun_and_boxes");
    const auto steps = [&](const Mode& mode) {
        std::string described;
        for (const PlannedStep& planned : must(session->plan(maps_by(mode))).plan.steps) {
            described += planned.step.name;
            for (const Fixed& fixed : planned.step.fixed)
                described += fmt::format(" {}={}", fixed.name, std::visit([](auto value) { return double(value); }, fixed.value));
        }
        return described;
    };
    for (const Mode& mode : modes) EXPECT_EQ(steps(mode), steps(modes[0])) << mode.name;
}

/// The panels of the fence that runs away from the eye, each alone; `mode` of their material.
std::vector<Frame> panels_alone(std::span<const std::size_t> numbers, AlphaMode mode) {
    const Frame whole = scenario_frames("fence_and_foliage").front();
    std::vector<Draw> panels;
    for (const Draw& draw : whole.draws)
        if (whole.materials[draw.material].name == "chain link") panels.push_back(draw);
    std::vector<Frame> frames;
    for (const std::size_t number : numbers) {
        Frame& frame = frames.emplace_back(whole);
        frame.draws = {panels[number]};
        frame.materials[panels[number].material].alpha_mode = mode;
    }
    return frames;
}

/// The share of its texture's finest texels that a fence has.
double true_share(const Frame& frame) {
    const Material& material = frame.materials[frame.draws.front().material];
    const Texture& texture = frame.textures[material.base_color_texture.texture];
    double kept = 0;
    for (std::uint32_t y = 0; y < texture.height; ++y)
        for (std::uint32_t x = 0; x < texture.width; ++x) kept += texel(texture, 0, x, y).w >= double(material.mask_cutoff);
    return kept / (double(texture.width) * texture.height);
}

/// The cascade that shades what stands where the frame's only draw does.
std::size_t cascade_of(const Frame& frame, double depth) {
    const std::vector<ShadowView> views = shadow_views(frame);
    std::size_t slot = 0;
    while (slot + 1 < views.size() && depth >= views[slot].range_end) ++slot;
    return slot;
}

TEST(CasterMasks, KeepAFencesShadowFarAway) {
    constexpr std::array<std::size_t, 4> numbers{0, 2, 5, 18};
    std::vector<Frame> frames = panels_alone(numbers, AlphaMode::mask);
    const std::vector<Frame> solid = panels_alone(numbers, AlphaMode::opaque);
    frames.insert(frames.end(), solid.begin(), solid.end());
    const auto session = session_of(frames);
    for (std::size_t panel = 0; panel < numbers.size(); ++panel) {
        const Frame& frame = frames[panel];
        const glm::dvec3 center = frame.draws.front().to_world[3];
        const double depth = (frame.view.to_view * (center - frame.view.origin)).z;
        const std::size_t cascade = cascade_of(frame, depth);
        const auto filled = [&](const Mode& mode, std::size_t number) {
            Request request = maps_by(mode);
            request.variant.frame = number;
            return double(texels_filled(*session, request, cascade));
        };
        const double wanted = true_share(frame) * filled(modes[0], numbers.size() + panel);
        std::string text = fmt::format("{:.0f} m, {:.0f} mm texels, true {:.0f} texels:", depth,
                                       1000 * shadow_views(frame)[cascade].texel, wanted);
        std::array<double, modes.size()> lost{};
        for (std::size_t m = 0; m < modes.size(); ++m) {
            lost[m] = 100 * (1 - filled(modes[m], panel) / wanted);
            text += fmt::format(" {} {:.1f} % lost", modes[m].name, lost[m]);
        }
        RecordProperty(fmt::format("panel {}", numbers[panel]), text);
        EXPECT_EQ(lost[0], 100) << text;
        // A dither keeps alpha's mean, which is not quite the share above the cutoff; far away there are 13 texels.
        EXPECT_LT(std::abs(lost[2]), wanted > 100 ? 15 : 30) << text;
    }
}

}  // namespace
}  // namespace strata::shadow_casters
