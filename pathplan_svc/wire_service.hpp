// This file translates between the wire and the path planner, without a node.
#pragma once

#include <map>
#include <stop_token>
#include <string>

#include "pathplan_svc/path_planner.hpp"
#include "roci_idl/function.h"
#include "roci_idl/motion.h"

namespace roci::pathplan {

inline constexpr const char* kModule = "pathplan";

/// Tells what module `pathplan` offers on this version of the map: traverse_time [s] and traverse_energy [J]
/// of (from, to), exact and as a lower bound.
v1::FunctionOffer function_offer(const std::string& owner, std::uint64_t map_version);

/// Holds the reply, and what is worth an event.
struct FunctionAnswer {
  v1::FunctionReply reply;
  std::map<std::string, std::string> unusable_places;  ///< Say by object why no path can begin or end there.
};

/// Gives every tuple an outcome. An object is a place if it has properties x and y, finite numbers in metres.
/// A place off the map or inside an obstacle is unreachable, and the reply says why in words; so is what known ground
/// proves to be cut off. Where unknown ground may hold a way the outcome is FUNCTION_UNKNOWN. Once stopped,
/// the rest is FUNCTION_FAILED.
FunctionAnswer evaluate(PathPlanner& planner, const v1::FunctionRequest& request,
                        const std::stop_token& stop);

/// Finds a path. The reply names the version of the map on which it stands, and says in words why there is no
/// path.
v1::PathReply find_path(PathPlanner& planner, const v1::PathRequest& request);

}  // namespace roci::pathplan
