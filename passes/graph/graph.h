// Declares a frame: images, buffers and the steps that touch them. The verb is the access; nothing here runs.
// Order of declaration is order of execution. Names given to bindings are the shader's own and are checked in compile().
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "passes/graph/step.h"

namespace strata {

class Graph;

/// What computes, draws and full-screen draws have in common. Chain the verbs.
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
    /// Takes the offer of "prefix name" before that of "name"; with an empty prefix that of "name" alone.
    Self& takes_first(const std::string& prefix);
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

class ComputeStep : public StepBuilder<ComputeStep> {
public:
    using StepBuilder::StepBuilder;
    /// One thread per texel of the extent.
    ComputeStep& over(Extent);
    ComputeStep& groups(Extent);
    /// Three uint32 group counts at the offset.
    ComputeStep& indirect(const Buffer& arguments, std::uint64_t offset = 0);
};

/// Color attachments stand in the order of their verbs: the first is location 0. Attachments of several layers of which no part
/// names one are drawn into all at once, each triangle into the layer that the last shader before the fragments writes to
/// gl_Layer.
template <typename Self>
class RasterBuilder : public StepBuilder<Self> {
public:
    using StepBuilder<Self>::StepBuilder;
    Self& covers(Image&, Part = {});
    Self& adds_to(Image&, Part = {});
    Self& multiplies(Image&, Part = {});
    /// dst = src0 + dst * src1, per channel: alpha blending with a transmittance per channel.
    Self& composites(Image&, Part = {});
    /// dst = src + dst * src.a; the alpha of dst stays. The same for one transmittance, without dual-source blending.
    Self& composites_gray(Image&, Part = {});
    Self& tests_depth(const Image&, Part = {});
    Self& writes_depth(Image&, Part = {});
    /// The shader's outputs beyond the attachments go nowhere: one shader for more targets and for fewer.
    Self& drops_other_colors();
    /// Pixels drawn: needed without attachments.
    Self& within(Extent);

protected:
    Self& attach(Access, Image&, Part, Blend);
};

class DrawStep : public RasterBuilder<DrawStep> {
public:
    using RasterBuilder::RasterBuilder;
    DrawStep& culls(Cull);
    /// Alpha to coverage: the alpha of color 0, which needs no attachment, says how many samples of a pixel are drawn. How many
    /// of which is the device's choice.
    DrawStep& covers_by_alpha();
    /// With tests_depth(): draws only where depth is the draw's own to the last bit, as a draw of the same list has left it.
    DrawStep& at_equal_depth();
    /// Draws these rows of the attachments alone: a scissor, which spares all fragments of others. lavapipe 22.3 lets the lower
    /// samples of the row above through where pixels have several, so the shader must leave out rows above the first.
    DrawStep& in_rows(Rows);
    /// Draws these columns alone, of those rows or of all.
    DrawStep& in_columns(PixelColumns);
    /// A geometry shader by its path without ".geom", between the fragment shader and the vertex shader beside itself.
    DrawStep& geometry(std::string shader);
    /// Only the first *count of the list's commands.
    DrawStep& counted(const Buffer& count, std::uint64_t offset = 0);
};

class FullscreenStep : public RasterBuilder<FullscreenStep> {
public:
    using RasterBuilder::RasterBuilder;
};

extern template class StepBuilder<ComputeStep>;
extern template class StepBuilder<DrawStep>;
extern template class StepBuilder<FullscreenStep>;
extern template class RasterBuilder<DrawStep>;
extern template class RasterBuilder<FullscreenStep>;

class Graph {
public:
    /// Steps declared from here on belong to this scope. counter_bytes > 0 makes a zeroed buffer offered as "Counters".
    void enter(Scope, std::uint64_t counter_bytes = 0);
    /// The buffer that enter() made for a scope, or no buffer.
    Buffer counters(std::uint32_t scope) const;

    Image create(std::string name, Shape);
    Image import(std::string name, Shape, ImportId);
    Buffer create(std::string name, std::uint64_t bytes);
    Buffer import(std::string name, std::uint64_t bytes, ImportId);
    /// A buffer that frames leave to the next: zero in a session's first run, then as the last run that declared the same left
    /// it.
    Buffer remember(std::string name, std::uint64_t bytes, Remembered = Remembered::history);

    /// A .comp shader by its path below passes/, without "passes/": "transparency/weighted/resolve.comp".
    ComputeStep compute(std::string shader);
    /// A fragment shader by its path without ".frag"; the vertex shader is the one beside it or "shaders/draw.vert".
    DrawStep draw(std::string shader, DrawList);
    /// A fragment shader over every pixel.
    FullscreenStep fullscreen(std::string shader);
    void clear(Image&, ClearValue);
    void clear(Buffer&, std::uint32_t word);
    void copy(const Image& from, Image& to);
    void copy(const Buffer& from, Buffer& to);

    /// What the frame is for; whatever feeds nothing kept is culled. Counters are kept by enter(). No image: nothing happens.
    void keep(Image);
    void keep(Buffer);
    /// From here on, steps that count into these counters of enter() are not culled.
    void keep_counting(Buffer counters) { buffers_[counters.id].weak = false; }
    /// A product of this scope without a reader, whose steps were not declared: plans list it.
    void leave_out(std::string product, std::string reason);
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

    std::span<const CulledStep> left_out() const { return left_out_; }

    /// Takes out the steps of a scope (their outputs then come from elsewhere: the memo).
    void drop_scope(std::uint32_t scope);

private:
    template <typename Self>
    friend class StepBuilder;
    template <typename Self>
    friend class RasterBuilder;
    friend class ComputeStep;
    friend class DrawStep;

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
    std::vector<Scope> scopes_{Scope{}};
    std::vector<Image> kept_images_;
    std::vector<Buffer> kept_buffers_;
    std::vector<Offer> offers_;
    std::vector<CulledStep> left_out_;
};

}  // namespace strata
