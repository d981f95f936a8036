// What will run, as data: the surviving steps with their barriers, which memory each image uses, and what was left out and why.
#pragma once

#include <string>
#include <vector>

#include "capture_format/result.h"
#include "passes/graph/graph.h"
#include "passes/graph/shader.h"

namespace strata {

/// Waits for the previous use of (a part of) a resource and makes it ready for the next.
struct Barrier {
    Image image;            ///< exactly one of image and buffer exists
    Buffer buffer;
    Part part;
    Access before = Access::none, after = Access::none;
    bool discard = false;   ///< the old contents are not needed (first use, or memory taken over)
};

/// A binding with the place the shader gives it.
struct PlannedBinding {
    Binding binding;
    std::uint32_t set = 0, slot = 0;
    BindingKind kind = BindingKind::storage_buffer;
    ImageDimension dimension = ImageDimension::two;
    bool arrayed = false, multisampled = false, integer = false;
};

struct PlannedStep {
    Step step;
    std::vector<Barrier> barriers;         ///< before the step
    std::vector<PlannedBinding> bindings;  ///< every binding of every shader of the step, offers included
    std::vector<const Shader*> shaders;
};

/// Memory for one or more images of equal shape that are never alive together, or for one buffer.
struct MemorySlot {
    Shape shape;
    std::uint64_t bytes = 0;
    std::vector<std::uint32_t> images;     ///< ids, in order of their lives
};

struct CulledStep {
    std::string scope, name, reason;
};

struct Plan {
    std::vector<PlannedStep> steps;
    std::vector<MemorySlot> slots;
    std::vector<std::uint32_t> slot_of_image;   ///< by image id; `no_index` for imports and images nobody uses
    std::vector<ImageRecord> images;
    std::vector<BufferRecord> buffers;
    std::vector<Scope> scopes;
    std::vector<std::uint32_t> used_buffers;    ///< ids of created buffers that need memory
    std::vector<Barrier> final_barriers;        ///< kept images and buffers become readable by the host's copies
    std::vector<CulledStep> culled;
    std::uint64_t image_bytes = 0, buffer_bytes = 0;  ///< allocated for the frame, imports excluded
};

/// Turns declarations into a plan. Fails with the shader's and the binding's name when they do not fit together.
Result<Plan> compile(const Graph&, const ShaderLibrary&);

}  // namespace strata
