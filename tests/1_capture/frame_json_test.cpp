// A frame as JSON says what the frame says, read by another library.
#include "capture_format/codec/frame_json.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "capture_format/enum_names.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/light_volume.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/texture.h"
#include "tests/1_capture/sample_frames.h"
#include "tests/support/errors.h"

namespace strata {
namespace {

nlohmann::json parsed(const Frame& frame) {
    const auto text = frame_json(frame);
    return text ? nlohmann::json::parse(*text, nullptr, false) : nlohmann::json();
}

TEST(FrameJson, HasEveryNumberToTheBit) {
    const Frame frame = rich_frame();
    const nlohmann::json json = parsed(frame);
    EXPECT_EQ(json["seed"].get<std::uint64_t>(), frame.seed);
    EXPECT_EQ(json["index"].get<std::uint64_t>(), frame.index);
    EXPECT_EQ(json["time_s"].get<double>(), frame.time);
    EXPECT_EQ(json["view"]["near_m"].get<float>(), frame.view.near);
    ASSERT_EQ(json["draws"].size(), frame.draws.size());
    const nlohmann::json& draw = json["draws"][1];
    EXPECT_EQ(draw["name"], "pane");
    EXPECT_EQ(draw["sort_priority"], -3);
    EXPECT_EQ(draw["to_world"]["columns"].get<std::vector<double>>(),
              (std::vector<double>{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 5, 1}));
    EXPECT_EQ(json["meshes"][0]["positions_m"]["bytes"], frame.meshes[0].positions.size() * sizeof(glm::vec3));
}

TEST(FrameJson, NamesValuesAsTheProgramDoes) {
    const Frame frame = rich_frame();
    const nlohmann::json json = parsed(frame);
    EXPECT_EQ(json["draws"][1]["mobility"], name(frame.draws[1].mobility));
    EXPECT_EQ(json["draws"][1]["resolution"], name(frame.draws[1].resolution));
    EXPECT_EQ(json["lights"][2]["type"], name(frame.lights[2].type));
    EXPECT_EQ(json["textures"][1]["format"], name(frame.textures[1].format));
    EXPECT_EQ(json["textures"][1]["address"], name(frame.textures[1].address));
    EXPECT_EQ(json["light_volumes"][0]["kind"], name(frame.light_volumes[0].kind));
    EXPECT_EQ(json["light_volumes"][0]["occlusion"], name(frame.light_volumes[0].occlusion));
    EXPECT_EQ(json["materials"][1]["alpha_mode"], name(frame.materials[1].alpha_mode));
}

TEST(FrameJson, IsRefusedWhereANameIsNoUtf8) {
    Frame frame = rich_frame();
    frame.draws[0].name = "\xff";
    EXPECT_THAT(frame_json(frame), FailsWith("capture.frame.name_utf8"));
}

}  // namespace
}  // namespace strata
