// The independent checker is asked about one version of a plan, what was there before, and what was observed. It is
// told in types of its own, so that no mistake of the planner can hide in a shared one.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::checking {

/// Describes one primitive task in a plan.
struct Step {
  std::uint64_t id = 0;  ///< the same in all versions
  model::TaskIndex task = 0;
  temporal::Time start{0};
  /// Holds the time that it takes; none: as the network says. Downlinks and executed tasks have one of their
  /// own.
  std::optional<temporal::Duration> duration{};
  bool committed = false;
  bool due = false;      ///< it should begin or end by now and is not known to have
  bool overdue = false;  ///< it should have before now: its times are the soonest ones
};

/// Holds a requested task with all its primitive ones in order, those that are executed among them.
struct Block {
  model::TaskIndex request = 0;
  std::vector<Step> steps;
};

/// Describes a downlink opportunity as the checker is told it.
struct Window {
  std::string id;
  temporal::Time start{0};
  temporal::Time latest_end{0};
  double bytes_per_s = 0;
  double power_w = 0;
  double energy_limit_j = std::numeric_limits<double>::infinity();
  std::uint32_t sol = 0;
  double heat_limit_s = std::numeric_limits<double>::infinity();
  bool under_way = false;  ///< it sends already: what room is left is not known
};

/// Describes data to be sent, and the window that the plan gives them.
struct Product {
  std::string id;
  model::Tier tier = model::Tier::mandatory;
  std::uint64_t bytes = 0;
  temporal::Time created{0};
  std::optional<std::uint64_t> step{};    ///< the planned step that will generate it; none: it is on board
  std::string name{};                     ///< of that task's product in the network
  std::optional<std::uint32_t> window{};  ///< none: it is not sent
  bool reported = false;                  ///< the plan names it as left out or late, with the reason
};

/// Holds the data, the windows, and the energy limits of sols in joules.
struct Downlinks {
  std::vector<Product> products{};
  std::vector<Window> windows{};  ///< in order of their starts
  std::map<std::uint32_t, double> sol_energy_j{};
  /// Names products of steps that are there already although the step is not known to be over: nothing promises them.
  std::set<std::pair<std::uint64_t, std::string>> generated{};
  /// Names steps that stood in the plan before: their data may have lost their downlink since, with a reason told.
  std::set<std::uint64_t> kept{};
};

/// Holds a value of a timeline that was observed.
struct Observation {
  temporal::timelines::Index timeline = 0;
  temporal::Time sampled{0};
  double value = 0;
};

/// Holds one version of a plan, with all that it is checked against.
struct Question {
  const model::Network& network;
  const model::Values& values;
  std::vector<Block> plan;
  std::vector<Block> before{};  ///< the version that this one follows
  /// Lists what runs or has succeeded of chains that were broken off: it counts on timelines, but is no
  /// decomposition any more.
  std::vector<Step> rests{};
  /// Lists the requests of those chains: no plan begins them anew while they last.
  std::vector<model::TaskIndex> broken_off{};
  /// Lists downlinks that are over and stand in the plan no longer: they count for the energy of their sol.
  std::vector<Step> sent{};
  Downlinks downlinks{};
  /// Says whether the plan tells what goes with which downlink; otherwise that is not checked.
  bool downlinks_told = true;
  std::vector<Observation> observations{};
  temporal::Time origin{0};  ///< of the plan
  temporal::Time now{0};
  temporal::Time from{0};  ///< end of the commit window: what is not committed starts then or later
  double budget = 0;       ///< what is left of it
  std::vector<model::TaskIndex> closed{};  ///< requests that are done, failed for good or withdrawn
};

}  // namespace roci::planner::utility_htn::checking
