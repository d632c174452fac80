// The floors within services/ and core/: who may see whom, through any chain of includes.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {

/// Files that reach a floor above their own through any chain of the project's includes, each with the chain;
/// files of a house that has floors but stand on none.
std::vector<std::string> upward_includes(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
