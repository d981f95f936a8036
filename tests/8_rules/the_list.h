// The list of techniques as it stands in passes/CMakeLists.txt, and the technique folders as they stand on disk.
#pragma once

#include <string>
#include <vector>

namespace strata {

/// "transparency/weighted", in the list's order.
std::vector<std::string> listed_techniques();
/// Folders two below passes/, except those that are no stage's (graph, reference, shaders, views).
std::vector<std::string> technique_folders();

}  // namespace strata
