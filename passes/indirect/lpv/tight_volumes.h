// Volumes that are no larger than their room.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "passes/scene/light_grids.h"

namespace strata {

class SceneFacts;  // passes/scene/scene_facts.h

}  // namespace strata

namespace strata::indirect {

/// A sentence for each fixed local grid whose border lies within half a cell of the outermost opaque surfaces: there a grid fades
/// to nothing, and a volume exactly as large as its room lights none of the room's walls.
std::vector<std::string> notes_on_tight_volumes(const SceneFacts&, std::span<const LightGrid>);

}  // namespace strata::indirect
