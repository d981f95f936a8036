// Streams frames to a container: the blobs a frame brings first, then the frame, so that a whole frame section never names
// bytes that are not in the file yet.
#include "capture_format/recorder.h"

#include <optional>

#include "capture_format/blob_store.h"
#include "capture_format/container.h"
#include "capture_format/decode_frame.h"
#include "capture_format/encode_frame.h"
#include "capture_format/frame_delta.h"
#include "capture_format/picture.h"
#include "capture_format/reader.h"
#include "capture_format/upgrade.h"

namespace strata {

struct Recorder::Writer {
    ContainerWriter file;
    BlobCollector blobs = {};
    FrameChain chain = {};
    Frame frame = {};
    bool in_frame = false, finished = false;
    std::uint64_t frames = 0;
    std::optional<Error> broken = {};  ///< the first failed write or misuse; nothing is written after it

    Result<void> give_up(const Error& error) {
        if (!broken) broken = error;
        return *broken;
    }
    /// What makes any further writing wrong.
    Result<void> usable() const {
        if (broken) return *broken;
        if (finished) return fail(Fault::usage, "{} is finished; nothing can be recorded into it", file.path());
        return {};
    }
    Result<void> write(const Frame&);
    Result<void> add(const Payload& payload) {
        const Result<void> added = file.add(payload);
        return added ? added : give_up(added.error());
    }
};

Result<void> Recorder::Writer::write(const Frame& complete) {
    if (const Result<void> ready = usable(); !ready) return ready;
    // What could not be read back is not written.
    if (const Result<void> checked = check_frame(complete); !checked) {
        return fail(Fault::usage, "frame {} cannot be recorded: {}", frames, checked.error().sentence);
    }
    const std::vector<std::byte> section = encode_frame(complete, blobs);
    if (const Result<void> verified = verify_frame(section); !verified) {
        return give_up(fail(Fault::usage, "frame {} cannot be recorded: {}", frames, verified.error().sentence));
    }
    const Result<std::vector<PackedBlobs>> packed = blobs.pack();
    if (!packed) return give_up(packed.error());
    for (const PackedBlobs& part : *packed) {
        const Payload payload = {SectionType::blobs, blobs_version, part.stored, part.raw_bytes};
        if (const Result<void> added = add(payload); !added) return added;
    }
    ++frames;
    return add({SectionType::frame, format_version, chain.pack(section, echo_of(section)), section.size()});
}

Result<Recorder> Recorder::create(const std::filesystem::path& path, std::string notes) {
    if (notes.size() > longest_notes) {
        return fail(Fault::usage, "notes of {} bytes are too long; {} are the most", notes.size(), longest_notes);
    }
    Result<ContainerWriter> file = ContainerWriter::create(path);
    if (!file) return file.error();
    auto writer = std::make_unique<Writer>(Writer{.file = *std::move(file)});
    if (!notes.empty()) {
        const Result<void> added =
            writer->add({SectionType::notes, notes_version, std::as_bytes(std::span(notes)), notes.size()});
        if (!added) return added.error();
    }
    return Recorder(std::move(writer));
}

Recorder::Recorder(std::unique_ptr<Writer> writer) : writer_(std::move(writer)) {}
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;
Recorder::~Recorder() = default;

void Recorder::begin_frame(const View& view, double time, std::uint64_t index, std::uint64_t seed) {
    if (writer_->in_frame) {
        (void)writer_->give_up(fail(Fault::usage, "begin_frame() was called twice without end_frame() between"));
    }
    writer_->in_frame = true;
    writer_->frame = {};
    writer_->frame.view = view;
    writer_->frame.time = time;
    writer_->frame.index = index;
    writer_->frame.seed = seed;
}

namespace {

template <typename T>
std::uint32_t append(std::vector<T>& list, T value) {
    list.push_back(std::move(value));
    return static_cast<std::uint32_t>(list.size() - 1);
}

}  // namespace

std::uint32_t Recorder::add_texture(Texture texture) { return append(writer_->frame.textures, std::move(texture)); }
std::uint32_t Recorder::add_mesh(Mesh mesh) { return append(writer_->frame.meshes, std::move(mesh)); }
std::uint32_t Recorder::add_material(Material material) { return append(writer_->frame.materials, std::move(material)); }
void Recorder::draw(Draw draw) { writer_->frame.draws.push_back(std::move(draw)); }
void Recorder::emitter(Emitter emitter) { writer_->frame.emitters.push_back(std::move(emitter)); }
void Recorder::light(Light light) { writer_->frame.lights.push_back(std::move(light)); }
std::uint32_t Recorder::add_blocker(Blocker blocker) { return append(writer_->frame.blockers, std::move(blocker)); }
std::uint32_t Recorder::add_portal(Portal portal) { return append(writer_->frame.portals, std::move(portal)); }
void Recorder::light_volume(LightVolume volume) { writer_->frame.light_volumes.push_back(std::move(volume)); }
void Recorder::weather(const Rain& rain) { writer_->frame.rain = rain; }
void Recorder::stage(StageChoice choice) { writer_->frame.recorded_with.push_back(std::move(choice)); }

void Recorder::environment(const Sun& sun, const Hemisphere& hemisphere, const Fog& fog, glm::vec3 background) {
    writer_->frame.sun = sun;
    writer_->frame.hemisphere = hemisphere;
    writer_->frame.fog = fog;
    writer_->frame.background = background;
}

void Recorder::camera(const Lens& lens, const Film& film) {
    writer_->frame.lens = lens;
    writer_->frame.film = film;
}

Result<void> Recorder::end_frame() {
    if (!writer_->in_frame) return writer_->give_up(fail(Fault::usage, "end_frame() was called without begin_frame()"));
    writer_->in_frame = false;
    return writer_->write(std::exchange(writer_->frame, {}));
}

Result<void> Recorder::record(const Frame& frame) {
    if (writer_->in_frame)
        return writer_->give_up(fail(Fault::usage, "record() was called within begin_frame() and end_frame()"));
    return writer_->write(frame);
}

Result<void> Recorder::thumbnail(const Texture& picture) {
    if (const Result<void> ready = writer_->usable(); !ready) return ready;
    const Result<std::vector<std::byte>> encoded = encode_picture(picture);
    if (!encoded) return encoded.error();
    return writer_->add({SectionType::thumbnail, picture_version, *encoded, encoded->size()});
}

Result<void> Recorder::finish() {
    if (const Result<void> ready = writer_->usable(); !ready) return ready;
    if (writer_->in_frame) return writer_->give_up(fail(Fault::usage, "finish() was called before end_frame()"));
    const Result<void> finished = writer_->file.finish();
    if (!finished) return writer_->give_up(finished.error());
    writer_->finished = true;
    return {};
}

}  // namespace strata
