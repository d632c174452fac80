// The independent checker of hierarchical timelines (R130, R131, R133, R136–R138, R142): it computes everything anew by
// brute force, and sees only the model and how it is read, so that a mistake of the search cannot hide itself.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::checking {

/// Returns all faults of a plan for the model's problem, each as one plain sentence; none if it may be executed. The
/// model, which must have a problem, is checked already; nothing of the plan need be.
///
/// A plan is taken apart by its names: the activity "wheels.drive(a, b)" stands for that state, one that is named like
/// a behaviour without `achieves` for that behaviour; tokens are the values of the timeline of the component
/// that they name. Checked are
///  - its own form (temporal::check), and that of its timelines from origin to horizon (R142);
///  - timelines: each component has one, it begins as the problem says and ends at rest; each value exists, lasts as it
///    may in every schedule, and follows the one before by a transition; no error state is planned;
///  - activities: each simple or outermost complex one stands on its timeline, and its command is the model's;
///  - dependencies: what a value needs of others holds in every schedule, and its activity waits for what is observed
///    of it;
///  - decompositions: each complex activity has the subgoals of one behaviour for it as parts, with objects that fulfil
///    its tests, constraints that the plan's network implies, and its conditions at its start; what triggers a
///    behaviour is followed by it, and all else that the plan does by that;
///  - decisions: those of the behaviours, with their choices, rules and arguments, open until the point that they name;
///  - goals: reached in their windows, one after the other where the problem says so, and nothing that serves one
///    starts before it is released.
/// What cannot be read off the network is executed: the earliest and the latest schedule, those with one point as early
/// or as late as it can be and the others opposite, and random ones (always the same for the same plan).
std::vector<std::string> faults(const model::Model& model, const temporal::FlexiblePlan& plan);

}  // namespace roci::planner::timeline_htn::checking
