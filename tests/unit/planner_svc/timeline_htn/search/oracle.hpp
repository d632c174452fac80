// Whether a small problem without parameters has a plan, by trying everything: every decomposition, every sequence of
// values of a timeline up to a length, every value for every subgoal and need, and a temporal network for each.
// Conditions count where they are of timelines that are predicted.
#pragma once

#include <cstddef>
#include <vector>

#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::search {

using Sequence = std::vector<model::Index>;  ///< states of one component, in order

class Oracle {
 public:
  /// Timelines have at most so many values.
  Oracle(const model::Model& model, std::size_t most_values) : model_(model), most_(most_values) {}

  /// Returns whether there is a plan.
  bool solvable();
  /// Returns whether there is one with just these values, by component.
  bool allows(const std::vector<Sequence>& sequences);

 private:
  struct Part {  // a state that is to come about
    model::Index component, state;
    std::size_t start = 0, end = 0;  // points
  };
  struct Bound {
    std::size_t from, to;
    temporal::Duration lower, upper;
  };

  struct Asked {  // a condition of a behaviour, of a timeline that is predicted
    std::size_t start = 0;
    const model::Precondition* condition = nullptr;
  };

  bool decompose(std::size_t next);
  bool add_sequences(std::size_t component);
  bool extend(std::size_t component, Sequence& sequence);
  bool feasible();

  const model::Model& model_;
  std::size_t most_;
  const std::vector<Sequence>* fixed_ = nullptr;
  std::vector<Part> parts_;
  std::vector<Bound> bounds_;
  std::vector<Asked> asked_;
  std::vector<Sequence> sequences_;
};

}  // namespace roci::planner::timeline_htn::search
