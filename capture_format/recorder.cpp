// Two sides with a queue between them: the application's calls fill a frame under a mutex and hand it over; the thread takes what
// comes out and gives it to the FrameWriter.
#include "capture_format/recorder.h"

#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "capture_format/codec/frame_writer.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/out_of_memory.h"
#include "capture_format/recorded_bytes.h"
#include "capture_format/recording_queue.h"

namespace strata {
namespace {

/// The exception that is being handled, as what a call returns: an application must not end because it is recorded.
Error caught(std::string_view file) noexcept {
    return within_memory("record", file, [&]() -> Error {
        try {
            throw;
        } catch (const std::system_error& refused) {
            return no_thread(refused);
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& mistake) {
            return fail(Fault::internal, "record.mistake", "{file} cannot be recorded, which is a mistake of strata: {reason}",
                        file, mistake.what());
        }
    });
}

}  // namespace

struct Recorder::Stream {
    Stream(FrameWriter opened, std::uint64_t budget) : writer(std::move(opened)), queue(budget) {
        thread = std::thread([this] { work(); });
    }
    ~Stream() { stop(); }

    // The thread's side.
    void work();
    Result<void> write(Put<Texture>& put) { return writer.put(put.index, put.resource); }
    Result<void> write(Put<Mesh>& put) { return writer.put(put.index, put.resource); }
    Result<void> write(Put<Material>& put) { return writer.put(put.index, put.resource); }
    Result<void> write(SubmittedFrame&);
    Result<void> write(WholeFrame&);
    Result<void> write(EncodedThumbnail&);
    void keep(Error);  ///< for report()

    // The application's side.
    /// Makes a call of the application, under the mutex. Where it throws, what follows would be wrong. A call that returns no
    /// Result leaves its error to the next one that does.
    template <typename Call>
    static std::invoke_result_t<Call, Stream&> run(const std::unique_ptr<Stream>&, const Call&);
    void stop();
    /// The first error of the thread that was not returned yet; a broken writer's every time.
    Result<void> report();
    Error misused(Error);
    /// What makes any further recording wrong.
    Result<void> usable() const;
    template <typename T>
    std::uint32_t add(std::uint32_t& count, T, std::string_view call);
    template <typename T>
    void update(std::uint32_t count, std::uint32_t index, T, std::string_view call);
    /// The label of what takes more than the budget; nothing else is ever named.
    template <typename... Of>
    std::string name_if_too_large(std::uint64_t bytes, const Of&... of) const {
        return bytes > queue.budget() ? label(of...) : std::string();
    }
    /// Calls fill(frame), which says how many bytes it added, when a frame has begun.
    template <typename Fill>
    void submit(std::string_view call, const Fill& fill);
    template <typename T>
    std::uint32_t append(std::string_view call, std::vector<T> Frame::*list, T value);

    FrameWriter writer;
    RecordingQueue queue;
    std::atomic<std::uint64_t> written = 0;

    std::mutex reporting;
    std::optional<Error> unreported;
    bool broken = false;

    mutable std::mutex calls;  ///< what follows
    std::unique_ptr<Frame> frame;
    std::uint64_t frame_bytes = 0, frames = 0;
    std::uint32_t textures = 0, meshes = 0, materials = 0;
    bool finished = false;
    std::optional<Error> misuse;

    std::thread thread;
};

void Recorder::Stream::work() {
    // Waking up must not push the application's thread from its core: on a busy machine that cost it 4 ms a frame. Where the
    // system refuses, it is only slower.
    const sched_param no_priority{};
    (void)pthread_setschedparam(pthread_self(), SCHED_BATCH, &no_priority);
    while (std::optional<Recorded> item = queue.pop()) {
        if (writer.broken()) continue;  // a resource may be missing that what follows builds on
        try {
            const Result<void> done = std::visit([this](auto& recorded) { return write(recorded); }, *item);
            if (!done) keep(Error(done.error()));
        } catch (const std::exception&) {
            writer.give_up(caught(writer.path()));
            keep(caught(writer.path()));
        }
    }
}

void Recorder::Stream::keep(Error error) {
    const std::lock_guard lock(reporting);
    broken = writer.broken().has_value();
    if (!unreported || broken) unreported = std::move(error);
}

Result<void> Recorder::Stream::write(SubmittedFrame& submitted) {
    const Result<void> done = writer.write(*submitted.frame, submitted.number);
    if (done) ++written;
    queue.give_back(std::move(submitted.frame));
    return done;
}

Result<void> Recorder::Stream::write(WholeFrame& whole) {
    const Result<void> done = writer.write_whole(*whole.frame, whole.number);
    if (done) ++written;
    return done;
}

Result<void> Recorder::Stream::write(EncodedThumbnail& picture) {
    return writer.add({SectionType::thumbnail, picture_version, picture.bytes, picture.texel_bytes});
}

void Recorder::Stream::stop() {
    queue.close();
    if (thread.joinable()) thread.join();
}

Result<void> Recorder::Stream::report() {
    const std::lock_guard lock(reporting);
    if (!unreported) return {};
    return broken ? *unreported : *std::exchange(unreported, std::nullopt);
}

Error Recorder::Stream::misused(Error error) {
    if (!misuse) misuse = std::move(error);
    return *misuse;
}

Result<void> Recorder::Stream::usable() const {
    if (misuse) return *misuse;
    if (finished)
        return fail(Fault::usage, "record.finished", "{file} is finished; nothing more can be recorded into it", writer.path());
    return {};
}

template <typename Call>
std::invoke_result_t<Call, Recorder::Stream&> Recorder::Stream::run(const std::unique_ptr<Stream>& stream, const Call& call) {
    using Returned = std::invoke_result_t<Call, Stream&>;
    constexpr bool has_error = std::is_same_v<Returned, Result<void>>;
    if constexpr (has_error)
        if (!stream)
            return within_memory("record", "a frame", [] {
                return fail(Fault::usage, "record.moved_from", "this recorder was moved from; use the one it was moved to");
            });
    if (!stream) return Returned();
    const std::lock_guard lock(stream->calls);
    const std::string& file = stream->writer.path();
    try {
        return call(*stream);
    } catch (const std::exception&) {
        if (!stream->misuse) stream->misuse = caught(file);
        if constexpr (has_error) return caught(file);
        else return Returned();
    }
}

template <typename T>
std::uint32_t Recorder::Stream::add(std::uint32_t& count, T resource, std::string_view call) {
    const std::uint32_t index = count++;
    update(count, index, std::move(resource), call);
    return index;
}

template <typename T>
void Recorder::Stream::update(std::uint32_t count, std::uint32_t index, T resource, std::string_view call) {
    if (!usable()) return;
    if (index >= count) {
        (void)misused(fail(Fault::usage, "record.index_out_of_range", "{call}() was called for index {index} of {count}", call,
                           index, count));
        return;
    }
    const std::uint64_t bytes = footprint(resource);
    const std::string what = name_if_too_large(bytes, index, resource);
    // Without this resource all that follows would be wrong.
    if (const Result<void> pushed = queue.push(Put<T>{index, std::move(resource)}, bytes, what); !pushed) {
        (void)misused(pushed.error());
    }
}

template <typename Fill>
void Recorder::Stream::submit(std::string_view call, const Fill& fill) {
    if (frame) {
        frame_bytes += fill(*frame);
    } else {
        (void)misused(
            fail(Fault::usage, "record.outside_frame", "{call}() was called outside of begin_frame() and end_frame()", call));
    }
}

template <typename T>
std::uint32_t Recorder::Stream::append(std::string_view call, std::vector<T> Frame::*list, T value) {
    std::uint32_t index = 0;
    submit(call, [&](Frame& open) {
        index = static_cast<std::uint32_t>((open.*list).size());
        (open.*list).push_back(std::move(value));
        return footprint((open.*list).back());
    });
    return index;
}

Result<Recorder> Recorder::create(const std::filesystem::path& path, std::string notes, const RecorderOptions& options) {
    try {
        Result<FrameWriter> writer = FrameWriter::create(path, notes);
        if (!writer) return writer.error();
        return Recorder(std::make_unique<Stream>(*std::move(writer), options.budget_bytes));
    } catch (const std::exception&) {
        return caught(path.native());
    }
}

Recorder::Recorder(std::unique_ptr<Stream> stream) : stream_(std::move(stream)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

std::uint32_t Recorder::add_texture(Texture texture) {
    return Stream::run(stream_, [&](Stream& stream) { return stream.add(stream.textures, std::move(texture), "add_texture"); });
}
std::uint32_t Recorder::add_mesh(Mesh mesh) {
    return Stream::run(stream_, [&](Stream& stream) { return stream.add(stream.meshes, std::move(mesh), "add_mesh"); });
}
std::uint32_t Recorder::add_material(Material material) {
    return Stream::run(stream_,
                       [&](Stream& stream) { return stream.add(stream.materials, std::move(material), "add_material"); });
}
void Recorder::update_texture(std::uint32_t index, Texture texture) {
    Stream::run(stream_, [&](Stream& stream) { stream.update(stream.textures, index, std::move(texture), "update_texture"); });
}
void Recorder::update_mesh(std::uint32_t index, Mesh mesh) {
    Stream::run(stream_, [&](Stream& stream) { stream.update(stream.meshes, index, std::move(mesh), "update_mesh"); });
}
void Recorder::update_material(std::uint32_t index, Material material) {
    Stream::run(stream_, [&](Stream& stream) { stream.update(stream.materials, index, std::move(material), "update_material"); });
}

void Recorder::begin_frame(const View& view, double time, std::uint64_t index, std::uint64_t seed) {
    Stream::run(stream_, [&](Stream& stream) {
        if (stream.frame) {
            (void)stream.misused(
                fail(Fault::usage, "record.begun_twice", "begin_frame() was called twice without end_frame() between"));
            return;
        }
        stream.frame = stream.queue.empty_frame();
        stream.frame->view = view;
        stream.frame->time = time;
        stream.frame->index = index;
        stream.frame->seed = seed;
        stream.frame_bytes = sizeof(Frame);
    });
}

void Recorder::draws(std::span<const Draw> batch) {
    Stream::run(stream_, [&](Stream& stream) {
        stream.submit("draws", [&](Frame& frame) {
            frame.draws.insert(frame.draws.end(), batch.begin(), batch.end());
            std::uint64_t bytes = 0;
            for (const Draw& draw : batch) bytes += footprint(draw);
            return bytes;
        });
    });
}
void Recorder::draw(Draw draw) {
    Stream::run(stream_, [&](Stream& stream) { stream.append("draw", &Frame::draws, std::move(draw)); });
}
void Recorder::emitter(Emitter emitter) {
    Stream::run(stream_, [&](Stream& stream) { stream.append("emitter", &Frame::emitters, std::move(emitter)); });
}
void Recorder::light(Light light) {
    Stream::run(stream_, [&](Stream& stream) { stream.append("light", &Frame::lights, std::move(light)); });
}
std::uint32_t Recorder::add_blocker(Blocker blocker) {
    return Stream::run(stream_,
                       [&](Stream& stream) { return stream.append("add_blocker", &Frame::blockers, std::move(blocker)); });
}
std::uint32_t Recorder::add_portal(Portal portal) {
    return Stream::run(stream_, [&](Stream& stream) { return stream.append("add_portal", &Frame::portals, std::move(portal)); });
}
void Recorder::light_volume(LightVolume volume) {
    Stream::run(stream_, [&](Stream& stream) { stream.append("light_volume", &Frame::light_volumes, std::move(volume)); });
}
void Recorder::stage(StageChoice choice) {
    Stream::run(stream_, [&](Stream& stream) { stream.append("stage", &Frame::recorded_with, std::move(choice)); });
}

void Recorder::weather(const Rain& rain) {
    Stream::run(stream_, [&](Stream& stream) {
        stream.submit("weather", [&](Frame& frame) {
            frame.rain = rain;
            return 0u;
        });
    });
}

void Recorder::environment(const Sun& sun, const Hemisphere& hemisphere, const Fog& fog, glm::vec3 background) {
    Stream::run(stream_, [&](Stream& stream) {
        stream.submit("environment", [&](Frame& frame) {
            frame.sun = sun;
            frame.hemisphere = hemisphere;
            frame.fog = fog;
            frame.background = background;
            return 0u;
        });
    });
}

void Recorder::camera(const Lens& lens, const Film& film) {
    Stream::run(stream_, [&](Stream& stream) {
        stream.submit("camera", [&](Frame& frame) {
            frame.lens = lens;
            frame.film = film;
            return 0u;
        });
    });
}

Result<void> Recorder::end_frame() {
    return Stream::run(stream_, [&](Stream& stream) -> Result<void> {
        if (const Result<void> ready = stream.usable(); !ready) return ready;
        if (!stream.frame)
            return stream.misused(fail(Fault::usage, "record.not_begun", "end_frame() was called without begin_frame()"));
        const std::uint64_t number = stream.frames++, bytes = std::exchange(stream.frame_bytes, 0);
        const std::string what = stream.name_if_too_large(bytes, *stream.frame, number, stream.queue.budget());
        const Result<void> pushed = stream.queue.push(SubmittedFrame{std::move(stream.frame), number}, bytes, what);
        return pushed ? stream.report() : pushed;
    });
}

Result<void> Recorder::record(Frame frame) {
    return Stream::run(stream_, [&](Stream& stream) -> Result<void> {
        if (const Result<void> ready = stream.usable(); !ready) return ready;
        if (stream.frame)
            return stream.misused(
                fail(Fault::usage, "record.within_frame", "record() was called within begin_frame() and end_frame()"));
        const std::uint64_t number = stream.frames++, bytes = recorded_bytes(frame);
        const std::string what = stream.name_if_too_large(bytes, frame, number, stream.queue.budget());
        const Result<void> pushed = stream.queue.push(WholeFrame{std::make_unique<Frame>(std::move(frame)), number}, bytes, what);
        return pushed ? stream.report() : pushed;
    });
}

Result<void> Recorder::thumbnail(const Texture& picture) {
    return Stream::run(stream_, [&](Stream& stream) -> Result<void> {
        if (const Result<void> ready = stream.usable(); !ready) return ready;
        Result<std::vector<std::byte>> encoded = encode_picture(picture);
        if (!encoded) return encoded.error();
        const std::uint64_t bytes = encoded->size();
        return stream.queue.push(EncodedThumbnail{*std::move(encoded), picture.texels.size()}, bytes, "the thumbnail");
    });
}

Result<void> Recorder::flush() {
    return Stream::run(stream_, [&](Stream& stream) -> Result<void> {
        if (const Result<void> ready = stream.usable(); !ready) return ready;
        stream.queue.drain();
        return stream.report();
    });
}

std::uint64_t Recorder::frames_written() const { return stream_ ? stream_->written.load() : 0; }
RecorderLoad Recorder::load() const { return stream_ ? stream_->queue.load() : RecorderLoad(); }

Result<void> Recorder::finish() {
    return Stream::run(stream_, [&](Stream& stream) -> Result<void> {
        if (const Result<void> ready = stream.usable(); !ready) return ready;
        if (stream.frame) return stream.misused(fail(Fault::usage, "record.not_ended", "finish() was called before end_frame()"));
        stream.stop();
        stream.finished = true;
        const Result<void> finished = stream.writer.finish();
        return finished ? stream.report() : finished;
    });
}

}  // namespace strata
