#include "capture_format/check_capture.h"

#include "capture_format/container/blob_store.h"
#include "capture_format/container/container.h"
#include "capture_format/frame/frame.h"
#include "capture_format/reader.h"

namespace strata {

Result<void> check_capture(const std::filesystem::path& path, std::uint64_t memory_budget,
                           const std::function<Result<void>(const Frame&)>& also) {
    MemoryBudget budget(memory_budget);
    const auto container = Container::open(path);
    if (!container) return container.error();
    if (container->damage()) return *container->damage();
    if (const auto sound = container->check_bytes(); !sound) return sound;
    for (const SectionType type : {SectionType::blobs, SectionType::expect}) {
        auto blobs = BlobStore::open(*container, budget, type);
        if (!blobs) return blobs.error();
        if (const auto sound = blobs->check_all(); !sound) return sound;
    }
    const auto capture = Capture::open(path, Partial::refused, memory_budget);
    if (!capture) return capture.error();
    for (std::size_t i = 0; i < capture->frame_count(); ++i) {
        const auto frame = capture->frame(i);
        if (!frame) return within(frame.error(), "frame {frame}", i);
        if (const auto sound = also ? also(*frame) : Result<void>(); !sound) return within(sound.error(), "frame {frame}", i);
    }
    return {};
}

}  // namespace strata
