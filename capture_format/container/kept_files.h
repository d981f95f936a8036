// Files that this process must not replace because it reads them.
#pragma once

#include <filesystem>
#include <vector>

#include "capture_format/result.h"

namespace strata {

/// For programs of our own, before they write: WholeFile::begin() refuses to replace these files, and links to them, from now on.
void keep_files(std::vector<std::filesystem::path>);

/// Fails (usage) where the path is one of the kept files, by whatever name or link.
Result<void> check_not_kept(const std::filesystem::path&);

}  // namespace strata
