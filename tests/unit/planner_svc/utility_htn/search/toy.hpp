// Small networks for tests of the search, written task by task.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/network.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Is a network with a battery, an arm that one task uses at a time, and a phase: all that these tests need.
class Toy {
 public:
  static constexpr temporal::timelines::Index kBattery = 0, kArm = 1, kPhase = 2;

  Toy();

  /// Adds a primitive task that takes energy at its start; `arm`: it uses the arm all the time.
  model::TaskIndex task(const std::string& id, double seconds, double energy, std::vector<double> scores,
                        bool arm = false, bool is_template = false);
  /// Adds a requested parent; each decomposition is a list of tasks.
  model::TaskIndex parent(const std::string& id,
                          const std::vector<std::vector<model::TaskIndex>>& decompositions);
  model::Task& operator[](model::TaskIndex index) { return network.tasks[index]; }

  /// Flattens what is there; to be called once, when the network is whole.
  void close();
  Problem problem(double budget);
  std::uint32_t chain(const std::string& name) const;
  /// Names the chains of a plan, by start.
  std::vector<std::string> names(const Plan& plan) const;
  temporal::Time start(const Plan& plan, const std::string& name, std::size_t link = 0) const;

  model::Network network;
  model::Values values;
  flattening::Chains chains;
  assessor::NetworkAssessor sums;
  EarliestScheduler earliest;
  std::vector<double> now;
  std::vector<temporal::timelines::Timelines> timelines;  // one, made by close()
};

}  // namespace roci::planner::utility_htn::search
