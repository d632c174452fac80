// Supports tell what the truth of derived atoms hangs on, and what makes them false.
#pragma once

#include <cstdint>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

/// Holds what a literal hangs on: changes outside of these lists cannot make it false. Of a listed literal,
/// only its becoming false can.
struct Support {
  std::vector<instantiation::GroundLiteral> literals;  ///< are of atoms that are not derived, and sorted
  std::vector<task::NumberId> numbers;                 ///< sorted
};

/// Answers for the rules of one ground model, which must outlive it.
class DerivedSupport {
 public:
  explicit DerivedSupport(const instantiation::GroundModel& model);

  bool is_derived(std::uint32_t atom) const { return !rules_[atom].empty(); }
  /// Returns the support of a literal; one that is not derived supports itself.
  Support of(instantiation::GroundLiteral literal) const;

  /// Returns when the given negations of derived atoms hold, and those that these ask for, relaxed: each
  /// rule has a negation as its head, and as its body one way in which that may hold, which is one literal
  /// for each rule of the atom that breaks it. Rules that are hard to break (numbers, recursion, more than
  /// kMaxWays ways) are taken as broken.
  std::vector<instantiation::GroundRule> negations(std::vector<std::uint32_t> atoms) const;

 private:
  static constexpr std::size_t kMaxWays = 16;

  void add_negations(std::uint32_t atom, std::vector<instantiation::GroundRule>& result) const;

  const instantiation::GroundModel& model_;
  std::vector<std::vector<std::uint32_t>> rules_;  // by atom: indices of model.rules
};

}  // namespace roci::planner::temporal_pddl::grounding::simplification
