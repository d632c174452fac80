// Objects in place of the parameters of an action: its conditions and effects as those of one instance.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"

namespace roci::planner::temporal_pddl::extraction {

/// Constant fluents and values of external functions become numbers, and so do expressions of numbers alone.
class Substitution {
 public:
  /// Takes the object of each parameter by its name, with its question mark.
  Substitution(const grounding::lifted::Symbols& symbols,
               const grounding::lifted::ConstantFunctions& constants,
               std::map<std::string, std::string> variables)
      : symbols_(symbols), constants_(constants), variables_(std::move(variables)) {}

  /// Returns the parts of a conjunction, static ones too.
  std::vector<pddl::Condition> conditions(const pddl::Condition& condition) const;
  /// Returns the effects; `forall` is written out, and a `when` has one effect.
  std::vector<pddl::Effect> effects(const std::vector<pddl::Effect>& effects) const;

 private:
  pddl::Term ground(const pddl::Term& term) const;
  pddl::Atom ground(const pddl::Atom& atom) const;
  pddl::Expression ground(const pddl::Expression& expression) const;
  pddl::Condition ground(const pddl::Condition& condition) const;
  void add_conditions(const pddl::Condition& condition, std::vector<pddl::Condition>& result) const;
  void add_effect(const pddl::Effect& effect, std::vector<pddl::Effect>& result) const;
  Substitution without(const std::vector<pddl::TypedName>& variables) const;

  const grounding::lifted::Symbols& symbols_;
  const grounding::lifted::ConstantFunctions& constants_;
  std::map<std::string, std::string> variables_;
};

}  // namespace roci::planner::temporal_pddl::extraction
