// Declares a frame: images, buffers and the steps that touch them. The verb is the access; nothing here runs.
// Order of declaration is order of execution. Names given to bindings are the shader's own and are checked in compile().
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "passes/graph/access.h"
#include "passes/graph/format.h"

namespace strata {

struct Extent {
    std::uint32_t width = 1, height = 1, depth = 1;
    friend bool operator==(const Extent&, const Extent&) = default;
};

/// Size and format of an image. depth > 1 makes it 3D; layers make it an array; samples is 1 or 4.
struct Shape {
    Extent extent;
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

/// Which mip and layer of an image a binding means; all of them where nothing is said.
struct Part {
    std::optional<std::uint32_t> mip, layer;
    friend bool operator==(const Part&, const Part&) = default;
};

enum class Filter : std::uint32_t { nearest, linear };
enum class Blend : std::uint32_t { none, add, multiply, dual_source_over, max, min };
/// What a draw's pipeline does with depth: reversed Z, so nearer is GREATER_OR_EQUAL.
enum class DepthUse : std::uint32_t { none, test, test_and_write };
enum class Cull : std::uint32_t { none, back, front };

/// A run of indexed indirect draw commands over the scene's vertices (VkDrawIndexedIndirectCommand, 20 bytes each).
struct DrawList {
    Buffer commands, indices;
    std::uint32_t first = 0, count = 0;
};

/// Resources that outlive the frame are known to the executor by such a key.
struct ImportId {
    std::uint64_t key = 0;
};

struct ImageRecord {
    std::string name;
    Shape shape;
    std::uint32_t version = 0;
    std::optional<ImportId> import;
};

struct BufferRecord {
    std::string name;
    std::uint64_t bytes = 0;
    std::uint32_t version = 0;
    std::optional<ImportId> import;
    bool weak = false;  ///< writing it keeps no step alive (counters)
};

using SpecValue = std::variant<std::uint32_t, std::int32_t, float>;
struct Fixed {
    std::string name;
    SpecValue value;
};

/// A shader binding by name: a variable's name for images, the block's name for buffers. Exactly one of image and buffer is meant; neither means "the 1x1 zero".
struct Binding {
    std::string name;
    Access access = Access::none;
    Image image;
    Buffer buffer;
    Part part;
    Filter filter = Filter::nearest;
};

struct Attachment {
    Access access = Access::color_written;
    Image image;
    Part part;
    Blend blend = Blend::none;
};

/// Up to four numbers an image or buffer is set to; integers for integer formats.
struct ClearValue {
    std::array<double, 4> value{};
};

struct ComputeWork {
    std::optional<Extent> over;            ///< threads; groups follow from the shader's group size
    std::optional<Extent> groups;
    Buffer arguments;                      ///< indirect when it exists
    std::uint64_t arguments_offset = 0;
};
struct DrawWork {
    DrawList list;
    Buffer count;                          ///< how many of list.count to draw, when it exists
    std::uint64_t count_offset = 0;
    Cull cull = Cull::none;
    std::optional<Extent> viewport;        ///< without attachments, or smaller than them
};
struct FullscreenWork {
    std::optional<Extent> viewport;
};
struct CopyWork {
    Image from, to;
    Buffer buffer_from, buffer_to;
};
struct ClearWork {
    Image image;
    Buffer buffer;
    ClearValue value;
};
using Work = std::variant<ComputeWork, DrawWork, FullscreenWork, CopyWork, ClearWork>;

/// One step as declared. `shaders` are names in the ShaderLibrary: one .comp, or a .vert and a .frag.
struct Step {
    std::string name;                      ///< the shader's name, or "clear X", "copy X to Y"
    std::uint32_t scope = 0;               ///< index into Graph::scopes
    std::vector<std::string> shaders;
    Work work;
    std::vector<Binding> bindings;
    std::vector<Attachment> attachments;   ///< colors in order; depth may stand anywhere
    std::vector<std::byte> push;
    std::vector<Fixed> fixed;
};

/// Whose steps they are: a stage with its technique.
struct Scope {
    std::string name;                      ///< "transparency: transparency/weighted"
    std::uint32_t stage = 0;
    Buffer counters;
};

class Graph;

/// What computes, draws and full-screen passes have in common. Chain the verbs.
template <typename Self>
class StepBuilder {
public:
    StepBuilder(Graph& graph, std::size_t step) : graph_(&graph), step_(step) {}

    Self& samples(std::string name, const Image&, Filter = Filter::nearest, Part = {});
    Self& loads(std::string name, const Image&, Part = {});
    Self& stores(std::string name, Image&, Part = {});
    Self& updates(std::string name, Image&, Part = {});
    Self& loads(std::string name, const Buffer&);
    Self& stores(std::string name, Buffer&);
    Self& updates(std::string name, Buffer&);
    /// Sets a specialization constant by its name in the shader.
    Self& fixes(std::string name, SpecValue);
    /// The push constant block: its size is checked against the shader's.
    template <typename T>
    Self& push(const T& block) {
        static_assert(std::is_trivially_copyable_v<T>);
        set_push(std::as_bytes(std::span(&block, 1)));
        return self();
    }

protected:
    Self& self() { return static_cast<Self&>(*this); }
    Step& step();
    void set_push(std::span<const std::byte>);
    void bind(std::string name, Access, Image, Buffer, Part = {}, Filter = Filter::nearest);

    Graph* graph_;
    std::size_t step_;
};

class ComputePass : public StepBuilder<ComputePass> {
public:
    using StepBuilder::StepBuilder;
    /// One thread per texel of the extent.
    ComputePass& over(Extent);
    ComputePass& groups(Extent);
    /// Three uint32 group counts at the offset.
    ComputePass& indirect(const Buffer& arguments, std::uint64_t offset = 0);
};

/// Color attachments stand in the order of their verbs: the first is location 0.
template <typename Self>
class RasterBuilder : public StepBuilder<Self> {
public:
    using StepBuilder<Self>::StepBuilder;
    Self& covers(Image&, Part = {});
    Self& adds_to(Image&, Part = {});
    Self& multiplies(Image&, Part = {});
    /// dst = src0 + dst * src1, per channel: alpha blending with a transmittance per channel.
    Self& composites(Image&, Part = {});
    Self& tests_depth(const Image&, Part = {});
    Self& writes_depth(Image&, Part = {});
    /// Pixels drawn: needed without attachments.
    Self& within(Extent);

protected:
    Self& attach(Access, Image&, Part, Blend);
};

class DrawPass : public RasterBuilder<DrawPass> {
public:
    using RasterBuilder::RasterBuilder;
    DrawPass& culls(Cull);
    /// Only the first *count of the list's commands.
    DrawPass& counted(const Buffer& count, std::uint64_t offset = 0);
};

class FullscreenPass : public RasterBuilder<FullscreenPass> {
public:
    using RasterBuilder::RasterBuilder;
};

extern template class StepBuilder<ComputePass>;
extern template class StepBuilder<DrawPass>;
extern template class StepBuilder<FullscreenPass>;
extern template class RasterBuilder<DrawPass>;
extern template class RasterBuilder<FullscreenPass>;

class Graph {
public:
    /// Steps declared from here on belong to this scope. counter_bytes > 0 makes a zeroed buffer offered as "Counters".
    void enter(std::string scope, std::uint32_t stage, std::uint64_t counter_bytes = 0);

    Image create(std::string name, Shape);
    Image import(std::string name, Shape, ImportId);
    Buffer create(std::string name, std::uint64_t bytes);
    Buffer import(std::string name, std::uint64_t bytes, ImportId);

    /// A .comp shader by its path below passes/, without "passes/": "transparency/weighted/resolve.comp".
    ComputePass compute(std::string shader);
    /// A fragment shader by its path without ".frag"; the vertex shader is the one beside it or "shaders/draw.vert".
    DrawPass draw(std::string shader, DrawList);
    /// A fragment shader over every pixel.
    FullscreenPass fullscreen(std::string shader);
    void clear(Image&, ClearValue);
    void clear(Buffer&, std::uint32_t word);
    void copy(const Image& from, Image& to);
    void copy(const Buffer& from, Buffer& to);

    /// What the frame is for; whatever feeds nothing kept is culled.
    void keep(Image);
    void keep(Buffer);
    /// Bound wherever a shader declares the name and the step does not bind it (scene buffers, the view, counters).
    void offer(std::string name, Buffer);

    const ImageRecord& record(Image image) const { return images_[image.id]; }
    const Shape& shape(Image image) const { return images_[image.id].shape; }
    const BufferRecord& record(Buffer buffer) const { return buffers_[buffer.id]; }
    /// The newest version of the image with this name, or no image.
    Image find_image(std::string_view name) const;
    Buffer find_buffer(std::string_view name) const;

    std::span<const ImageRecord> images() const { return images_; }
    std::span<const BufferRecord> buffers() const { return buffers_; }
    std::span<const Step> steps() const { return steps_; }
    std::span<const Scope> scopes() const { return scopes_; }
    std::span<const Image> kept_images() const { return kept_images_; }
    std::span<const Buffer> kept_buffers() const { return kept_buffers_; }
    struct Offer {
        std::string name;
        Buffer buffer;
        std::optional<std::uint32_t> scope;  ///< counters are offered to their scope alone
    };
    std::span<const Offer> offers() const { return offers_; }

    /// Takes out the steps of a scope (their outputs then come from elsewhere: the memo).
    void drop_scope(std::uint32_t scope);

private:
    template <typename Self>
    friend class StepBuilder;
    template <typename Self>
    friend class RasterBuilder;
    friend class ComputePass;
    friend class DrawPass;

    std::size_t append(Step);
    /// Asserts that the handle is the newest version.
    void check_fresh(Image) const;
    void check_fresh(Buffer) const;
    /// Makes the handle the next version.
    void advance(Image&);
    void advance(Buffer&);

    std::vector<ImageRecord> images_;
    std::vector<BufferRecord> buffers_;
    std::vector<Step> steps_;
    std::vector<Scope> scopes_{{"frame", 0, {}}};
    std::vector<Image> kept_images_;
    std::vector<Buffer> kept_buffers_;
    std::vector<Offer> offers_;
};

}  // namespace strata
