#include "capture_format/import/gltf_meshopt.h"

#include <meshoptimizer.h>

namespace strata::gltf {
namespace {

/// The decoders assert what the extension's text demands of mode, filter, stride and count; a file is asked politely.
Result<void> check(const MeshoptLayout& layout) {
    const std::uint64_t stride = layout.stride;
    const bool attributes = layout.mode == "ATTRIBUTES";
    if (!attributes && layout.mode != "TRIANGLES" && layout.mode != "INDICES") {
        return fail(Fault::bad_input, "import.gltf.meshopt_mode", "compression mode '{mode:.40}' does not exist", layout.mode);
    }
    const bool strides = attributes ? stride >= 4 && stride <= 256 && stride % 4 == 0 : stride == 2 || stride == 4;
    if (!strides)
        return fail(Fault::bad_input, "import.gltf.meshopt_stride", "a stride of {stride} does not fit compression mode {mode}",
                    stride, layout.mode);
    if (layout.mode == "TRIANGLES" && layout.count % 3 != 0) {
        return fail(Fault::bad_input, "import.gltf.meshopt_triangles", "{indices} compressed indices are not whole triangles",
                    layout.count);
    }
    const std::string& filter = layout.filter;
    const bool filters = filter == "NONE" || (attributes && filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) ||
                         (attributes && filter == "QUATERNION" && stride == 8) || (attributes && filter == "EXPONENTIAL");
    if (!filters) {
        return fail(Fault::bad_input, "import.gltf.meshopt_filter",
                    "filter '{filter:.40}' does not fit compression mode {mode} of stride {stride}", filter, layout.mode, stride);
    }
    return {};
}

}  // namespace

Result<std::vector<std::byte>> decode_meshopt(std::span<const std::byte> packed, const MeshoptLayout& layout,
                                              MemoryBudget& budget) {
    if (const auto good = check(layout); !good) return good.error();
    if (const auto room = budget.take(layout.count, layout.stride, "a compressed buffer view"); !room) return room.error();
    std::vector<std::byte> unpacked(layout.count * layout.stride);
    if (unpacked.empty()) return unpacked;
    const auto* source = reinterpret_cast<const unsigned char*>(packed.data());
    int failed = 0;
    if (layout.mode == "ATTRIBUTES") {
        failed = meshopt_decodeVertexBuffer(unpacked.data(), layout.count, layout.stride, source, packed.size());
    } else if (layout.mode == "TRIANGLES") {
        failed = meshopt_decodeIndexBuffer(unpacked.data(), layout.count, layout.stride, source, packed.size());
    } else {
        failed = meshopt_decodeIndexSequence(unpacked.data(), layout.count, layout.stride, source, packed.size());
    }
    if (failed != 0)
        return fail(Fault::bad_input, "import.gltf.meshopt_damaged", "the {bytes} compressed bytes are damaged", packed.size());
    if (layout.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(unpacked.data(), layout.count, layout.stride);
    if (layout.filter == "QUATERNION") meshopt_decodeFilterQuat(unpacked.data(), layout.count, layout.stride);
    if (layout.filter == "EXPONENTIAL") meshopt_decodeFilterExp(unpacked.data(), layout.count, layout.stride);
    return unpacked;
}

}  // namespace strata::gltf
