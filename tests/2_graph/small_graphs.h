// What the tests of this folder are made of: shaders that exist by description alone, and plans turned into short sentences.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passes/graph/plan.h"
#include "tests/support/errors.h"

namespace strata {

// write.comp stores target; copy.comp loads source, stores target; sample.comp samples source, stores target; change.comp
// updates target; count.comp samples source, updates Counters; shade_and_count.comp stores target as well; fill_list.comp stores
// List; use_list.comp loads List, stores target; pushed.comp has an 8 byte push block and a constant "rank"; paint.frag has one
// color output; shade.frag samples source and has one; depth_only.vert stands alone; sort.geom loads List and chooses a layer.
// Groups are 8 x 8.
const ShaderLibrary& small_shaders();

/// 64 x 32, one of everything.
Shape small_shape(Format = Format::rgba16f);
Shape small_depth();

/// A pass at the technique's own stage.
inline Scope pass_of(Stage stage, std::string technique) { return {ScopeKind::pass, stage, stage, std::move(technique)}; }

/// The plan, or a test failure with the sentence.
Plan compiled(const Graph&);
/// What compile() fails with, if it does.
std::optional<Error> refusal(const Graph&);

/// "a: stored -> sampled" for every barrier before the n-th surviving step; parts and discards are said when there are any.
std::vector<std::string> waits(const Plan&, std::size_t step);
std::vector<std::string> final_waits(const Plan&);
std::vector<std::string> step_names(const Plan&);

}  // namespace strata
