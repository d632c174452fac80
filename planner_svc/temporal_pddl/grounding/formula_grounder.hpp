// Formulas and expressions under a full binding: disjunctions of ground conjunctions, linear expressions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/ground_actions.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability.hpp"
#include "planner_svc/temporal_pddl/grounding/world.hpp"

namespace roci::planner::temporal_pddl {

// How many alternatives a ground condition may have.
inline constexpr std::size_t kMaxAlternatives = 256;

class FormulaGrounder {
 public:
  // `touched`: of the atoms that hold at first those that some effect is about. The others are true for ever;
  // what is not reached is false for ever.
  FormulaGrounder(const World& world, const Reachability& reachability, const TupleTable& touched,
                  TupleTable& numbers, ExpressionPool& expressions, const std::string& file)
      : world_(world),
        reachability_(reachability),
        touched_(touched),
        numbers_(numbers),
        expressions_(expressions),
        file_(file) {}

  // Throws Refusal (unsupported) for more than kMaxAlternatives, and for products of numbers that change.
  Disjunction ground(const LiftedFormula& formula, Binding& binding);

  // Appends the atoms and numbers in the formula that may change. Atoms that are false for ever count if some
  // effect deletes them.
  void mention(const LiftedFormula& formula, Binding& binding, bool at_end, std::vector<Mention>& result);

  // None: a constant in it is undefined, or a division by 0.
  std::optional<LinearExpression> linear(const LiftedExpression& expression, const Binding& binding);

  std::optional<std::uint32_t> reached_atom(const LiftedAtom& atom, const Binding& binding) const;
  // Also one that is false for ever, if some effect deletes it and some condition mentions it.
  std::optional<std::uint32_t> known_atom(const LiftedAtom& atom, const Binding& binding) const;
  NumberId number(FunctionId function, const std::vector<ObjectId>& objects);
  ExpressionId intern(const LinearExpression& expression) { return expressions_.intern(expression); }

  [[noreturn]] void refuse(pddl::SourceLocation where, const std::string& message,
                           const std::string& remedy) const;

  const World& world() const { return world_; }

 private:
  Disjunction ground_atom(const LiftedFormula& formula, const Binding& binding) const;
  void mention(const LiftedExpression& expression, const Binding& binding, bool at_end,
               std::vector<Mention>& result);
  Disjunction ground_comparison(const LiftedFormula& formula, const Binding& binding);

  const World& world_;
  const Reachability& reachability_;
  const TupleTable& touched_;
  TupleTable& numbers_;
  ExpressionPool& expressions_;
  const std::string& file_;
};

// May it be that not all parts of it that can change are in all alternatives?
bool has_choice(const LiftedFormula& formula);

Disjunction always();
bool is_certain(const Disjunction& alternatives);
// All ways to satisfy both; contradictions and alternatives that another one implies are dropped.
Disjunction both(const Disjunction& a, const Disjunction& b);
Disjunction either(Disjunction a, const Disjunction& b);
// None if the two contradict each other.
std::optional<Conjunction> merged(const Conjunction& a, const Conjunction& b);

}  // namespace roci::planner::temporal_pddl
