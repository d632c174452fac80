// The planned network is the network in force together with what plans it: chains, assessor, scheduler, delivery and
// cycle, all of which refer to it and change with it (R83, R118).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/outlook.hpp"
#include "planner_svc/utility_htn/adapter/resolvers.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::adapter {

/// Keeps the network and all that is derived from it in step. It stays where it was made, since its parts refer to each
/// other.
class PlannedNetwork {
 public:
  /// The network is checked already. A way to search that was chosen stands over that of the settings.
  PlannedNetwork(model::Network network, const cycle::Settings& settings, const Resolvers& chosen);
  ~PlannedNetwork();
  PlannedNetwork(const PlannedNetwork&) = delete;
  PlannedNetwork& operator=(const PlannedNetwork&) = delete;

  /// Makes the cycle; before that, cycle() must not be asked for.
  void begin(temporal::Time origin);
  bool has_begun() const { return cycle_ != nullptr; }

  const model::Network& network() const { return network_; }
  const flattening::Chains& chains() const { return chains_; }
  delivery::Delivery& delivery() { return delivery_; }
  cycle::Cycle& cycle() { return *cycle_; }
  const cycle::Cycle& cycle() const { return *cycle_; }
  /// Returns whether the Downlink Manager plans what is sent.
  bool plans_downlinks() const { return settings_.downlinks; }
  Situation situation(temporal::Time now) const;

  /// Returns the task of this name; nothing if the network has none.
  std::optional<model::TaskIndex> task_named(const std::string& id) const;
  /// Returns whether tasks move the timeline, and nobody reports it.
  bool tasks_move(const std::string& timeline) const;

  /// Puts fixed tasks that would have to start at once where the first cycle can place them; the first call counts.
  void place_fixed_tasks(temporal::Time origin);
  /// Replaces a parameter's value. Returns why not, if it cannot.
  std::string learn(const std::string& parameter, double value);

  // model_change.cpp
  /// Reads the network of a change. Returns nothing, and all reasons in `refused`, if it is faulty, is not newer than
  /// the one in force, or lacks something that has begun.
  std::optional<model::Network> usable_network(const engine::ModelChange& change,
                                               std::vector<std::string>& refused) const;
  /// Puts `next` in force and returns the network before it. Blocks that have begun go on as they are; all others are
  /// planned anew. `newest_values` were heard of timelines, also of those that the network before lacked.
  model::Network replace(model::Network next, const std::map<std::string, temporal::Value>& newest_values,
                         temporal::Time now);

 private:
  std::vector<std::string> in_the_way_of(const model::Network& next) const;

  model::Network network_;
  flattening::Chains chains_;
  std::unique_ptr<assessor::Assessor> assessor_;
  std::unique_ptr<search::Scheduler> scheduler_;
  cycle::Settings settings_;
  delivery::Delivery delivery_;
  std::unique_ptr<cycle::Cycle> cycle_;  // from the first step on
  bool fixed_tasks_stand_ = false;
};

}  // namespace roci::planner::utility_htn::adapter
