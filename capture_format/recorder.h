// What an application calls while it renders. Resources are added once and updated when they change; a frame is what is
// submitted between begin_frame() and end_frame(). Checking, encoding, compressing and writing happen on the recorder's thread.
//
//   Threads    Every call may come from any thread. Within a frame the order is that of the calls; draws() keeps a batch
//              together. begin_frame() and end_frame() belong to one thread, or to several that wait for each other.
//   Memory     What was handed over and is not written yet never takes more than RecorderOptions::budget_bytes: calls wait
//              while there is no room (load().waited_s says how long in all). Writing takes up to three times the largest
//              resource and twelve times the largest frame on top. Resources that are written are not kept.
//   Files      A killed process (kill -9) loses at most what was not written yet; flush() waits until nothing is. The file then
//              opens with Partial::allowed, up to its last whole frame. A power cut may lose what the system had not written.
//   Errors     What goes wrong on the thread is returned by the next end_frame(), record(), flush() or finish(). A frame that
//              check_frame() refuses is left out and later ones follow. After a failed write, without memory, or after calls
//              out of order nothing more is written and every call returns that error; no call throws. A file that others
//              write to, cut, delete or move meanwhile is an error, at the latest of finish(); so is a second recorder on it.
//              A recorder that was moved from returns errors.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "capture_format/frame.h"
#include "capture_format/result.h"

namespace strata {

struct RecorderOptions {
    std::uint64_t budget_bytes = std::uint64_t{256} << 20;  ///< most that waits to be written; no frame or resource may be larger
};
/// What the recorder holds and what waiting for it has cost.
struct RecorderLoad {
    std::uint64_t held_bytes = 0, most_held_bytes = 0;  ///< handed over and not yet written; never above the budget
    double waited_s = 0;                                ///< how long the application's calls have waited for room
};

/// What Recorder::record() takes of its budget for a frame.
std::uint64_t recorded_bytes(const Frame&);

class Recorder {
public:
    /// A new file; `notes` is free text for whoever opens it. Fails when it cannot be written.
    static Result<Recorder> create(const std::filesystem::path&, std::string notes = {}, const RecorderOptions& = {});
    Recorder(Recorder&&) noexcept;
    Recorder& operator=(Recorder&&) noexcept;
    /// Writes the frames that are complete. Without finish() the file has no directory.
    ~Recorder();

    /// Resources belong to every frame that ends after the call. The index counts each kind from 0 and stays valid;
    /// textures and meshes take what frame.h says, are moved in, and are stored once however often equal ones come.
    std::uint32_t add_texture(Texture);
    std::uint32_t add_mesh(Mesh);
    std::uint32_t add_material(Material);
    void update_texture(std::uint32_t index, Texture);
    void update_mesh(std::uint32_t index, Mesh);
    void update_material(std::uint32_t index, Material);

    /// Starts a frame; time in seconds, index and seed are the application's own. All that is submitted until end_frame() is
    /// its content and must be submitted again for the next one; what is not set has frame.h's defaults.
    void begin_frame(const View&, double time, std::uint64_t index, std::uint64_t seed);
    void draw(Draw);
    void draws(std::span<const Draw>);
    void emitter(Emitter);
    void light(Light);
    /// The index is that of this frame's blockers or portals.
    std::uint32_t add_blocker(Blocker);
    std::uint32_t add_portal(Portal);
    void environment(const Sun&, const Hemisphere&, const Fog&, glm::vec3 background);
    void light_volume(LightVolume);
    void weather(const Rain&);
    void camera(const Lens&, const Film&);
    void stage(StageChoice);
    /// Hands the frame over.
    Result<void> end_frame();

    /// A whole frame with its own resources; those added do not belong to it.
    Result<void> record(Frame);
    /// A small RGBA8 picture for file browsers.
    Result<void> thumbnail(const Texture&);

    /// Waits until every frame handed over is in the file.
    Result<void> flush();
    /// How many frames can be read whatever happens to the process from here on.
    std::uint64_t frames_written() const;
    RecorderLoad load() const;
    /// Writes what is left and the directory, and ends the thread. The file is complete even when the error returned is about a
    /// frame that was left out.
    Result<void> finish();

private:
    struct Stream;
    explicit Recorder(std::unique_ptr<Stream>);
    std::unique_ptr<Stream> stream_;
};

/// Appends what a replay is expected to give (text, as the replayer writes it) to a finished capture. Its id stays the same.
Result<void> append_expectation(const std::filesystem::path&, std::string_view expectation);

}  // namespace strata
