// Two sides with a queue between them: the application's calls fill a frame under a mutex and hand it over; the thread takes what
// comes out and gives it to the FrameWriter.
#include "capture_format/recorder.h"

#include <pthread.h>
#include <sched.h>

#include <atomic>
#include <mutex>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "capture_format/codec/frame_writer.h"
#include "capture_format/container/container.h"
#include "capture_format/container/picture.h"
#include "capture_format/recording_queue.h"

namespace strata {
namespace {

template <typename T>
std::uint64_t bytes_of(const std::vector<T>& values) {
    return values.size() * sizeof(T);
}
std::uint64_t footprint(const Texture& texture) { return sizeof(texture) + texture.name.size() + texture.texels.size(); }
std::uint64_t footprint(const Mesh& mesh) {
    return sizeof(mesh) + mesh.name.size() + bytes_of(mesh.positions) + bytes_of(mesh.normals) + bytes_of(mesh.tangents) +
           bytes_of(mesh.uv0) + bytes_of(mesh.uv1) + bytes_of(mesh.colors) + bytes_of(mesh.indices);
}
std::uint64_t footprint(const Material& material) { return sizeof(material) + material.name.size(); }
std::uint64_t footprint(const Draw& draw) { return sizeof(draw) + draw.name.size(); }
std::uint64_t footprint(const Emitter& emitter) { return sizeof(emitter) + emitter.name.size() + bytes_of(emitter.particles); }
std::uint64_t footprint(const Light& light) {
    return sizeof(light) + light.name.size() + bytes_of(light.clip_planes) + bytes_of(light.blockers) + bytes_of(light.portals);
}
/// What only a few of are ever submitted.
template <typename T>
std::uint64_t footprint(const T& value) {
    return sizeof(value);
}
template <typename T>
std::uint64_t footprint(const std::vector<T>& values) {
    std::uint64_t sum = 0;
    for (const T& value : values) sum += footprint(value);
    return sum;
}
std::uint64_t footprint(const Frame& frame) {
    return sizeof(frame) + footprint(frame.textures) + footprint(frame.meshes) + footprint(frame.materials) +
           footprint(frame.draws) + footprint(frame.emitters) + footprint(frame.lights) + footprint(frame.blockers) +
           footprint(frame.portals);
}

}  // namespace

std::uint64_t recorded_bytes(const Frame& frame) { return footprint(frame); }

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

    // The application's side.
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
        Result<void> done;
        try {
            done = std::visit([this](auto& recorded) { return write(recorded); }, *item);
        } catch (const std::bad_alloc&) {
            done =
                writer.give_up(fail(Fault::usage, "record.no_memory", "there is no memory left to record {file}", writer.path()));
        }
        if (done) continue;
        const std::lock_guard lock(reporting);
        broken = writer.broken().has_value();
        if (!unreported || broken) unreported = done.error();
    }
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

template <typename T>
std::uint32_t Recorder::Stream::add(std::uint32_t& count, T resource, std::string_view call) {
    const std::lock_guard lock(calls);
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
    const std::string what = fmt::format("'{:.60}'", resource.name);
    // Without this resource all that follows would be wrong.
    if (const Result<void> pushed = queue.push(Put<T>{index, std::move(resource)}, bytes, what); !pushed) {
        (void)misused(pushed.error());
    }
}

template <typename Fill>
void Recorder::Stream::submit(std::string_view call, const Fill& fill) {
    const std::lock_guard lock(calls);
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
    Result<FrameWriter> writer = FrameWriter::create(path, notes);
    if (!writer) return writer.error();
    return Recorder(std::make_unique<Stream>(*std::move(writer), options.budget_bytes));
}

Recorder::Recorder(std::unique_ptr<Stream> stream) : stream_(std::move(stream)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

std::uint32_t Recorder::add_texture(Texture texture) {
    return stream_->add(stream_->textures, std::move(texture), "add_texture");
}
std::uint32_t Recorder::add_mesh(Mesh mesh) { return stream_->add(stream_->meshes, std::move(mesh), "add_mesh"); }
std::uint32_t Recorder::add_material(Material material) {
    return stream_->add(stream_->materials, std::move(material), "add_material");
}
void Recorder::update_texture(std::uint32_t index, Texture texture) {
    const std::lock_guard lock(stream_->calls);
    stream_->update(stream_->textures, index, std::move(texture), "update_texture");
}
void Recorder::update_mesh(std::uint32_t index, Mesh mesh) {
    const std::lock_guard lock(stream_->calls);
    stream_->update(stream_->meshes, index, std::move(mesh), "update_mesh");
}
void Recorder::update_material(std::uint32_t index, Material material) {
    const std::lock_guard lock(stream_->calls);
    stream_->update(stream_->materials, index, std::move(material), "update_material");
}

void Recorder::begin_frame(const View& view, double time, std::uint64_t index, std::uint64_t seed) {
    const std::lock_guard lock(stream_->calls);
    if (stream_->frame) {
        (void)stream_->misused(
            fail(Fault::usage, "record.begun_twice", "begin_frame() was called twice without end_frame() between"));
        return;
    }
    stream_->frame = stream_->queue.empty_frame();
    stream_->frame->view = view;
    stream_->frame->time = time;
    stream_->frame->index = index;
    stream_->frame->seed = seed;
    stream_->frame_bytes = sizeof(Frame);
}

void Recorder::draw(Draw draw) { stream_->append("draw", &Frame::draws, std::move(draw)); }
void Recorder::draws(std::span<const Draw> batch) {
    stream_->submit("draws", [&](Frame& frame) {
        frame.draws.insert(frame.draws.end(), batch.begin(), batch.end());
        std::uint64_t bytes = 0;
        for (const Draw& draw : batch) bytes += footprint(draw);
        return bytes;
    });
}
void Recorder::emitter(Emitter emitter) { stream_->append("emitter", &Frame::emitters, std::move(emitter)); }
void Recorder::light(Light light) { stream_->append("light", &Frame::lights, std::move(light)); }
std::uint32_t Recorder::add_blocker(Blocker blocker) {
    return stream_->append("add_blocker", &Frame::blockers, std::move(blocker));
}
std::uint32_t Recorder::add_portal(Portal portal) { return stream_->append("add_portal", &Frame::portals, std::move(portal)); }
void Recorder::light_volume(LightVolume volume) { stream_->append("light_volume", &Frame::light_volumes, std::move(volume)); }
void Recorder::stage(StageChoice choice) { stream_->append("stage", &Frame::recorded_with, std::move(choice)); }

void Recorder::weather(const Rain& rain) {
    stream_->submit("weather", [&](Frame& frame) {
        frame.rain = rain;
        return 0u;
    });
}

void Recorder::environment(const Sun& sun, const Hemisphere& hemisphere, const Fog& fog, glm::vec3 background) {
    stream_->submit("environment", [&](Frame& frame) {
        frame.sun = sun;
        frame.hemisphere = hemisphere;
        frame.fog = fog;
        frame.background = background;
        return 0u;
    });
}

void Recorder::camera(const Lens& lens, const Film& film) {
    stream_->submit("camera", [&](Frame& frame) {
        frame.lens = lens;
        frame.film = film;
        return 0u;
    });
}

Result<void> Recorder::end_frame() {
    const std::lock_guard lock(stream_->calls);
    if (const Result<void> ready = stream_->usable(); !ready) return ready;
    if (!stream_->frame)
        return stream_->misused(fail(Fault::usage, "record.not_begun", "end_frame() was called without begin_frame()"));
    const std::uint64_t number = stream_->frames++, bytes = std::exchange(stream_->frame_bytes, 0);
    const Result<void> pushed =
        stream_->queue.push(SubmittedFrame{std::move(stream_->frame), number}, bytes, fmt::format("frame {}", number));
    return pushed ? stream_->report() : pushed;
}

Result<void> Recorder::record(Frame frame) {
    const std::lock_guard lock(stream_->calls);
    if (const Result<void> ready = stream_->usable(); !ready) return ready;
    if (stream_->frame)
        return stream_->misused(
            fail(Fault::usage, "record.within_frame", "record() was called within begin_frame() and end_frame()"));
    const std::uint64_t number = stream_->frames++, bytes = recorded_bytes(frame);
    const Result<void> pushed = stream_->queue.push(WholeFrame{std::make_unique<Frame>(std::move(frame)), number}, bytes,
                                                    fmt::format("frame {}", number));
    return pushed ? stream_->report() : pushed;
}

Result<void> Recorder::thumbnail(const Texture& picture) {
    const std::lock_guard lock(stream_->calls);
    if (const Result<void> ready = stream_->usable(); !ready) return ready;
    Result<std::vector<std::byte>> encoded = encode_picture(picture);
    if (!encoded) return encoded.error();
    const std::uint64_t bytes = encoded->size();
    return stream_->queue.push(EncodedThumbnail{*std::move(encoded), picture.texels.size()}, bytes, "the thumbnail");
}

Result<void> Recorder::flush() {
    const std::lock_guard lock(stream_->calls);
    if (const Result<void> ready = stream_->usable(); !ready) return ready;
    stream_->queue.drain();
    return stream_->report();
}

std::uint64_t Recorder::frames_written() const { return stream_->written; }
RecorderLoad Recorder::load() const { return stream_->queue.load(); }

Result<void> Recorder::finish() {
    const std::lock_guard lock(stream_->calls);
    if (const Result<void> ready = stream_->usable(); !ready) return ready;
    if (stream_->frame) return stream_->misused(fail(Fault::usage, "record.not_ended", "finish() was called before end_frame()"));
    stream_->stop();
    stream_->finished = true;
    const Result<void> finished = stream_->writer.finish();
    return finished ? stream_->report() : finished;
}

}  // namespace strata
