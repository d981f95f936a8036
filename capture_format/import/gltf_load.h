// Reads a whole glTF into a Document: JSON, buffers, compressed buffer views, encoded images.
#pragma once

#include "capture_format/import/gltf_document.h"
#include "capture_format/import/gltf_files.h"
#include "capture_format/memory_budget.h"
#include "capture_format/result.h"

namespace strata::gltf {

/// Fails when the JSON or the container is broken, or a member has a wrong type. Missing buffers and images are faults of
/// their own, which only matter when they are used.
Result<Document> load_document(std::vector<std::byte> file, const Folder&, MemoryBudget&);

}  // namespace strata::gltf
