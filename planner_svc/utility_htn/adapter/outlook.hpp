// The outlook is what the engine expects of its plan, for operators and for whoever sends data: the downlink
// schedule, utility by rank, energy, and the science subway map (R110–R115, R127).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner_svc/engine/mission_outlook.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"

namespace roci::planner::utility_htn::adapter {

/// Refers to what an outlook is made of, all of which must outlive it.
struct Situation {
  const model::Network& network;
  const flattening::Chains& chains;
  const assessor::Assessor& assessor;
  const cycle::Cycle& cycle;
  const delivery::Delivery& delivery;
  temporal::Time now{0};
};

/// Returns the network's ranks, each with what earns utility there (R113).
std::vector<engine::UtilityRank> ranks_of(const model::Network& network);

/// Returns which data go with which downlink of the plan, and what does not and why. Data that exist have the ids under
/// which they were heard, those that are planned "request/task/product"; several of one name are numbered.
engine::DownlinkSchedule schedule_of(const Situation& situation);

/// Returns what the schedule tells each downlink to send, in order.
std::map<cycle::TaskId, std::vector<std::string>> products_by_task(const engine::DownlinkSchedule& schedule);

/// Makes outlooks, and remembers for them what the cycle forgets: chains that have ended, the newest kMostEnded, and
/// what was predicted of chains before they began. A restarted process remembers none, and tells for begun chains what
/// the network holds of them.
class Outlooks {
 public:
  static constexpr std::size_t kMostEnded = 1'000;
  /// The factors of the robust mode (search/robust.hpp): by which each cost is multiplied in the
  /// worst and in the best case.
  static constexpr double kWorst = 1.1;
  static constexpr double kBest = 0.9;

  /// Takes in which blocks had begun before a cycle; those that it has forgotten have ended.
  void forgotten(const Situation& after, const std::vector<cycle::Block>& begun_before);
  engine::MissionOutlook make(const Situation& situation);

 private:
  void add_chains(const Situation& situation, engine::MissionOutlook& out);

  std::vector<engine::ChainOutlook> ended_;                  // by end
  std::map<std::uint32_t, temporal::RankVector> predicted_;  // by block, newest before it began
};

}  // namespace roci::planner::utility_htn::adapter
