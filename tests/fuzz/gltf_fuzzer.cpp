// The glTF importer under libFuzzer: .gltf and .glb in memory, which opens no other file.
#include "capture_format/frame/frame.h"
#include "capture_format/import/gltf.h"
#include "capture_format/reader.h"
#include "tests/fuzz/walk_frame.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace strata;
    // Small, so that a mutation that claims much is refused at once; the frames of an animation are few.
    const GltfOptions options = {.width = 16, .height = 9, .memory_budget = std::uint64_t{16} << 20};
    auto scene = GltfScene::open(std::as_bytes(std::span(data, size)), "fuzz", options);
    if (!scene) return 0;
    for (const std::uint32_t index : {0u, 1u, 40u}) {
        const auto frame = scene->frame(index);
        if (!frame) continue;
        if (!check_frame(*frame)) std::abort();
        volatile const double sum = walk(*frame);
        static_cast<void>(sum);
    }
    return 0;
}
