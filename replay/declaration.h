// A request as a compiled graph: what a run, a timing, a peek and a judgement have in common.
#pragma once

#include "passes/graph/plan.h"
#include "replay/loaded_frame.h"
#include "replay/memo.h"
#include "replay/scene/device_scene.h"

namespace strata {

/// A counter buffer of a technique's scope.
struct CounterSource {
    const Technique* technique = nullptr;
    Buffer buffer;
};

struct Declaration {
    Graph graph;
    FrameImages images;
    DeclaredFrame frame;
    Choices choices;
    std::map<std::string, Image> outputs;   ///< by the names asked for
    std::vector<CounterSource> counters;
    std::vector<CounterRecord> kept_counters;             ///< of acts that came from the memo
    std::vector<std::pair<std::uint64_t, const Technique*>> memo_writes;  ///< keys this run fills
    std::size_t acts_from_memo = 0;
    Plan plan;
};

/// Where the parts of a frame come from.
struct Sources {
    const LoadedFrame& loaded;
    const DeviceScene& scene;
    const DeviceInfo& device;
    Memo* memo = nullptr;   ///< null: everything is executed
};

/// Everything of a request but `frame`, `extent_divisor` and `samples`, which are in the loaded frame. keep_all: every frame image is kept (for
/// judging and peeking).
enum class Keep { outputs, all_images };
Result<Declaration> declare(const Request&, const Sources&, Keep);

}  // namespace strata
