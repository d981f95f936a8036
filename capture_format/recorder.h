// What an application calls while its GPU pipeline runs: begin_frame, resources, draws, lights, end_frame. Streams to disk
// while frames go on; equal resources across frames are stored once; floats and images survive bit for bit.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata {

class Recorder {
public:
    static Result<Recorder> create(const std::filesystem::path&, std::string notes = {});
    Recorder(Recorder&&) noexcept;
    Recorder& operator=(Recorder&&) noexcept;
    ~Recorder();

    /// Starts a frame; everything until end_frame() belongs to it. Each add_ returns the index later calls refer to.
    void begin_frame(const View&, double time, std::uint64_t index, std::uint64_t seed);
    std::uint32_t add_texture(Texture);
    std::uint32_t add_mesh(Mesh);
    std::uint32_t add_material(Material);
    void draw(Draw);
    void emitter(Emitter);
    void light(Light);
    std::uint32_t add_blocker(Blocker);
    std::uint32_t add_portal(Portal);
    void environment(const Sun&, const Hemisphere&, const Fog&, glm::vec3 background);
    void light_volume(LightVolume);
    void weather(const Rain&);
    void camera(const Lens&, const Film&);
    void stage(StageChoice);
    /// Checks and writes the frame; what was written before survives a killed process. A frame that check_frame() refuses is
    /// left out and later ones may follow; after a failed write or calls out of order every call returns that error.
    Result<void> end_frame();

    /// A whole frame at once.
    Result<void> record(const Frame&);
    /// A small RGBA8 picture for file browsers.
    Result<void> thumbnail(const Texture&);
    /// Writes the directory. Without it the file still reads up to its last whole frame.
    Result<void> finish();

private:
    struct Writer;
    explicit Recorder(std::unique_ptr<Writer>);
    std::unique_ptr<Writer> writer_;
};

/// Appends what a replay is expected to give (text, as the replayer writes it) to a finished capture. Its id stays the same.
Result<void> append_expectation(const std::filesystem::path&, std::string_view expectation);

}  // namespace strata
