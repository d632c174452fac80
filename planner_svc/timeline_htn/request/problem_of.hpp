// This file makes of a request the engine's own problem: where the components are by what is observed, and
// what is asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/mission/findings.hpp"
#include "planner_svc/engine/request.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::request {

/// Says why a request is none for this model: the goal that is meant, or none.
struct Misfit {
  std::string goal;  ///< "issuer/id"; empty: the request as a whole
  std::string what;  ///< with its remedy
};

/// Reads the texts of a request: `model`, and `problem_text` where there is one. The problem is not checked.
std::optional<model::Model> read_model(const engine::Request& request, mission::Findings& findings);

/// Puts what the request says in place of the model's own problem: objects of types that the model knows, the states of
/// components whose timelines are observed, goals with their windows from the origin. A component that is not observed
/// begins where the problem of the model says. Without a horizon in the model the plan has a day. Where the problem
/// says that a component is predicted and its states are observed, it is what the request predicts of their timelines:
/// nothing, and it stays as it is.
///
/// A goal is a comparison `timeline = state`, or several that are to hold: the timeline is that of a component of this
/// name, or one by which a component's states are observed. Returns what does not fit; with nothing the model has a
/// problem that can be checked.
std::vector<Misfit> put_request(const engine::Request& request, model::Model& model);

/// Holds what the timelines of a request show of a component.
struct Observation {
  std::optional<model::Pattern> state;  ///< of objects alone; nothing: none of its states is seen
  std::string seen;  ///< "nav = parked(wp1)", also where that is no state of it; empty: nothing
};
Observation observed_state(const engine::Request& request, const model::Model& model, model::Index component);

}  // namespace roci::planner::timeline_htn::request
