// What will run, as data: the surviving steps with their barriers, which memory each image uses, and what was left out and why.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/result.h"
#include "passes/graph/shader.h"

namespace strata {

class Graph;  // passes/graph/graph.h

/// Waits for the previous use of (a part of) a resource and makes it ready for the next. Repeating the same read makes no
/// barrier, so one that leads to a read must serve every shader stage. What ran before the plan is finished and visible when
/// it starts: buffers need no barrier before their first use. Imported images enter and leave a plan as copied_from.
struct Barrier {
    Image image;  ///< exactly one of image and buffer exists
    Buffer buffer = {};
    Part part = {};
    Access before = Access::none, after = Access::none;  ///< the leading access of each set below
    AccessSet all_before, all_after;                     ///< several where a step tests depth against an image it samples
    bool discard = false;                                ///< the old contents are not needed (first use, or memory taken over)
};

/// A binding with the place the shader gives it.
struct PlannedBinding {
    Binding binding;
    std::uint32_t set = 0, slot = 0;
    BindingKind kind = BindingKind::storage_buffer;
    ImageDimension dimension = ImageDimension::two;
    bool arrayed = false, multisampled = false, integer = false;
    std::optional<Format> format;  ///< storage images: what the shader declares
};

struct PlannedStep {
    Step step;                             ///< with the shaders that were found
    std::vector<Barrier> barriers;         ///< before the step
    std::vector<PlannedBinding> bindings;  ///< every binding of every shader of the step, offers included
    std::vector<const Shader*> shaders;
    Extent groups{0, 0, 0};    ///< of a compute step that is not indirect, fixed group sizes respected
    std::uint32_t layers = 1;  ///< that a raster step draws into at once
};

/// Threads of a group of a compute step, with what the step fixes.
Extent group_size(const PlannedStep&);

/// One access of a step, whatever verb, offer or work it came from.
struct Use {
    std::string_view as;  ///< the binding's name, "attachment", "draw commands", ...
    Access access = Access::none;
    Image image = {};  ///< exactly one of image and buffer exists
    Buffer buffer = {};
    Part part = {};
};
std::vector<Use> uses(const Step&);         ///< as declared: bindings in their order, attachments, what is cleared or copied
std::vector<Use> uses(const PlannedStep&);  ///< ... and the offers its shaders take
/// Whether the step writes the counters of its scope.
bool writes_counters(const Graph&, const PlannedStep&);
/// Every image that the step writes, once.
std::vector<Image> images_written(const Step&);
/// What the step does to the part of the image at once: its layout during the step follows from it.
AccessSet accesses(const PlannedStep&, Image, Part);

/// Memory for one or more images of equal shape that are never alive together, or for one buffer.
struct MemorySlot {
    Shape shape;
    std::uint64_t bytes = 0;
    std::vector<std::uint32_t> images;  ///< ids, in order of their lives
};

struct Plan {
    std::vector<PlannedStep> steps;
    std::vector<MemorySlot> slots;
    std::vector<std::uint32_t> slot_of_image;  ///< by image id; `no_index` for imports and images nobody uses
    std::vector<ImageRecord> images;
    std::vector<BufferRecord> buffers;
    std::vector<Scope> scopes;
    std::vector<std::uint32_t> used_buffers;  ///< ids of created buffers that need memory
    std::vector<Image> kept_images;           ///< what the host reads when the frame is done
    std::vector<Buffer> kept_buffers;
    std::vector<Barrier> final_barriers;  ///< kept images and buffers become readable by the host's copies
    std::vector<CulledStep> culled;
    std::set<std::uint32_t> uncounted_scopes;         ///< of culled steps that would have counted
    std::uint64_t image_bytes = 0, buffer_bytes = 0;  ///< allocated for the frame, imports excluded
};

/// Turns declarations into a plan. Fails with the shader's and the binding's name when they do not fit together.
Result<Plan> compile(const Graph&, const ShaderLibrary&);

}  // namespace strata
