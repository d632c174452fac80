// A version is a plan taken apart for the checker, by the names of the model.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/network_distances.hpp"
#include "planner_svc/timeline_htn/model/evaluate.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::checking {

using model::GroundState, model::Index;
using temporal::Duration, temporal::TimePoint, temporal::to_text;

using Faults = std::vector<std::string>;
using Schedule = std::vector<Duration>;  ///< the time of each point
/// Holds the objects of variables, kNone where one is free.
using Binding = std::vector<Index>;
inline constexpr Index kNone = ~Index{0};

/// Holds a value of a timeline.
struct Value {
  GroundState state;
  TimePoint start = 0, end = 0;
};

/// Holds an activity: of a state, or of a behaviour that achieves none.
struct Part {
  const temporal::PlanActivity* activity = nullptr;
  std::optional<GroundState> state;
  Index behaviour = kNone;
  Index parent = kNone;
  bool aside = false;   ///< of a choice that the plan does not reckon with
  bool within = false;  ///< complex, within another one of its component: the timeline does not show it
  std::optional<Index> value{};  ///< in its timeline
  std::vector<Index> parts{};    ///< those below it

  TimePoint start() const { return activity->start_point; }
  TimePoint end() const { return activity->end_point; }
};

/// Holds a plan taken apart, with its network.
struct Version {
  const model::Model& model;
  const temporal::FlexiblePlan& plan;
  temporal::NetworkDistances network;
  std::vector<std::vector<Value>> timelines{};  ///< by component
  std::vector<Part> parts{};                    ///< by activity
  std::map<std::string, Index> part_of{};       ///< by the activity's id

  const model::State& definition(const GroundState& state) const {
    return model.components[state.component].states[state.state];
  }
  std::string text(const GroundState& state) const { return to_text(model, state); }
  /// Names the activity in words.
  std::string text(const Part& part) const;
};

/// Takes the plan, which passes temporal::check(), apart; notes names that the model does not have.
Version take_apart(const model::Model& model, const temporal::FlexiblePlan& plan, Faults& out);

/// Returns whether the state is one of the pattern's, and binds free variables to its objects.
/// On false some may be bound.
bool unify(const model::Pattern& pattern, const GroundState& state, Binding& binding);
/// Returns whether there is such a state: its tests hold and it has bounds.
bool exists(const model::Model& model, const GroundState& state);

}  // namespace roci::planner::timeline_htn::checking
