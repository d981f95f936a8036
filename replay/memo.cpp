#include "replay/memo.h"

#include <algorithm>
#include <functional>
#include <set>

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

/// Calls the visitors for every resource a step names, with its access.
void each_use(const Step& step, const std::function<void(Image, Access)>& image,
              const std::function<void(Buffer, Access)>& buffer) {
    for (const Binding& binding : step.bindings) {
        if (binding.image) image(binding.image, binding.access);
        if (binding.buffer) buffer(binding.buffer, binding.access);
    }
    for (const Attachment& attachment : step.attachments) image(attachment.image, attachment.access);
    if (const auto* draw = std::get_if<DrawWork>(&step.work)) {
        if (draw->list.commands) buffer(draw->list.commands, Access::indirect);
        if (draw->count) buffer(draw->count, Access::indirect);
    } else if (const auto* compute = std::get_if<ComputeWork>(&step.work)) {
        if (compute->arguments) buffer(compute->arguments, Access::indirect);
    } else if (const auto* copy = std::get_if<CopyWork>(&step.work)) {
        if (copy->from) image(copy->from, Access::copied_from);
        if (copy->to) image(copy->to, Access::copied_to);
        if (copy->buffer_from) buffer(copy->buffer_from, Access::copied_from);
        if (copy->buffer_to) buffer(copy->buffer_to, Access::copied_to);
    } else if (const auto* clear = std::get_if<ClearWork>(&step.work)) {
        if (clear->image) image(clear->image, Access::copied_to);
        if (clear->buffer) buffer(clear->buffer, Access::copied_to);
    }
}

}  // namespace

KeptAct* Memo::find(std::uint64_t key, std::span<const std::string> images) {
    const auto found = kept_.find(key);
    if (found == kept_.end() || !found->second.filled) return nullptr;
    for (const std::string& name : images)
        if (std::ranges::find(found->second.images, name, &KeptAct::KeptImage::name) == found->second.images.end())
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

KeptAct* Memo::reserve(std::uint64_t key, std::span<const ImageRecord> images) {
    if (const auto old = kept_.find(key); old != kept_.end()) drop(old);
    KeptAct act{.last_used = ++clock_};
    for (const ImageRecord& image : images) {
        act.images.push_back({image.name, {next_id_++}, image.shape});
        act.bytes += executor_->image_bytes(image.shape);
    }
    if (act.bytes > budget_) return nullptr;
    shrink(budget_ - act.bytes);
    if (held_ + act.bytes > budget_) return nullptr;
    held_ += act.bytes;
    for (const auto& image : act.images) executor_->create_image(image.id, image.shape);
    return &kept_.emplace(key, std::move(act)).first->second;
}

void Memo::commit(std::uint64_t key, std::vector<CounterRecord> counters) {
    KeptAct& act = kept_.at(key);
    act.counters = std::move(counters);
    act.filled = true;
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

void Memo::drop(std::map<std::uint64_t, KeptAct>::iterator it) {
    for (const auto& image : it->second.images) executor_->forget(image.id);
    held_ -= it->second.bytes;
    kept_.erase(it);
}

std::uint64_t ActKeys::key(const Graph& graph, const DeclaredAct& act, const Settings& settings) {
    Hash hash(frame_key_);
    hash.add(act.technique->name);
    hash.add(name(act.at));
    for (const std::string& line : settings.lines()) hash.add(line);
    const auto read = [&](const std::map<std::uint32_t, std::uint64_t>& keys, std::uint32_t id) {
        const auto producer = keys.find(id);
        hash.add(producer == keys.end() ? 0 : producer->second);
    };
    std::set<std::uint32_t> images, buffers;
    for (const Step& step : graph.steps()) {
        if (step.scope != act.scope) continue;
        each_use(
            step,
            [&](Image image, Access access) {
                read(image_key_, image.id);
                if (writes(access)) images.insert(image.id);
            },
            [&](Buffer buffer, Access access) {
                read(buffer_key_, buffer.id);
                if (writes(access)) buffers.insert(buffer.id);
            });
    }
    for (const std::uint32_t id : images) image_key_[id] = hash.value();
    for (const std::uint32_t id : buffers) buffer_key_[id] = hash.value();
    return hash.value();
}

std::vector<std::vector<std::string>> images_read_later(const Graph& graph, std::span<const DeclaredAct> acts) {
    std::map<std::uint32_t, std::size_t> place;  // scope -> act
    for (std::size_t i = 0; i < acts.size(); ++i) place[acts[i].scope] = i;
    std::map<std::uint32_t, std::size_t> writer;  // image id -> act
    std::vector<std::set<std::string>> wanted(acts.size());
    const auto wants = [&](Image image, std::size_t reader) {
        const auto found = writer.find(image.id);
        if (found != writer.end() && found->second != reader) wanted[found->second].insert(graph.record(image).name);
    };
    for (const Step& step : graph.steps()) {
        const auto at = place.find(step.scope);
        const std::size_t act = at == place.end() ? acts.size() : at->second;
        each_use(
            step, [&](Image image, Access) { wants(image, act); }, [](Buffer, Access) {});
        if (act == acts.size()) continue;
        each_use(
            step,
            [&](Image image, Access access) {
                if (writes(access)) writer[image.id] = act;
            },
            [](Buffer, Access) {});
    }
    for (const Image image : graph.kept_images()) wants(image, acts.size());
    std::vector<std::vector<std::string>> names;
    for (const auto& set : wanted) names.emplace_back(set.begin(), set.end());
    return names;
}

bool feeds_buffers(const Graph& graph, std::uint32_t scope) {
    std::set<std::uint32_t> written;
    bool feeds = false;
    for (const Step& step : graph.steps()) {
        each_use(
            step, [](Image, Access) {},
            [&](Buffer buffer, Access access) {
                if (step.scope == scope && writes(access)) written.insert(buffer.id);
                if (step.scope > scope && written.contains(buffer.id)) feeds = true;
            });
    }
    return feeds;
}

}  // namespace strata
