// One namespace for each folder: where a name is declared says where it stands.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {

/// The namespace of a file's folder: core/X is roci::X, exec_svc/reactor is roci::exec::reactor,
/// services/clock is roci::services::clock. Empty when the top folder has none.
std::string namespace_of(const std::string& path);

/// What each file opens at its top level must be the namespace of its folder, or one within it that no folder
/// bears. Unnamed namespaces, and blocks that only declare classes of others, are free. One line for each
/// breach.
std::vector<std::string> foreign_namespaces(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
