// What a step is made of: handles, shapes, bindings, attachments and work. Plain values; Graph fills them, compile() reads them.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passes/graph/access.h"
#include "passes/graph/format.h"
#include "passes/stage.h"

namespace strata {

struct Extent {
    std::uint32_t width = 1, height = 1, depth = 1;
    friend bool operator==(const Extent&, const Extent&) = default;
};

/// Size and format of an image. depth > 1 makes it 3D; layers make it an array; samples is 1 or 4.
struct Shape {
    Extent extent = {};
    Format format = Format::rgba16f;
    std::uint32_t layers = 1, mips = 1, samples = 1;
    friend bool operator==(const Shape&, const Shape&) = default;
};

std::uint64_t bytes(const Shape&);

/// A handle to one version of an image. Default-constructed: no image; a shader that declares it gets a 1x1 zero instead.
struct Image {
    std::uint32_t id = 0xffffffffu, version = 0;
    explicit operator bool() const { return id != 0xffffffffu; }
    friend bool operator==(const Image&, const Image&) = default;
};

/// A handle to one version of a buffer.
struct Buffer {
    std::uint32_t id = 0xffffffffu, version = 0;
    explicit operator bool() const { return id != 0xffffffffu; }
    friend bool operator==(const Buffer&, const Buffer&) = default;
};

/// Rows of pixels that lie together.
struct Rows {
    std::uint32_t first = 0, count = 0;
    friend bool operator==(const Rows&, const Rows&) = default;
};

/// Columns of pixels that lie together.
struct PixelColumns {
    std::uint32_t first = 0, count = 0;
    friend bool operator==(const PixelColumns&, const PixelColumns&) = default;
};

/// Which mip and layer of an image a binding means; all of them where nothing is said.
struct Part {
    std::optional<std::uint32_t> mip = {}, layer = {};
    friend bool operator==(const Part&, const Part&) = default;
};

enum class Filter : std::uint32_t { nearest, linear };
enum class Blend : std::uint32_t { none, add, multiply, dual_source_over, max, min, alpha_over };
/// What a draw's pipeline does with depth: reversed Z, so nearer is GREATER_OR_EQUAL. test_equal compares with EQUAL.
enum class DepthUse : std::uint32_t { none, test, test_and_write, test_equal };
enum class Cull : std::uint32_t { none, back, front };

/// A run of indirect draw commands over the scene's vertices, 20 bytes each: VkDrawIndexedIndirectCommand, or without an index
/// buffer VkDrawIndirectCommand and a word that is not read.
struct DrawList {
    Buffer commands = {}, indices = {};
    std::uint32_t first = 0, count = 0;
    bool of_places = false;  ///< its vertices are places in the scene's indices: for numbered_draw.vert and its like
};

/// Resources that outlive the frame are known to the executor by such a key.
struct ImportId {
    std::uint64_t key = 0;
};

struct ImageRecord {
    std::string name;
    Shape shape;
    std::uint32_t version = 0;
    std::optional<ImportId> import = {};
};

/// The use that a frame makes of a buffer that the one before it left.
enum class Remembered {
    history,  ///< shows it: what the frame gives depends on it
    work,     ///< does it once: the frame costs less, and gives the same
};

struct BufferRecord {
    std::string name;
    std::uint64_t bytes = 0;
    std::uint32_t version = 0;
    std::optional<ImportId> import = {};
    bool weak = false;                          ///< writing it keeps no step alive (counters)
    std::optional<Remembered> remembered = {};  ///< outlives the frame: see Graph::remember
};

using SpecValue = std::variant<std::uint32_t, std::int32_t, float>;
struct Fixed {
    std::string name;
    SpecValue value;
};

/// A shader binding by name: a variable's name for images, the block's name for buffers. Exactly one of image and buffer is
/// meant; neither means "the 1x1 zero".
struct Binding {
    std::string name;
    Access access = Access::none;
    Image image = {};
    Buffer buffer = {};
    Part part = {};
    Filter filter = Filter::nearest;
};

struct Attachment {
    Access access = Access::color_written;
    Image image = {};
    Part part = {};
    Blend blend = Blend::none;
};

/// Up to four numbers an image or buffer is set to; integers for integer formats.
struct ClearValue {
    std::array<double, 4> value{};
};

struct ComputeWork {
    std::optional<Extent> over = {};  ///< threads; groups follow from the shader's group size
    std::optional<Extent> groups = {};
    Buffer arguments = {};  ///< indirect when it exists
    std::uint64_t arguments_offset = 0;
};
struct DrawWork {
    DrawList list = {};
    Buffer count = {};               ///< how many of list.count to draw, when it exists
    bool alpha_to_coverage = false;  ///< the device makes coverage of color 0's alpha
    bool at_equal_depth = false;     ///< depth is tested by EQUAL
    std::uint64_t count_offset = 0;
    Cull cull = Cull::none;
    std::optional<Extent> viewport = {};  ///< without attachments, or smaller than them
    std::optional<Rows> rows = {};        ///< the scissor, with columns
    std::optional<PixelColumns> columns = {};
};
struct FullscreenWork {
    std::optional<Extent> viewport = {};
};
struct CopyWork {
    Image from = {}, to = {};
    Buffer buffer_from = {}, buffer_to = {};
};
struct ClearWork {
    Image image = {};
    Buffer buffer = {};
    ClearValue value = {};
};
using Work = std::variant<ComputeWork, DrawWork, FullscreenWork, CopyWork, ClearWork>;

/// One step as declared. `shaders` are names in the ShaderLibrary: one .comp, or a .vert, perhaps a .geom, and a .frag.
struct Step {
    std::string name;         ///< the shader's name, or "clear X", "copy X to Y"
    std::uint32_t scope = 0;  ///< index into Graph::scopes
    std::vector<std::string> shaders = {};
    Work work = {};
    std::vector<Binding> bindings = {};
    std::vector<Attachment> attachments = {};  ///< colors in order; depth may stand anywhere
    bool drops_other_colors = false;           ///< the shader may write more colors than there are attachments
    std::vector<std::byte> push = {};
    std::vector<Fixed> fixed = {};
    std::string offers_first = {};  ///< what is offered under this and a block's name comes before what its name alone offers
};

/// What the steps of a scope are for.
enum class ScopeKind : std::uint32_t {
    frame,  ///< everything declared before the first pass
    pass,   ///< a pass of a technique, at its own stage or at another one
    memo,   ///< copies a pass's images to or from the memo
    given,  ///< stores images that somebody gave in the place of a pass's
    view,   ///< makes a debug view or a debug table
};

/// Which technique some steps belong to, and what they are for.
struct Scope {
    ScopeKind kind = ScopeKind::frame;
    Stage stage = {};  ///< the technique's own stage
    Stage at = {};     ///< the place of a pass in the frame: another stage than its own for what Technique::at_other_stages lists
    std::string technique = {};  ///< "transparency/weighted"
    std::string view = {};       ///< the name of a view or table
    friend auto operator<=>(const Scope&, const Scope&) = default;
};

/// A step that does not run in a frame, or a product with all its steps.
struct CulledStep {
    Scope scope;
    std::string name, reason;
};

/// For people: "transparency: transparency/weighted", "memo: shadows: shadows/pcf", "view: lighting/tiled:depth", "frame".
std::string text_of(const Scope&);
/// Whether the scope is a pass of this technique, at its own stage or at another one.
inline bool is_pass_of(const Scope& scope, std::string_view technique) {
    return scope.kind == ScopeKind::pass && scope.technique == technique;
}

}  // namespace strata
