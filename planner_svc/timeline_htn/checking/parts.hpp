// These are the parts of the checker.
#pragma once

#include "planner_svc/timeline_htn/checking/version.hpp"

namespace roci::planner::timeline_htn::checking {

/// Describes a way in which an activity carries out a behaviour.
struct Decomposition {
  Index behaviour = 0;
  Binding binding;
  /// Goes by subgoal; kNone stands where it is a state to rest in that the timeline alone shows.
  std::vector<Index> part_of;
};

/// Holds what an observer sees of a state.
struct Seen {
  std::string timeline;
  temporal::Value value;
  friend bool operator==(const Seen&, const Seen&) = default;
};
/// Returns what is seen of the state, or nothing where nobody observes it.
std::optional<Seen> seen(const Version& version, const GroundState& state);

/// Lists decompositions by activity; the list is empty for one that is not decomposed.
using Decompositions = std::vector<std::vector<Decomposition>>;

/// Checks states, transitions, how long values last, and that activities stand on their timelines;
/// notes where (Part::value).
void check_timelines(Version& version, Faults& out);
/// Checks that one value meets each dependency of another in every schedule.
void check_needs(const Version& version, Faults& out);
/// Checks that the executive waits for what an activity needs of timelines that are observed,
/// and for nothing else of them.
void check_conditions(const Version& version, Faults& out);
/// Returns all decompositions whose objects, tests, parts and constraints fit; notes activities that have none.
Decompositions decompose(const Version& version, Faults& out);
/// Checks that the plan begins with what the problem triggers.
void check_triggers(const Version& version, const Decompositions& decompositions, Faults& out);
/// Checks that what belongs to no mending of an error starts after all of it,
/// but for what timelines go on with at once.
void check_mending(const Version& version, Faults& out);
/// Checks the decisions that the behaviours leave open.
void check_decisions(const Version& version, const Decompositions& decompositions, Faults& out);

/// Returns schedules of the plan's network: its corners and random ones.
std::vector<Schedule> schedules(const Version& version);
/// Executes a schedule: notes what of the model does not hold in it, and takes out decompositions that do not.
void execute(const Version& version, const Schedule& schedule, Decompositions& decompositions, Faults& out);

/// Returns the bounds of a constraint, or nothing where a table has no number for the objects, or one beyond
/// kLongestDuration.
std::optional<temporal::Window> bounds_of_constraint(const model::Model& model,
                                                     const model::SubgoalConstraint& constraint,
                                                     const Binding& binding);
/// Returns what a state lasts at least and at most, over the objects that an open decision admits for the
/// activity (nullptr: none).
model::Bounds bounds_of(const Version& version, const GroundState& state,
                        const temporal::PlanActivity* activity);

}  // namespace roci::planner::timeline_htn::checking
