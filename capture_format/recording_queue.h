// What an application has handed over and the recorder's thread has not written yet: in order, and never more bytes than the
// budget. Any thread may push; one pops.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "capture_format/frame.h"
#include "capture_format/recorder.h"
#include "capture_format/result.h"

namespace strata {

/// A resource of all frames from here on.
template <typename T>
struct Put {
    std::uint32_t index = 0;
    T resource;
};
/// What a frame submits to the resources there are.
struct SubmittedFrame {
    std::unique_ptr<Frame> frame;
    std::uint64_t number = 0;
};
/// A frame that brings its own resources.
struct WholeFrame {
    std::unique_ptr<Frame> frame;
    std::uint64_t number = 0;
};
struct EncodedThumbnail {
    std::vector<std::byte> bytes;
    std::uint64_t texel_bytes = 0;  ///< of the picture, decoded
};
using Recorded = std::variant<Put<Texture>, Put<Mesh>, Put<Material>, SubmittedFrame, WholeFrame, EncodedThumbnail>;

class RecordingQueue {
public:
    explicit RecordingQueue(std::uint64_t budget_bytes) : budget_(budget_bytes) {}

    /// Waits until there is room. Fails for what would never fit, with both numbers; `what` names it.
    Result<void> push(Recorded, std::uint64_t bytes, std::string_view what);
    /// The next, when a frame is complete, half of the budget is used or somebody waits; nothing when closed and empty. What was
    /// popped before no longer counts.
    std::optional<Recorded> pop();
    /// Waits until all that was pushed is popped and done with.
    void drain();
    /// Nothing is pushed any more.
    void close();
    RecorderLoad load() const;
    std::uint64_t budget() const { return budget_; }

    /// Frames that were written and emptied go round, so that the application does not have to grow them again.
    void give_back(std::unique_ptr<Frame>);
    std::unique_ptr<Frame> empty_frame();

private:
    struct Entry {
        Recorded item;
        std::uint64_t bytes = 0;
    };
    bool worth_waking() const;

    const std::uint64_t budget_;
    mutable std::mutex mutex_;
    std::condition_variable room_, work_;
    std::deque<Entry> entries_;
    std::unique_ptr<Frame> spare_;
    std::uint64_t popped_bytes_ = 0;  ///< being written
    std::size_t frames_ = 0;          ///< in entries_
    int drainers_ = 0;
    bool closed_ = false, working_ = false;
    RecorderLoad load_;
};

}  // namespace strata
