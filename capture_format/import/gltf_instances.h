// EXT_mesh_gpu_instancing: the places at which a node shows its mesh.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "capture_format/import/gltf_document.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// Instance to node, one matrix per instance; a node without the extension shows its mesh once, where it is. Fails when the
/// attributes have other types than the extension allows, or differ in length.
Result<std::vector<glm::dmat4>> read_instances(const Document&, const Node&, MemoryBudget&);

}  // namespace strata::gltf
