#include "replay/session/memo.h"

#include <algorithm>
#include <set>

#include "passes/graph/graph.h"
#include "passes/stages.h"
#include "passes/technique.h"

namespace strata {
namespace {

/// 64-bit FNV-1a: keys live within one process, so a simple hash with a fixed definition is enough.
class Hash {
public:
    explicit Hash(std::uint64_t seed) { add(seed); }
    void add(std::uint64_t word) {
        for (int i = 0; i < 8; ++i) byte(static_cast<std::uint8_t>(word >> (8 * i)));
    }
    void add(std::string_view text) {
        for (const char c : text) byte(static_cast<std::uint8_t>(c));
        byte(0);
    }
    std::uint64_t value() const { return hash_; }

private:
    void byte(std::uint8_t b) { hash_ = (hash_ ^ b) * 0x100000001b3ull; }
    std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace

KeptPass* Memo::find(std::uint64_t key, std::span<const std::string> images) {
    const auto found = kept_.find(key);
    if (found == kept_.end() || !found->second.filled) return nullptr;
    for (const std::string& name : images)
        if (std::ranges::find(found->second.images, name, &KeptPass::KeptImage::name) == found->second.images.end())
            return nullptr;
    found->second.last_used = ++clock_;
    return &found->second;
}

void Memo::shrink(std::uint64_t bytes) {
    while (held_ > bytes) {
        const auto oldest = std::ranges::min_element(kept_, {}, [](const auto& entry) { return entry.second.last_used; });
        if (oldest->second.last_used > run_began_) break;
        drop(oldest);
    }
}

void Memo::limit(std::uint64_t budget_bytes) {
    budget_ = budget_bytes;
    begin_run();
    shrink(budget_);
}

KeptPass* Memo::reserve(std::uint64_t key, std::span<const ImageRecord> images) {
    if (const auto old = kept_.find(key); old != kept_.end()) drop(old);
    KeptPass pass{.last_used = ++clock_};
    for (const ImageRecord& image : images) {
        pass.images.push_back({image.name, {next_id_++}, image.shape});
        // A driver says anything about an image beyond its limits: lavapipe 22.3 counts 32 bits.
        pass.bytes += std::max(bytes(image.shape), executor_->image_bytes(image.shape));
    }
    if (pass.bytes > budget_) return nullptr;
    shrink(budget_ - pass.bytes);
    if (held_ + pass.bytes > budget_) return nullptr;
    held_ += pass.bytes;
    const KeptPass& reserved = kept_.emplace(key, std::move(pass)).first->second;
    for (const auto& image : reserved.images) executor_->create_image(image.id, image.shape);  // drop_unfilled() where that fails
    return &kept_.at(key);
}

void Memo::commit(std::uint64_t key, std::vector<CounterRecord> counters) {
    KeptPass& pass = kept_.at(key);
    pass.counters = std::move(counters);
    pass.filled = true;
}

void Memo::drop_unfilled() {
    for (auto it = kept_.begin(); it != kept_.end();) {
        const auto next = std::next(it);
        if (!it->second.filled) drop(it);
        it = next;
    }
}

void Memo::clear() {
    while (!kept_.empty()) drop(kept_.begin());
}

void Memo::drop(std::map<std::uint64_t, KeptPass>::iterator it) {
    for (const auto& image : it->second.images) executor_->forget(image.id);
    held_ -= it->second.bytes;
    kept_.erase(it);
}

std::uint64_t PassKeys::key(const Graph& graph, const DeclaredPass& pass, const Settings& settings) {
    Hash hash(frame_key_);
    hash.add(pass.technique->name);
    hash.add(name(pass.at));
    for (const std::string& line : settings.lines()) hash.add(line);
    const auto read = [&](const std::map<std::uint32_t, std::uint64_t>& keys, std::uint32_t id) {
        const auto producer = keys.find(id);
        hash.add(producer == keys.end() ? 0 : producer->second);
    };
    std::set<std::uint32_t> images, buffers;
    for (const Step& step : graph.steps()) {
        if (step.scope != pass.scope) continue;
        for (const std::string& shader : step.shaders) hash.add(shaders_->replaced(shader));
        if (const auto* draw = std::get_if<DrawWork>(&step.work)) hash.add(shaders_->replaced(scene_vertex_shader(draw->list)));
        for (const Use& use : uses(step)) {
            use.image ? read(image_key_, use.image.id) : read(buffer_key_, use.buffer.id);
            if (!use.image && graph.record(use.buffer).remembered == Remembered::history) hash.add(run_);
            if (writes(use.access)) use.image ? images.insert(use.image.id) : buffers.insert(use.buffer.id);
        }
    }
    for (const std::uint32_t id : images) image_key_[id] = hash.value();
    for (const std::uint32_t id : buffers) buffer_key_[id] = hash.value();
    return hash.value();
}

std::vector<std::vector<std::string>> images_read_later(const Graph& graph, std::span<const DeclaredPass> passes) {
    std::map<std::uint32_t, std::size_t> place;  // scope -> pass
    for (std::size_t i = 0; i < passes.size(); ++i) place[passes[i].scope] = i;
    std::map<std::uint32_t, std::size_t> writer;  // image id -> pass
    std::vector<std::set<std::string>> wanted(passes.size());
    const auto wants = [&](Image image, std::size_t reader) {
        const auto found = writer.find(image.id);
        if (found != writer.end() && found->second != reader) wanted[found->second].insert(graph.record(image).name);
    };
    for (const Step& step : graph.steps()) {
        const auto at = place.find(step.scope);
        const std::size_t pass = at == place.end() ? passes.size() : at->second;
        const std::vector<Use> all = uses(step);
        for (const Use& use : all)
            if (use.image) wants(use.image, pass);
        if (pass == passes.size()) continue;
        for (const Use& use : all)
            if (use.image && writes(use.access)) writer[use.image.id] = pass;
    }
    for (const Image image : graph.kept_images()) wants(image, passes.size());
    std::vector<std::vector<std::string>> names;
    for (const auto& set : wanted) names.emplace_back(set.begin(), set.end());
    return names;
}

bool feeds_buffers(const Graph& graph, std::uint32_t scope) {
    std::set<std::uint32_t> written;
    bool feeds = false;
    for (const Step& step : graph.steps()) {
        for (const Use& use : uses(step)) {
            if (!use.buffer) continue;
            if (step.scope == scope && writes(use.access)) written.insert(use.buffer.id);
            if (step.scope > scope && written.contains(use.buffer.id)) feeds = true;
        }
    }
    return feeds;
}

}  // namespace strata
