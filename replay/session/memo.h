// Stage outputs kept on the device by the key of everything they depend on, so that changing one technique re-executes it and
// what follows, and nothing before it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "passes/graph/shader.h"
#include "replay/gpu/executor.h"
#include "replay/scene/device_scene.h"
#include "replay/session/counter_record.h"
#include "replay/session/frame_plan.h"

namespace strata {

/// What one pass left behind.
struct KeptPass {
    struct KeptImage {
        std::string name;  ///< in the graph
        ImportId id;
        Shape shape;
    };
    std::vector<KeptImage> images;
    std::vector<CounterRecord> counters;
    std::uint64_t bytes = 0, last_used = 0;
    bool filled = false;  ///< false until the run that writes it has succeeded
};

class Memo {
public:
    Memo(Executor& executor, std::uint64_t budget_bytes) : executor_(&executor), budget_(budget_bytes) {}

    /// Keeps at most so much from here on; the oldest go first.
    void limit(std::uint64_t budget_bytes);
    std::uint64_t budget() const { return budget_; }
    std::uint64_t held() const { return held_; }
    /// What is used from here on stays until the next call.
    void begin_run() {
        run_began_ = clock_;
        ++runs_;
    }
    std::uint64_t runs() const { return runs_; }
    /// Null when the key is not there, not filled, or lacks one of the images.
    KeptPass* find(std::uint64_t key, std::span<const std::string> images);
    /// Makes room and images for a pass about to run; null where the budget has no room for them.
    KeptPass* reserve(std::uint64_t key, std::span<const ImageRecord> images);
    /// The run that wrote them succeeded (or failed: then they are dropped).
    void commit(std::uint64_t key, std::vector<CounterRecord> counters);
    void drop_unfilled();
    void clear();

private:
    void drop(std::map<std::uint64_t, KeptPass>::iterator);
    /// Drops the oldest that this run does not use until at most so much is held.
    void shrink(std::uint64_t bytes);

    Executor* executor_;
    std::uint64_t budget_, held_ = 0, clock_ = 0, run_began_ = 0, runs_ = 0, next_id_ = first_free_import;
    std::map<std::uint64_t, KeptPass> kept_;
};

/// Hash of what a pass depends on: technique, settings, the frame, replaced shaders, and the keys of the passes whose images and
/// buffers it reads.
class PassKeys {
public:
    /// run: no two runs have the same. What frames leave to the next is part of no key, so passes that show it have none twice.
    PassKeys(std::uint64_t frame_key, std::uint64_t run, const ShaderLibrary& shaders)
        : frame_key_(frame_key), run_(run), shaders_(&shaders) {}
    /// The key of the pass just declared as `scope`; remembers it as the producer of what the scope writes.
    std::uint64_t key(const Graph&, const DeclaredPass&, const Settings&);

private:
    std::uint64_t frame_key_, run_;
    const ShaderLibrary* shaders_;
    std::map<std::uint32_t, std::uint64_t> image_key_, buffer_key_;  ///< by id: key of the last writer
};

/// Names of the images each pass writes that a later pass reads or the graph keeps, by the pass's place in the frame.
std::vector<std::vector<std::string>> images_read_later(const Graph&, std::span<const DeclaredPass>);
/// Whether a later pass reads a buffer this pass creates: such a pass is always executed.
bool feeds_buffers(const Graph&, std::uint32_t scope);

}  // namespace strata
