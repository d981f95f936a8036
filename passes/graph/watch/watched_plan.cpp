#include "passes/graph/watch/watched_plan.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <map>

#include "passes/graph/reached_code.h"
#include "passes/graph/watch/mark_regions.h"
#include "passes/graph/watch/watched_code.h"

namespace strata {
namespace {

/// Import ids above those of scenes, given outputs, the memo and remembered buffers.
constexpr std::uint64_t first_watch_import = std::uint64_t{0x57a7c} << 40;

constexpr std::uint32_t picture = ~0u;  ///< the host, as a reader

struct Product {
    bool is_image = false;
    std::uint32_t id = 0, maker = 0;
    std::string name;
    Shape shape;  ///< of an image
    std::uint64_t units = 0, unit_bytes = 4;
    std::vector<std::size_t> writers;
    MarkRegion made;
    std::map<std::uint32_t, MarkRegion> read_by;  ///< by scope
};

using ProductKey = std::pair<bool, std::uint32_t>;
ProductKey key_of(const Use& use) { return use.image ? ProductKey{true, use.image.id} : ProductKey{false, use.buffer.id}; }

bool is_clear(const PlannedStep& planned) { return std::holds_alternative<ClearWork>(planned.step.work); }

/// Ids of the buffers that techniques count into.
std::vector<std::uint32_t> counter_buffers(const Plan& plan) {
    std::vector<std::uint32_t> ids;
    for (const PlannedStep& planned : plan.steps)
        for (const PlannedBinding& bound : planned.bindings)
            if (bound.binding.name == "Counters" && bound.binding.buffer) ids.push_back(bound.binding.buffer.id);
    return ids;
}

Product product_of(const Plan& plan, const ProductKey& key) {
    Product made{.is_image = key.first, .id = key.second};
    if (made.is_image) {
        const ImageRecord& image = plan.images[made.id];
        made.name = image.name;
        made.shape = image.shape;
        const Extent& extent = image.shape.extent;
        made.units = std::uint64_t{extent.width} * extent.height * image.shape.layers * image.shape.samples;
        made.unit_bytes = bytes(image.shape) / std::max<std::uint64_t>(1, made.units);
    } else {
        made.name = plan.buffers[made.id].name;
        made.units = (plan.buffers[made.id].bytes + 3) / 4;
    }
    made.made.units = made.units;
    return made;
}

TexelBox whole(const Shape& shape, Part part) {
    return {.columns = shape.extent.width,
            .rows = shape.extent.height,
            .first_layer = part.layer.value_or(0),
            .layers = part.layer ? 1 : shape.layers};
}

/// Texels of an attachment that a step may draw.
TexelBox drawn_area(const Shape& shape, const PlannedStep& planned, Part part) {
    TexelBox box = whole(shape, part);
    const auto limit = [&](const std::optional<Extent>& viewport) {
        if (viewport) box.columns = std::min(box.columns, viewport->width), box.rows = std::min(box.rows, viewport->height);
    };
    if (const auto* fullscreen = std::get_if<FullscreenWork>(&planned.step.work)) limit(fullscreen->viewport);
    if (const auto* draw = std::get_if<DrawWork>(&planned.step.work)) {
        limit(draw->viewport);
        if (draw->rows) box.first_row = draw->rows->first, box.rows = draw->rows->count;
        if (draw->columns) box.first_column = draw->columns->first, box.columns = draw->columns->count;
    }
    return box;
}

bool chooses_layer(const PlannedStep& planned) {
    return std::ranges::any_of(planned.shaders, [](const Shader* shader) { return shader->chooses_layer; });
}

std::vector<std::byte> bytes_of(std::span<const MarkPlace> places) {
    std::vector<std::byte> bytes(places.size_bytes());
    std::memcpy(bytes.data(), places.data(), bytes.size());
    return bytes;
}

}  // namespace

struct WatchedPlan::Parts {
    explicit Parts(const Plan& from) : plan(from) {}

    void find_products();
    void add_uses();
    void place_regions();
    Result<void> watch_steps();
    Result<void> watch_step(PlannedStep&);
    Result<const Shader*> watched(const Shader&, const Step&, const Watched&);
    Product* find(const Use&);
    /// The region of a step's reads of a product, or null where they do not count.
    MarkRegion* reading(Product&, const PlannedStep&);
    void add_static_uses(const PlannedStep&);
    void add_use_of_bindings(const PlannedStep&);
    Buffer import_buffer(std::string name, std::vector<std::byte>);

    Plan plan;
    std::vector<Product> products;  ///< in the order in which they are first written
    std::map<ProductKey, std::size_t> places;
    std::vector<Upload> uploads;
    Buffer marks;
    std::uint32_t set = 0;
    std::uint64_t mark_words = 0;
    std::deque<std::vector<std::uint32_t>> codes;
    std::deque<Shader> shaders;
    std::map<std::pair<std::vector<std::uint32_t>, Watched>, const Shader*> known;
};

void WatchedPlan::Parts::find_products() {
    const std::vector<std::uint32_t> counters = counter_buffers(plan);
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        if (is_clear(plan.steps[i])) continue;
        for (const Use& use : strata::uses(plan.steps[i])) {
            const bool counts = use.buffer && std::ranges::count(counters, use.buffer.id) > 0;
            if (!writes(use.access) || counts) continue;
            const ProductKey key = key_of(use);
            if (key.first && (plan.images[key.second].shape.mips > 1 || plan.images[key.second].shape.extent.depth > 1)) continue;
            if (!places.contains(key)) {
                places[key] = products.size();
                products.push_back(product_of(plan, key));
                products.back().maker = plan.steps[i].step.scope;
            }
            Product& product = products[places[key]];
            if (product.writers.empty() || product.writers.back() != i) product.writers.push_back(i);
        }
    }
}

Product* WatchedPlan::Parts::find(const Use& use) {
    const auto found = places.find(key_of(use));
    return found == places.end() ? nullptr : &products[found->second];
}

MarkRegion* WatchedPlan::Parts::reading(Product& product, const PlannedStep& planned) {
    const std::uint32_t scope = planned.step.scope;
    const bool sums = scope == product.maker && std::ranges::any_of(strata::uses(planned), [&](const Use& use) {
                          return writes(use.access) && key_of(use) == ProductKey{product.is_image, product.id};
                      });
    if (sums) return nullptr;
    MarkRegion& region = product.read_by[scope];
    region.units = product.units;
    return &region;
}

/// Uses that no shader marks.
void WatchedPlan::Parts::add_static_uses(const PlannedStep& planned) {
    const auto read_all = [&](Image image, Buffer buffer) {
        Product* product = image || buffer ? find({.image = image, .buffer = buffer}) : nullptr;
        if (MarkRegion* region = product ? reading(*product, planned) : nullptr) region->is_whole = true;
    };
    for (const Attachment& attachment : planned.step.attachments) {
        Product* product = find({.image = attachment.image});
        if (!product) continue;
        const TexelBox area = drawn_area(product->shape, planned, attachment.part);
        if (writes(attachment.access)) {
            if (chooses_layer(planned)) product->made.boxes.push_back(area);
            else product->made.is_marked = true;
        }
        MarkRegion* region = reads(attachment.access) ? reading(*product, planned) : nullptr;
        if (region) region->boxes.push_back(area);
    }
    if (const auto* draw = std::get_if<DrawWork>(&planned.step.work)) {
        for (const Buffer buffer : {draw->list.commands, draw->list.indices, draw->count}) read_all({}, buffer);
    }
    if (const auto* compute = std::get_if<ComputeWork>(&planned.step.work)) read_all({}, compute->arguments);
    if (const auto* copy = std::get_if<CopyWork>(&planned.step.work)) {
        read_all(copy->from, copy->buffer_from);
        if (Product* to = find({.image = copy->to, .buffer = copy->buffer_to})) to->made.is_whole = true;
    }
}

void WatchedPlan::Parts::add_use_of_bindings(const PlannedStep& planned) {
    for (const PlannedBinding& bound : planned.bindings) {
        const Use use{.image = bound.binding.image, .buffer = bound.binding.buffer};
        Product* product = use.image || use.buffer ? find(use) : nullptr;
        if (!product) continue;
        const Access access = bound.binding.access;
        if (writes(access)) product->made.is_marked = true;
        MarkRegion* region = reads(access) ? reading(*product, planned) : nullptr;
        if (region) (bound.kind == BindingKind::uniform_buffer ? region->is_whole : region->is_marked) = true;
    }
}

void WatchedPlan::Parts::add_uses() {
    for (const PlannedStep& planned : plan.steps) {
        if (is_clear(planned)) continue;
        add_static_uses(planned);
        add_use_of_bindings(planned);
    }
    for (const Image image : plan.kept_images)
        if (Product* product = find({.image = image})) {
            MarkRegion& region = product->read_by[picture];
            region.units = product->units;
            region.is_whole = true;
        }
}

void WatchedPlan::Parts::place_regions() {
    const auto take = [&](MarkRegion& region) {
        region.first_word = mark_words;
        mark_words += region.words();
    };
    for (Product& product : products) {
        take(product.made);
        for (auto& [scope, region] : product.read_by) take(region);
    }
}

Buffer WatchedPlan::Parts::import_buffer(std::string name, std::vector<std::byte> bytes) {
    const ImportId id{first_watch_import + uploads.size()};
    plan.buffers.push_back({.name = std::move(name), .bytes = bytes.size(), .import = id});
    uploads.push_back({id, std::move(bytes)});
    return {static_cast<std::uint32_t>(plan.buffers.size() - 1), 0};
}

Result<const Shader*> WatchedPlan::Parts::watched(const Shader& shader, const Step& step, const Watched& what) {
    std::vector<std::uint32_t> reached = reached_code(shader.code, fixed_constants(shader, step));
    const auto key = std::pair{std::move(reached), what};
    if (const auto found = known.find(key); found != known.end()) return found->second;
    auto code = watched_code(key.first, what);
    if (!code) return within(code.error(), "shader {shader} cannot be used", shader.name);
    codes.push_back(*std::move(code));
    Shader made = shader;
    made.code = codes.back();
    made.hash = 0xcbf29ce484222325u;
    for (const std::uint32_t word : made.code) made.hash = (made.hash ^ word) * 0x100000001b3u;
    shaders.push_back(std::move(made));
    return known[key] = &shaders.back();
}

/// A place of marks as the step's view of the resource numbers its texels.
MarkPlace place_of(const Product& product, const MarkRegion& region, const Binding& bound) {
    return {.first_word = std::uint32_t(region.first_word),
            .units = std::uint32_t(region.units),
            .width = product.shape.extent.width,
            .height = product.shape.extent.height,
            .samples = product.shape.samples,
            .first_layer = bound.part.layer.value_or(0),
            .is_linear = bound.filter == Filter::linear};
}

Result<void> WatchedPlan::Parts::watch_step(PlannedStep& planned) {
    if (planned.shaders.empty()) return {};
    Watched what{.bindings = {}, .slots = {set, 0, 1}};
    std::vector<MarkPlace> at;
    for (const PlannedBinding& bound : planned.bindings) {
        const Use use{.image = bound.binding.image, .buffer = bound.binding.buffer};
        Product* product = use.image || use.buffer ? find(use) : nullptr;
        if (!product || bound.kind == BindingKind::uniform_buffer) continue;
        const MarkRegion* region = reads(bound.binding.access) ? reading(*product, planned) : nullptr;
        const bool is_written = writes(bound.binding.access);
        if (!region && !is_written) continue;
        what.bindings.push_back({bound.set, bound.slot, region != nullptr, is_written});
        if (region) at.push_back(place_of(*product, *region, bound.binding));
        if (is_written) at.push_back(place_of(*product, product->made, bound.binding));
    }
    for (const Attachment& attachment : planned.step.attachments) {
        Product* product = find({.image = attachment.image});
        if (!product || !writes(attachment.access) || chooses_layer(planned)) continue;
        what.attachments.push_back(product->shape.samples);
        at.push_back(place_of(*product, product->made, {.part = attachment.part}));
    }
    if (at.empty()) return {};
    for (const Shader*& shader : planned.shaders) {
        const auto code = watched(*shader, planned.step, what);
        if (!code) return code.error();
        shader = *code;
    }
    const auto bind = [&](const char* name, Access access, Buffer buffer, std::uint32_t slot) {
        planned.bindings.push_back({.binding = {.name = name, .access = access, .buffer = buffer}, .set = set, .slot = slot});
    };
    bind("marks of uses", Access::updated, marks, 0);
    bind("places of marks", Access::loaded, import_buffer("places of marks", bytes_of(at)), 1);
    return {};
}

Result<void> WatchedPlan::Parts::watch_steps() {
    for (const PlannedStep& planned : plan.steps)
        for (const PlannedBinding& bound : planned.bindings) set = std::max(set, bound.set + 1);
    marks = import_buffer("marks of uses", std::vector<std::byte>(std::max<std::uint64_t>(1, mark_words) * 4));
    plan.kept_buffers.push_back(marks);
    for (PlannedStep& planned : plan.steps)
        if (const auto done = watch_step(planned); !done) return done;
    return {};
}

WatchedPlan::WatchedPlan(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
WatchedPlan::WatchedPlan(WatchedPlan&&) noexcept = default;
WatchedPlan& WatchedPlan::operator=(WatchedPlan&&) noexcept = default;
WatchedPlan::~WatchedPlan() = default;

Result<WatchedPlan> WatchedPlan::of(const Plan& plan) {
    auto parts = std::make_unique<Parts>(plan);
    parts->find_products();
    parts->add_uses();
    parts->place_regions();
    if (const auto done = parts->watch_steps(); !done) return done.error();
    return WatchedPlan(std::move(parts));
}

const Plan& WatchedPlan::plan() const { return parts_->plan; }
std::span<const WatchedPlan::Upload> WatchedPlan::uploads() const { return parts_->uploads; }
Buffer WatchedPlan::marks() const { return parts_->marks; }

std::vector<ProductUse> WatchedPlan::uses(std::span<const std::byte> bytes) const {
    std::vector<std::uint32_t> marks(bytes.size() / 4);
    std::memcpy(marks.data(), bytes.data(), marks.size() * 4);
    std::vector<ProductUse> all;
    for (const Product& product : parts_->products) {
        ProductUse& use = all.emplace_back(ProductUse{.name = product.name,
                                                      .is_image = product.is_image,
                                                      .maker = product.maker,
                                                      .unit_bytes = product.unit_bytes,
                                                      .units = product.units,
                                                      .writers = product.writers});
        const UnitBits made = used_units(product.made, product.shape, marks);
        UnitBits read(product.units);
        for (const auto& [scope, region] : product.read_by) {
            UnitBits here = used_units(region, product.shape, marks);
            here.keep_only(made);
            read.add(here);
            if (here.count() == 0) continue;
            if (scope == picture) use.is_picture = true;
            else use.readers.push_back(scope);
        }
        use.is_remembered = !product.is_image && parts_->plan.buffers[product.id].remembered.has_value();
        use.made = made.count();
        use.read = read.count();
    }
    return all;
}

}  // namespace strata
