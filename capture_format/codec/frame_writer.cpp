// Checks, encodes, packs, appends.
#include "capture_format/codec/frame_writer.h"

#include "capture_format/codec/decode_frame.h"
#include "capture_format/codec/draw_runs.h"
#include "capture_format/codec/encode_frame.h"
#include "capture_format/codec/upgrade.h"
#include "capture_format/container/picture.h"
#include "capture_format/frame/draw.h"
#include "capture_format/frame/frame.h"
#include "capture_format/frame/light.h"
#include "capture_format/frame/material.h"
#include "capture_format/frame/mesh.h"
#include "capture_format/frame/particles.h"
#include "capture_format/frame/texture.h"
#include "capture_format/inspection.h"
#include "capture_format/reader.h"

namespace strata {
namespace {

/// Blobs wait for their frame, because together they compress better, but no more than this.
constexpr std::uint64_t most_pending_bytes = std::uint64_t{8} << 20;

template <typename T>
void set(std::vector<T>& list, std::uint32_t index, T value) {
    if (index == list.size()) list.emplace_back();
    list[index] = std::move(value);
}

template <typename T>
Result<void> inspected(std::string_view kind, std::uint32_t index, const T& resource, void (*inspect)(Inspection&, const T&)) {
    Inspection inspection;
    inspection.at({kind, index, resource.name});
    inspect(inspection, resource);
    return inspection.verdict();
}

ResourceShapes shapes_of(const StoredResources& resources) {
    ResourceShapes shapes{.textures = resources.textures.size(), .meshes = {}, .materials = resources.materials};
    for (const StoredMesh& mesh : resources.meshes)
        shapes.meshes.push_back({mesh.name, mesh.positions.bytes == 0, mesh.uv0.bytes != 0, mesh.uv1.bytes != 0});
    return shapes;
}

/// A lower bound of what a frame takes, encoded. The builder of flatbuffers does not check its limit of 2 GiB in a release
/// build.
std::uint64_t least_bytes(const Frame& frame, const StoredResources& resources) {
    constexpr std::uint64_t draw = 2 * sizeof(glm::dmat4), other = 64, clip_plane = 32;
    const auto each = [](const auto& list, std::uint64_t bytes) {
        std::uint64_t sum = list.size() * bytes;
        for (const auto& one : list) sum += one.name.size();
        return sum;
    };
    std::uint64_t sum = each(frame.draws, draw) + each(frame.emitters, other) + each(frame.lights, other) +
                        each(resources.materials, 2 * other) + each(resources.meshes, 2 * other) +
                        other * (resources.textures.size() + frame.blockers.size() + frame.portals.size());
    for (const Light& light : frame.lights)
        sum += sizeof(std::uint32_t) * (light.blockers.size() + light.portals.size()) + clip_plane * light.clip_planes.size();
    return sum;
}

Result<void> check_size(const Frame& frame, std::uint64_t number, std::uint64_t bytes) {
    if (bytes <= largest_frame_section) return {};
    return fail(Fault::usage, "record.frame_too_large",
                "frame {frame} with {draws} draws cannot be recorded: without its resources it takes {bytes} bytes or more; the "
                "limit is {most}, about 700000 draws",
                number, frame.draws.size(), bytes, largest_frame_section);
}

/// What a reader would refuse as bad input is a mistake of the application that records it.
Error refused(std::uint64_t number, const Error& why) {
    Error error = within(why, "frame {frame} cannot be recorded", number);
    error.fault = Fault::usage;
    return error;
}

}  // namespace

Result<FrameWriter> FrameWriter::create(const std::filesystem::path& path, std::string_view notes) {
    if (notes.size() > longest_notes) {
        return fail(Fault::usage, "record.notes_too_long", "notes of {bytes} bytes are too long; the limit is {most}",
                    notes.size(), longest_notes);
    }
    Result<ContainerWriter> file = ContainerWriter::create(path);
    if (!file) return file.error();
    FrameWriter writer(*std::move(file));
    if (notes.empty()) return writer;
    const Payload payload = {SectionType::notes, notes_version, std::as_bytes(std::span(notes)), notes.size()};
    if (const Result<void> added = writer.add(payload); !added) return added.error();
    return writer;
}

const Error& FrameWriter::give_up(Error error) {
    if (!broken_) broken_ = std::move(error);
    return *broken_;
}

Result<void> FrameWriter::add(const Payload& payload) {
    if (broken_) return *broken_;
    const Result<void> added = file_.add(payload);
    return added ? added : give_up(added.error());
}

Result<void> FrameWriter::write_blobs() {
    const Result<std::vector<PackedBlobs>> packed = blobs_.pack();
    if (!packed) return give_up(packed.error());
    for (const PackedBlobs& part : *packed) {
        const Payload payload = {SectionType::blobs, part.version, part.stored, part.raw_bytes};
        if (const Result<void> added = add(payload); !added) return added;
    }
    return {};
}

void FrameWriter::judge(Kind kind, std::uint32_t index, const Result<void>& verdict) {
    if (verdict) {
        bad_.erase({kind, index});
    } else {
        bad_.insert_or_assign({kind, index}, verdict.error());
    }
}

Result<void> FrameWriter::put(std::uint32_t index, const Texture& texture) {
    judge(Kind::texture, index, inspected("texture", index, texture, inspect_texture));
    set(resources_.textures, index, store(texture, blobs_));
    return blobs_.pending_bytes() > most_pending_bytes ? write_blobs() : Result<void>();
}

Result<void> FrameWriter::put(std::uint32_t index, const Mesh& mesh) {
    judge(Kind::mesh, index, inspected("mesh", index, mesh, inspect_mesh));
    set(resources_.meshes, index, store(mesh, blobs_));
    return blobs_.pending_bytes() > most_pending_bytes ? write_blobs() : Result<void>();
}

Result<void> FrameWriter::put(std::uint32_t index, const Material& material) {
    set(resources_.materials, index, material);
    return {};
}

Result<void> FrameWriter::write(const Frame& frame, std::uint64_t number) {
    if (!bad_.empty()) return refused(number, bad_.begin()->second);
    if (const Result<void> checked = check_submissions(frame, shapes_of(resources_)); !checked) {
        return refused(number, checked.error());
    }
    return write(frame, resources_, number);
}

Result<void> FrameWriter::write_whole(const Frame& frame, std::uint64_t number) {
    if (const Result<void> checked = check_frame(frame); !checked) return refused(number, checked.error());
    const BlobLoan loan(blobs_);  // the frame stays until it is written
    return write(frame, store_resources(frame, blobs_), number);
}

Result<void> FrameWriter::write(const Frame& frame, const StoredResources& resources, std::uint64_t number) {
    if (broken_) return *broken_;
    if (const auto fits = check_size(frame, number, least_bytes(frame, resources)); !fits) return fits;
    const std::vector<std::byte> flatbuffer = encode_frame(frame, resources, blobs_);
    if (const auto fits = check_size(frame, number, flatbuffer.size()); !fits) return fits;
    // What could not be read back is not written.
    if (const Result<void> verified = verify_frame(flatbuffer); !verified) return refused(number, verified.error());
    if (const Result<void> written = write_blobs(); !written) return written;
    const auto runs = chain_.newest().empty() ? std::vector<FrameChain::Run>() : draw_runs(chain_.newest(), flatbuffer);
    const std::vector<std::byte> payload = chain_.pack(flatbuffer, echo_of(flatbuffer), runs);
    return add({SectionType::frame, format_version, payload, flatbuffer.size()});
}

Result<void> FrameWriter::finish() {
    if (broken_) return *broken_;
    const Result<void> finished = file_.finish();
    return finished ? finished : give_up(finished.error());
}

}  // namespace strata
