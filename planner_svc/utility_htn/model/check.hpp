// The check of a network reports at once everything that the network must fulfil before it is used (R78, R83): one
// plain sentence for each fault, with the part of the network and the remedy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {

/// Says which list of the network a fault lies in.
enum class Part { network, parameter, timeline, task, site };

/// Numbers the things of Part::network that have a place of their own; 0 is the network as a whole.
inline constexpr std::uint32_t kCycleOfNetwork = 1;
inline constexpr std::uint32_t kSubwayOfNetwork = 2;

/// Describes one fault with its place in the network and its remedy.
struct Fault {
  Part part = Part::network;
  std::uint32_t index = 0;  ///< in the list of that part; of a network as above
  bool warning = false;     ///< the network can be used, but it can hardly be meant so
  std::string what;
  std::string remedy;  ///< may be empty
};

/// Returns all faults, in the order of the network. With none but warnings every index in the network is in range,
/// every number finite or a bound, the hierarchy without cycles, and all of it within model/bounds.hpp; what a
/// parameter may become within its range keeps durations and scores valid.
std::vector<Fault> check(const Network& network);

/// Returns whether none of them is more than a warning.
bool usable(const std::vector<Fault>& faults);

/// Prints "task 'excavate_0': what; remedy".
std::string to_text(const Fault& fault, const Network& network);

}  // namespace roci::planner::utility_htn::model
