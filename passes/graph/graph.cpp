// Declaring a frame. Handles are checked here, names in compile().
#include "passes/graph/graph.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>

#include <fmt/core.h>

namespace strata {
namespace {

/// A stale handle would silently read what a later step wrote; it is our mistake, in every build.
[[noreturn]] void stop_for_stale_handle(std::string_view name, std::uint32_t has, std::uint32_t newest) {
    fmt::print(stderr, "stale handle of '{}': it is version {}, the newest is {}; pass written images by reference\n", name, has,
               newest);
    std::abort();
}

Step shader_step(std::string name, std::vector<std::string> shaders, Work work) {
    return {.name = std::move(name), .shaders = std::move(shaders), .work = std::move(work)};
}

template <typename Record>
std::uint32_t newest_with_name(const std::vector<Record>& records, std::string_view name) {
    for (std::size_t i = records.size(); i-- > 0;)
        if (records[i].name == name) return static_cast<std::uint32_t>(i);
    return static_cast<std::uint32_t>(records.size());
}

}  // namespace

std::uint64_t bytes(const Shape& shape) {
    std::uint64_t texels = 0;
    for (std::uint32_t mip = 0; mip < shape.mips; ++mip) {
        const auto along = [mip](std::uint32_t size) { return std::uint64_t{std::max(1u, size >> mip)}; };
        texels += along(shape.extent.width) * along(shape.extent.height) * along(shape.extent.depth);
    }
    return texels * shape.layers * shape.samples * row(shape.format).bytes;
}

// ---- builders

template <typename Self>
Step& StepBuilder<Self>::step() {
    return graph_->steps_[step_];
}

template <typename Self>
void StepBuilder<Self>::set_push(std::span<const std::byte> block) {
    step().push.assign(block.begin(), block.end());
}

template <typename Self>
void StepBuilder<Self>::bind(std::string name, Access access, Image image, Buffer buffer, Part part, Filter filter) {
    step().bindings.push_back({std::move(name), access, image, buffer, part, filter});
}

template <typename Self>
Self& StepBuilder<Self>::samples(std::string name, const Image& image, Filter filter, Part part) {
    graph_->check_fresh(image);
    bind(std::move(name), Access::sampled, image, {}, part, filter);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::loads(std::string name, const Image& image, Part part) {
    graph_->check_fresh(image);
    bind(std::move(name), Access::loaded, image, {}, part);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::stores(std::string name, Image& image, Part part) {
    graph_->advance(image);
    bind(std::move(name), Access::stored, image, {}, part);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::updates(std::string name, Image& image, Part part) {
    graph_->advance(image);
    bind(std::move(name), Access::updated, image, {}, part);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::loads(std::string name, const Buffer& buffer) {
    graph_->check_fresh(buffer);
    bind(std::move(name), Access::loaded, {}, buffer);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::stores(std::string name, Buffer& buffer) {
    graph_->advance(buffer);
    bind(std::move(name), Access::stored, {}, buffer);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::updates(std::string name, Buffer& buffer) {
    graph_->advance(buffer);
    bind(std::move(name), Access::updated, {}, buffer);
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::fixes(std::string name, SpecValue value) {
    step().fixed.push_back({std::move(name), value});
    return self();
}

template <typename Self>
Self& StepBuilder<Self>::takes_first(const std::string& prefix) {
    step().offers_first = prefix.empty() ? prefix : prefix + " ";
    return self();
}

ComputeStep& ComputeStep::over(Extent threads) {
    std::get<ComputeWork>(step().work).over = threads;
    return *this;
}

ComputeStep& ComputeStep::groups(Extent count) {
    std::get<ComputeWork>(step().work).groups = count;
    return *this;
}

ComputeStep& ComputeStep::indirect(const Buffer& arguments, std::uint64_t offset) {
    graph_->check_fresh(arguments);
    auto& work = std::get<ComputeWork>(step().work);
    work.arguments = arguments;
    work.arguments_offset = offset;
    bind("group counts", Access::indirect, {}, arguments);
    return *this;
}

template <typename Self>
Self& RasterBuilder<Self>::attach(Access access, Image& image, Part part, Blend blend) {
    this->graph_->advance(image);
    this->step().attachments.push_back({access, image, part, blend});
    return this->self();
}

template <typename Self>
Self& RasterBuilder<Self>::covers(Image& image, Part part) {
    return attach(Access::color_written, image, part, Blend::none);
}

template <typename Self>
Self& RasterBuilder<Self>::adds_to(Image& image, Part part) {
    return attach(Access::color_blended, image, part, Blend::add);
}

template <typename Self>
Self& RasterBuilder<Self>::multiplies(Image& image, Part part) {
    return attach(Access::color_blended, image, part, Blend::multiply);
}

template <typename Self>
Self& RasterBuilder<Self>::composites(Image& image, Part part) {
    return attach(Access::color_blended, image, part, Blend::dual_source_over);
}

template <typename Self>
Self& RasterBuilder<Self>::composites_gray(Image& image, Part part) {
    return attach(Access::color_blended, image, part, Blend::alpha_over);
}

template <typename Self>
Self& RasterBuilder<Self>::tests_depth(const Image& image, Part part) {
    this->graph_->check_fresh(image);
    this->step().attachments.push_back({Access::depth_tested, image, part, Blend::none});
    return this->self();
}

template <typename Self>
Self& RasterBuilder<Self>::writes_depth(Image& image, Part part) {
    return attach(Access::depth_written, image, part, Blend::none);
}

template <typename Self>
Self& RasterBuilder<Self>::drops_other_colors() {
    this->step().drops_other_colors = true;
    return this->self();
}

template <typename Self>
Self& RasterBuilder<Self>::within(Extent pixels) {
    Work& work = this->step().work;
    if (auto* draw = std::get_if<DrawWork>(&work)) draw->viewport = pixels;
    if (auto* fullscreen = std::get_if<FullscreenWork>(&work)) fullscreen->viewport = pixels;
    return this->self();
}

DrawStep& DrawStep::culls(Cull side) {
    std::get<DrawWork>(step().work).cull = side;
    return *this;
}

DrawStep& DrawStep::covers_by_alpha() {
    std::get<DrawWork>(step().work).alpha_to_coverage = true;
    return *this;
}

DrawStep& DrawStep::at_equal_depth() {
    std::get<DrawWork>(step().work).at_equal_depth = true;
    return *this;
}

DrawStep& DrawStep::in_rows(Rows rows) {
    std::get<DrawWork>(step().work).rows = rows;
    return *this;
}

DrawStep& DrawStep::in_columns(PixelColumns columns) {
    std::get<DrawWork>(step().work).columns = columns;
    return *this;
}

DrawStep& DrawStep::geometry(std::string shader) {
    std::vector<std::string>& shaders = step().shaders;
    shaders.front() = shader + ".vert";
    shaders.insert(shaders.begin() + 1, shader + ".geom");
    return *this;
}

DrawStep& DrawStep::counted(const Buffer& count, std::uint64_t offset) {
    graph_->check_fresh(count);
    auto& work = std::get<DrawWork>(step().work);
    work.count = count;
    work.count_offset = offset;
    bind("draw count", Access::indirect, {}, count);
    return *this;
}

template class StepBuilder<ComputeStep>;
template class StepBuilder<DrawStep>;
template class StepBuilder<FullscreenStep>;
template class RasterBuilder<DrawStep>;
template class RasterBuilder<FullscreenStep>;

// ---- graph

void Graph::check_fresh(Image image) const {
    if (image && image.version != record(image).version)
        stop_for_stale_handle(record(image).name, image.version, record(image).version);
}

void Graph::check_fresh(Buffer buffer) const {
    if (buffer && buffer.version != record(buffer).version)
        stop_for_stale_handle(record(buffer).name, buffer.version, record(buffer).version);
}

void Graph::advance(Image& image) {
    check_fresh(image);
    if (image) image.version = ++images_[image.id].version;
}

void Graph::advance(Buffer& buffer) {
    check_fresh(buffer);
    if (buffer) buffer.version = ++buffers_[buffer.id].version;
}

std::size_t Graph::append(Step step) {
    step.scope = static_cast<std::uint32_t>(scopes_.size() - 1);
    steps_.push_back(std::move(step));
    return steps_.size() - 1;
}

std::string text_of(const Scope& scope) {
    const auto at = stage_names[static_cast<std::size_t>(scope.at)];
    switch (scope.kind) {
        case ScopeKind::frame:
            return "frame";
        case ScopeKind::pass:
            return fmt::format("{}: {}", at, scope.technique);
        case ScopeKind::memo:
            return fmt::format("memo: {}: {}", at, scope.technique);
        case ScopeKind::given:
            return fmt::format("given: {}: {}", at, scope.technique);
        case ScopeKind::view:
            return fmt::format("view: {}:{}", scope.technique, scope.view);
    }
    return "";
}

void Graph::enter(Scope scope, std::uint64_t counter_bytes) {
    scopes_.push_back(std::move(scope));
    if (counter_bytes == 0) return;
    const Scope& entered = scopes_.back();
    Buffer counters = create(fmt::format("counters of {}{}{}", entered.technique, entered.view.empty() ? "" : ":", entered.view),
                             counter_bytes);
    buffers_[counters.id].weak = true;
    clear(counters, 0);
    offers_.push_back({"Counters", counters, static_cast<std::uint32_t>(scopes_.size() - 1)});
    keep(counters);
}

Buffer Graph::counters(std::uint32_t scope) const {
    const auto offer = std::ranges::find(offers_, std::optional(scope), &Offer::scope);
    return offer == offers_.end() ? Buffer{} : offer->buffer;
}

Image Graph::create(std::string name, Shape shape) {
    images_.push_back({.name = std::move(name), .shape = shape});
    return {static_cast<std::uint32_t>(images_.size() - 1), 0};
}

Image Graph::import(std::string name, Shape shape, ImportId id) {
    images_.push_back({.name = std::move(name), .shape = shape, .import = id});
    return {static_cast<std::uint32_t>(images_.size() - 1), 0};
}

Buffer Graph::create(std::string name, std::uint64_t size) {
    buffers_.push_back({.name = std::move(name), .bytes = size});
    return {static_cast<std::uint32_t>(buffers_.size() - 1), 0};
}

Buffer Graph::import(std::string name, std::uint64_t size, ImportId id) {
    buffers_.push_back({.name = std::move(name), .bytes = size, .import = id});
    return {static_cast<std::uint32_t>(buffers_.size() - 1), 0};
}

Buffer Graph::remember(std::string name, std::uint64_t size, Remembered as) {
    const std::uint64_t of_host = std::uint64_t(1) << 63;  // keys that nobody counts up to
    const std::uint64_t key = std::hash<std::string>()(fmt::format("{} {} {}", name, size, as == Remembered::work)) | of_host;
    const Buffer buffer = import(std::move(name), size, {key});
    buffers_.back().remembered = as;
    return buffer;
}

ComputeStep Graph::compute(std::string shader) {
    std::vector<std::string> shaders{shader};
    return {*this, append(shader_step(std::move(shader), std::move(shaders), ComputeWork{}))};
}

DrawStep Graph::draw(std::string shader, DrawList list) {
    check_fresh(list.commands);
    check_fresh(list.indices);
    Step step = shader_step(shader, {shader + ".vert", shader + ".frag"}, DrawWork{.list = list});
    if (list.commands) step.bindings.push_back({.name = "draw commands", .access = Access::indirect, .buffer = list.commands});
    if (list.indices) step.bindings.push_back({.name = "indices", .access = Access::indexed, .buffer = list.indices});
    return {*this, append(std::move(step))};
}

FullscreenStep Graph::fullscreen(std::string shader) {
    return {*this, append(shader_step(shader, {"shaders/fullscreen.vert", shader + ".frag"}, FullscreenWork{}))};
}

void Graph::clear(Image& image, ClearValue value) {
    advance(image);
    append(shader_step("clear " + record(image).name, {}, ClearWork{.image = image, .value = value}));
}

void Graph::clear(Buffer& buffer, std::uint32_t word) {
    advance(buffer);
    append(shader_step("clear " + record(buffer).name, {},
                       ClearWork{.buffer = buffer, .value = {{static_cast<double>(word), 0, 0, 0}}}));
}

void Graph::copy(const Image& from, Image& to) {
    check_fresh(from);
    advance(to);
    append(shader_step("copy " + record(from).name + " to " + record(to).name, {}, CopyWork{.from = from, .to = to}));
}

void Graph::copy(const Buffer& from, Buffer& to) {
    check_fresh(from);
    advance(to);
    append(
        shader_step("copy " + record(from).name + " to " + record(to).name, {}, CopyWork{.buffer_from = from, .buffer_to = to}));
}

void Graph::keep(Image image) {
    const auto same = [&](Image kept) { return kept.id == image.id; };
    if (image && std::ranges::none_of(kept_images_, same)) kept_images_.push_back(image);
}

void Graph::keep(Buffer buffer) {
    const auto same = [&](Buffer kept) { return kept.id == buffer.id; };
    if (buffer && std::ranges::none_of(kept_buffers_, same)) kept_buffers_.push_back(buffer);
}

void Graph::leave_out(std::string product, std::string reason) {
    left_out_.push_back({scopes_.back(), std::move(product), std::move(reason)});
}

void Graph::offer(std::string name, Buffer buffer) { offers_.push_back({std::move(name), buffer, std::nullopt}); }

Image Graph::find_image(std::string_view name) const {
    const std::uint32_t id = newest_with_name(images_, name);
    return id < images_.size() ? Image{id, images_[id].version} : Image{};
}

Buffer Graph::find_buffer(std::string_view name) const {
    const std::uint32_t id = newest_with_name(buffers_, name);
    return id < buffers_.size() ? Buffer{id, buffers_[id].version} : Buffer{};
}

void Graph::drop_scope(std::uint32_t scope) {
    std::erase_if(steps_, [scope](const Step& step) { return step.scope == scope; });
}

}  // namespace strata
