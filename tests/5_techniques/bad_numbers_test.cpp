// NaN and infinity of one particle reach nobody else's pixels (docs/algorithms/transparency.md 0.2), and the check can fail:
// without the sanitizing function of the shaders they do.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "capture_format/frame/frame.h"
#include "capture_format/frame/particles.h"
#include "passes/graph/graph.h"
#include "passes/registry.h"
#include "passes/scene/scene_facts.h"
#include "passes/stages.h"
#include "passes/technique.h"
#include "replay/images/image_io.h"
#include "replay/scene/device_scene.h"
#include "replay/session/frame_plan.h"
#include "tests/support/device.h"
#include "tests/support/every_nth.h"
#include "tests/support/file_text.h"
#include "tests/support/glsl.h"
#include "tests/support/not_finite.h"
#include "tests/support/session.h"

namespace strata {
namespace {

Frame bad_frame() { return scenario_frames("nan_particles").front(); }

void zero_unless_finite(float& value) { value = std::isfinite(value) ? value : 0; }

/// What docs/algorithms/transparency.md 0.2 makes of bad numbers, made beforehand: no coverage where alpha is none, no light in a
/// channel that is none.
Frame without_bad_numbers() {
    Frame frame = bad_frame();
    for (Emitter& emitter : frame.emitters) {
        for (Particle& particle : emitter.particles) {
            // Not erased: a technique may draw lots by a particle's place in the frame.
            particle.alpha = std::isfinite(particle.alpha) && particle.alpha > 0 ? particle.alpha : 0;
            for (int c = 0; c < 3; ++c) {
                zero_unless_finite(particle.color[c]);
                zero_unless_finite(particle.emissive[c]);
            }
        }
    }
    return frame;
}

/// Bad particles made good ones: a picture that sanitizing must not give.
Frame with_good_numbers() {
    Frame frame = bad_frame();
    for (Emitter& emitter : frame.emitters)
        for (Particle& particle : emitter.particles) {
            particle.alpha = std::isfinite(particle.alpha) ? std::abs(particle.alpha) : .6f;
            for (int c = 0; c < 3; ++c) {
                if (!std::isfinite(particle.color[c])) particle.color[c] = .5f;
                zero_unless_finite(particle.emissive[c]);
            }
        }
    return frame;
}

TEST(BadNumbers, LeaveEveryPictureAsItIsWithoutThem) {
    const auto session = session_of({bad_frame(), without_bad_numbers(), with_good_numbers()});
    for (const Technique& technique : techniques()) {
        const std::vector<std::string> uses{std::string(technique.name)};
        const auto pictures = [&](std::size_t frame) {
            return must(session->run({.variant = {.frame = frame}, .choices = chosen(uses), .outputs = {"color", "display"}}))
                .images;
        };
        const auto bad = pictures(0), clean = pictures(1), good = pictures(2);
        for (const auto& [name, image] : bad) {
            EXPECT_EQ(texel_that_is_no_number(image), std::nullopt) << technique.name << " " << name;
            EXPECT_EQ(hash_of(image), hash_of(clean.at(name))) << technique.name << " " << name;
            EXPECT_NE(hash_of(image), hash_of(good.at(name))) << "the particles do not show; the comparison proves nothing";
        }
    }
}

/// The source with its includes in place, and without its #version: glsl() writes one.
std::string with_includes(const std::filesystem::path& path) {
    std::istringstream source(file_text(path));
    std::string text, line;
    while (std::getline(source, line)) {
        if (line.starts_with("#include \""))
            line = with_includes(std::filesystem::path(STRATA_SOURCE_DIR) / line.substr(10, line.rfind('"') - 10));
        if (!line.starts_with("#version")) text += line + '\n';
    }
    return text;
}

/// The built-in shaders; those that the techniques use of their stage take every number for a finite one.
ShaderLibrary without_sanitizing(const std::vector<const Technique*>& techniques) {
    constexpr std::string_view check = "return (floatBitsToUint(x) & 0x7fffffffu) < 0x7f800000u;", pass = "return true;";
    const auto is_of_another = [&](std::string_view shader) {
        return std::ranges::any_of(techniques_of(Stage::transparency), [&](const Technique* t) {
            return shader.starts_with(std::string(t->name) + '/') && !std::ranges::count(techniques, t);
        });
    };
    ShaderLibrary library;
    for (const std::string& name : ShaderLibrary::built_in().names()) {
        const bool is_used = name.starts_with("transparency/") && !is_of_another(name);
        std::string source = is_used ? with_includes(STRATA_SOURCE_DIR "/passes/" + name) : "";
        if (const std::size_t at = source.find(check); at != std::string::npos)
            library.add(glsl(name, source.replace(at, check.size(), pass)));
        else library.add(*ShaderLibrary::built_in().find(name));
    }
    return library;
}

HostImage color_of(const Frame& frame, const Technique& technique, const ShaderLibrary& library) {
    DeviceScene scene(shared_executor());
    const SceneFacts facts(frame);
    scene.upload(scene_records(facts));
    const Features features = frame_features(frame);
    Graph graph;
    FrameImages images{
        .recorded = &frame, .features = &features, .facts = &facts, .extent = {frame.view.width, frame.view.height, 1}};
    scene.import_into(graph, images);
    const std::vector<std::string> uses{std::string(technique.name)};
    const auto declared =
        must(declare_frame(graph, images, must(choose(frame, chosen(uses))), shared_device().info().capabilities));
    EXPECT_FALSE(declared.passes.empty());
    graph.keep(images.color);
    return shared_executor().run(must(compile(graph, library)), {}).images.at(images.color.id);
}

void expect_seen_without_sanitizing(const std::vector<const Technique*>& techniques) {
    const ShaderLibrary careless = without_sanitizing(techniques);
    std::size_t no_numbers = 0;
    for (const Technique* technique : techniques) {
        const HostImage sanitized = color_of(bad_frame(), *technique, ShaderLibrary::built_in());
        const HostImage raw = color_of(bad_frame(), *technique, careless);
        EXPECT_EQ(texel_that_is_no_number(sanitized), std::nullopt) << technique->name;
        EXPECT_NE(hash_of(raw), hash_of(sanitized)) << technique->name;
        no_numbers += texel_that_is_no_number(raw) ? 1 : 0;
    }
    EXPECT_GT(no_numbers, 0u);  // not of all: a clamp on the way makes them numbers, and wrong ones
}

// A shader takes half a second to compile.
TEST(BadNumbers, AreSeenWhereShadersDoNotSanitize) {
    expect_seen_without_sanitizing(every_nth(6, techniques_of(Stage::transparency)));
}

TEST(BadNumbers, ExhaustiveAreSeenWhereShadersDoNotSanitize) {
    const auto all = techniques_of(Stage::transparency);
    expect_seen_without_sanitizing({all.begin(), all.end()});
}

}  // namespace
}  // namespace strata
