// Frames become sections of a file: the blobs a frame brings first, then the frame, so that a whole frame section never names
// bytes that are not in the file yet. Keeps what the resources are called and looks like, not their bytes. One thread at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "capture_format/codec/frame_delta.h"
#include "capture_format/codec/stored_resources.h"
#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/result.h"

namespace strata {

class FrameWriter {
public:
    static Result<FrameWriter> create(const std::filesystem::path&, std::string_view notes);

    /// Sets a resource of all later frames; an index may be at most one new one. A bad resource is no error yet: the frames
    /// are refused until it is replaced.
    Result<void> put(std::uint32_t index, const Texture&);
    Result<void> put(std::uint32_t index, const Mesh&);
    Result<void> put(std::uint32_t index, const Material&);
    /// Writes what a frame submits to the resources there are. One that check_frame() would refuse is an error and left out;
    /// `number` is for its sentence.
    Result<void> write(const Frame&, std::uint64_t number);
    /// Writes a frame with its own resources and none of those put.
    Result<void> write_whole(const Frame&, std::uint64_t number);
    /// Any other section.
    Result<void> add(const Payload&);
    /// Writes the directory.
    Result<void> finish();

    /// The first failed write; nothing is written after it and every call returns it.
    const std::optional<Error>& broken() const { return broken_; }
    /// Makes that the error, unless there is one. Takes no memory.
    const Error& give_up(Error);
    const std::string& path() const { return file_.path(); }

private:
    enum class Kind { texture, mesh };

    explicit FrameWriter(ContainerWriter file) : file_(std::move(file)) {}
    Result<void> write(const Frame&, const StoredResources&, std::uint64_t number);
    Result<void> write_blobs();
    void judge(Kind, std::uint32_t index, const Result<void>& verdict);

    ContainerWriter file_;
    BlobCollector blobs_;
    FrameChain chain_;
    StoredResources resources_;
    std::map<std::pair<Kind, std::uint32_t>, Error> bad_;  ///< resources that would make a frame unreadable
    std::optional<Error> broken_;
};

}  // namespace strata
