// Endpoints in partitions hear each other by the rule of DDS 1.4 (2.2.3.13).
#pragma once

#include <string>
#include <vector>

namespace roci::services::vendors::inproc {

/// Returns whether a name of one side equals one of the other, or one is a pattern (fnmatch) of the other. Two patterns
/// never match each other. An endpoint without partitions is in the partition "".
bool partitions_match(const std::vector<std::string>&, const std::vector<std::string>&);

}  // namespace roci::services::vendors::inproc
