// The scope of a topic says who shares it: everyone of the run, one robot, or the team. The DDS partitions of an
// endpoint follow from that and from the robot that its service belongs to; nobody else names a partition
// (tests/architecture).
#pragma once

#include <string>
#include <vector>

namespace roci::services::transport {

/// Says how far the samples of a topic reach.
enum class Scope {
  everyone,  ///< all participants of the domain share it: no partition
  team,      ///< crosses robots and ground; a partition of its own keeps it apart from inner topics
  robot,     ///< inner to one robot: its services share it, with those that belong to no robot
};

/// Returns the partitions of the endpoints that a service of `robot` has on a topic (DDS 1.4, 2.2.3.13). A robot's
/// own is "roci.inner.<robot>". A service without a robot (`robot` empty: world, ground, team) is in that of every
/// robot by a pattern, and in "roci.inner" besides, because two patterns never match each other. Throws
/// std::invalid_argument for a robot whose name is not of letters, digits, '_', '-' and '.'.
std::vector<std::string> partitions_of(Scope, const std::string& robot);

}  // namespace roci::services::transport
