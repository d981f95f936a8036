// What a technique says about itself. Command line, inspector, report and test matrix are loops over these values.
// One function per technique folder returns one; the list in passes/CMakeLists.txt is its registration.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "capture_format/frame_features.h"
#include "passes/abilities.h"
#include "passes/capability.h"
#include "passes/claims.h"
#include "passes/debug_views.h"
#include "passes/settings.h"
#include "passes/stage.h"
#include "passes/tolerance.h"

namespace strata {

class Graph;         // passes/graph/graph.h
struct FrameImages;  // passes/frame_images.h
struct TruthRow;     // passes/metric.h

using DeclareFunction = void (*)(Graph&, FrameImages&, const Settings&);

/// What a technique does at a stage: its own, or another one before it (preparing) or after it (finishing).
struct StageWork {
    Stage at;
    DeclareFunction declare;
};

struct Technique {
    Stage stage;
    std::string_view name;  ///< "transparency/weighted": its folder below passes/
    /// What papers and engines call it: "wboit". A user may write it in place of the name.
    std::vector<std::string_view> aliases = {};
    std::string_view title;
    std::string_view source;   ///< paper or talk
    std::string_view summary;  ///< one sentence: what it does and how it fails
    std::vector<Param> params = {};
    /// Settings beside the defaults that a report measures, too: "layers=4 tail=drop".
    std::vector<std::string_view> variants = {};
    std::vector<Counter> counters = {};
    std::size_t counter_bytes = 0;  ///< sizeof its counter struct
    std::vector<DebugView> views = {};
    std::vector<DebugTable> tables = {};
    Abilities abilities = {};
    Capabilities needs = {};  ///< of the device, beyond the baseline
    /// Why the device of these images cannot do their frame at these settings, or nothing. Null: it always can.
    std::optional<Error> (*beyond_device)(const FrameImages&, const Settings&) = nullptr;
    /// Features it cannot do: the report says "not supported" where a frame has one.
    std::vector<Feature> cannot = {};
    Claims claims = {};
    DeclareFunction declare = nullptr;
    /// Name of the stage's other truth that it approximates at these settings; empty: the stage's truth. Null: always that.
    std::string_view (*approximates)(const Settings&) = nullptr;
    std::vector<StageWork> at_other_stages = {};
    Model model = nullptr;
    ModelKind model_is = ModelKind::paper;
    Tolerance tolerance = {};
    /// What a run should say of its frame at these settings: what is recorded too finely for the technique. Null: nothing.
    std::vector<std::string> (*notes)(const FrameImages&, const Settings&) = nullptr;
};

/// What a technique at its settings is judged by.
TruthRow truth_of(const Technique&, const Settings&);

}  // namespace strata
