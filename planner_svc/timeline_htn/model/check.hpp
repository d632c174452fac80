// The check of a model reports at once everything that the model must fulfil before it is planned with: one plain
// sentence for each fault, with the part of the model and the remedy.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::model {

/// Says which list of the model a fault lies in.
enum class Part { model, component, state, behaviour, problem, prediction, goal };

/// Describes one fault with its place in the model and its remedy.
struct Fault {
  Part part = Part::model;
  Index index = 0;       ///< in the list of that part; of a state or prediction: of its component
  Index state = 0;       ///< of a state
  bool warning = false;  ///< the model can be used, but it can hardly be meant so
  std::string what;
  std::string remedy;
};

/// Returns all faults, in the order of the model. It takes indices and types to be right, as reading leaves them. With
/// none but warnings every complex state can end, no behaviour contradicts itself in time, every timeline can rest, and
/// with a problem every component has its initial state.
std::vector<Fault> check(const Model& model);

/// Returns whether none of them is more than a warning.
bool usable(const std::vector<Fault>& faults);

}  // namespace roci::planner::timeline_htn::model
