// The cover chooses which mutex groups become finite-domain variables.
#pragma once

#include <cstdint>
#include <vector>

namespace roci::planner::temporal_pddl::grounding::encoding {

/// Partitions the members marked in `needed` into sets of which each lies within one of `groups` or is a
/// single member. The largest group comes first, and each gets what earlier ones did not take (Helmert 2009,
/// section 6).
std::vector<std::vector<std::uint32_t>> cover(const std::vector<bool>& needed,
                                              const std::vector<std::vector<std::uint32_t>>& groups);

}  // namespace roci::planner::temporal_pddl::grounding::encoding
