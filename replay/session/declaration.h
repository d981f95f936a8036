// A request as a compiled graph: what a run, a timing, a peek and a judgment have in common.
#pragma once

#include <set>

#include "passes/graph/graph.h"
#include "passes/graph/plan.h"
#include "replay/scene/device_scene.h"
#include "replay/session/frame_plan.h"
#include "replay/session/loaded_frame.h"
#include "replay/session/session.h"

namespace strata {

class Memo;  // replay/session/memo.h

/// A counter buffer of a technique's scope.
struct CounterSource {
    const Technique* technique = nullptr;
    Buffer buffer;
    std::uint32_t scope = 0;
};

struct Declaration {
    Graph graph;
    FrameImages images;
    DeclaredFrame frame;
    Choices choices;
    std::map<std::string, Image> outputs;  ///< by the names asked for
    /// The same of tables.
    std::map<std::string, std::pair<const DebugTable*, Image>> tables;
    std::vector<CounterSource> counters;
    std::vector<CounterRecord> kept_counters;  ///< of passes that came from the memo
    std::map<std::uint32_t, std::vector<CounterRecord>>
        counters_if_idle;  ///< by scope: when all who need the pass came from the memo
    std::vector<std::pair<std::uint64_t, std::uint32_t>> memo_writes;  ///< keys this run fills, and the scopes of their passes
    std::set<std::uint32_t> scopes_from_memo;
    std::vector<std::uint64_t>
        pass_keys;  ///< what tells equal passes: see PassKeys; in the order of the passes, only with a memo
    /// Buffers to upload before the plan runs: the texels of given outputs as four floats each.
    std::vector<std::pair<ImportId, const ReferenceImage*>> given;
    Plan plan;
};

/// Where the parts of a frame come from.
struct Sources {
    const LoadedFrame& loaded;
    const DeviceScene& scene;
    const DeviceInfo& device;
    const ShaderLibrary& shaders;
    Memo* memo = nullptr;  ///< null: everything is executed
};

/// Which images outlive the run: those asked for, or every one of the frame (for judging).
enum class Keep { outputs, all_images };

/// Declares and compiles a request on a loaded frame (which already has the request's frame, extent and samples).
Result<Declaration> declare(const Request&, const Sources&, Keep);
/// The same without the memo, with images in the place of what a stage's own pass gives: see Session::run_from.
Result<Declaration> declare_from(const Request&, const Sources&, Stage, const ImageSet& outputs);
/// A request that is done in its place: the arguments of its plan's indirect dispatches are kept, and what the techniques given
/// count. No image is made that neither of them needs. Buffers have the numbers that they have in the request's plan.
Result<Declaration> declare_counts(const Request&, const Sources&, const Plan&, const std::set<const Technique*>& counting);

}  // namespace strata
