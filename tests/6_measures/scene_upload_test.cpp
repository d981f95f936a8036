// A scene's buffers go to the device when they are not there as they are: what a frame shares with the one before is not sent
// again.
#include <gtest/gtest.h>

#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "captures/scenarios.h"
#include "passes/scene/scene_facts.h"
#include "replay/scene/device_scene.h"

namespace strata {
namespace {

/// Holds what is uploaded and counts it; runs nothing.
class CountingExecutor final : public Executor {
public:
    std::map<std::uint64_t, std::vector<std::byte>> held;
    std::size_t uploaded_bytes = 0;
    std::optional<std::uint64_t> failing;  ///< the import whose upload fails

    void upload(ImportId id, std::span<const std::byte> bytes) override {
        if (failing == id.key) throw DeviceFailure("test.no_memory", "no memory");
        held[id.key].assign(bytes.begin(), bytes.end());
        uploaded_bytes += bytes.size();
    }
    void forget(ImportId id) override { held.erase(id.key); }
    void create_image(ImportId, const Shape&) override {}
    Execution run(const Plan&, const RunOptions&) override { return {}; }
    std::size_t pipelines_created() const override { return 0; }
    DeviceMemory memory() const override { return {}; }
    std::uint64_t image_bytes(const Shape&) const override { return 0; }
    std::uint64_t buffer_bytes(std::uint64_t bytes) const override { return bytes; }
    void forget_plan() override {}
    void give_back_memory() override {}
};

class SceneUpload : public testing::Test {
protected:
    SceneUpload() {
        frame.lights.clear();  // shadows are laid around what casts them
        upload(frame);
    }
    /// Bytes that went to the device.
    std::size_t upload(const Frame& shown) {
        executor.uploaded_bytes = 0;
        scene.upload(scene_records(SceneFacts(shown)));
        return executor.uploaded_bytes;
    }
    std::map<std::uint64_t, std::vector<std::byte>> held_alone(const Frame& shown) {
        CountingExecutor other;
        DeviceScene(other).upload(scene_records(SceneFacts(shown)));
        return other.held;
    }

    Frame frame = (*find_scenario("glass_and_smoke"))->build(0, {.width = 32, .height = 18});
    CountingExecutor executor;
    DeviceScene scene{executor};
};

TEST_F(SceneUpload, OfAnObjectThatMovesOnlyTheRecordsOfDrawsAreUploadedAgain) {
    Frame moved = frame;
    moved.draws.front().to_world[3].x += 1e-3;
    EXPECT_EQ(upload(moved), (frame.draws.size() + frame.emitters.size()) * sizeof(DrawRecord));
    EXPECT_EQ(executor.held, held_alone(moved));
    EXPECT_EQ(upload(moved), 0u);
}

TEST_F(SceneUpload, AMeshThatChangesIsUploadedAgain) {
    Frame bent = frame;
    Mesh& mesh = bent.meshes[bent.draws.front().mesh];
    std::swap(mesh.normals.front(), mesh.normals.back());
    ASSERT_NE(mesh.normals.front(), mesh.normals.back());
    std::size_t normals = 0;
    for (const Mesh& each : bent.meshes) normals += each.normals.size();
    EXPECT_EQ(upload(bent), normals * sizeof(glm::vec3));
    EXPECT_EQ(executor.held, held_alone(bent));
}

TEST_F(SceneUpload, WhatWasForgottenIsUploadedAgain) {
    scene.forget();
    EXPECT_TRUE(executor.held.empty());
    upload(frame);
    EXPECT_EQ(executor.held, held_alone(frame));
}

TEST_F(SceneUpload, WhatFailedToReachTheDeviceIsUploadedAgain) {
    Frame moved = frame;
    moved.draws.front().to_world[3].x += 1e-3;
    executor.failing = 3;  // the records of draws
    EXPECT_THROW(upload(moved), DeviceFailure);
    executor.held.erase(3);  // what a device does that has no room
    executor.failing.reset();
    upload(frame);
    EXPECT_EQ(executor.held, held_alone(frame));
}

}  // namespace
}  // namespace strata
