// The formula grounder turns formulas and expressions under a full binding into disjunctions of ground
// conjunctions and into linear expressions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/instantiation/ground_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/reachability.hpp"

namespace roci::planner::temporal_pddl::grounding::instantiation {

/// A ground condition may have so many alternatives at most.
inline constexpr std::size_t kMaxAlternatives = 256;

/// Grounds formulas of one model. All that it is given must outlive it.
class FormulaGrounder {
 public:
  /// Takes in `touched` those of the atoms that hold at first which some effect is about. The others are
  /// true for ever; what is not reached is false for ever.
  FormulaGrounder(const lifted::StaticModel& static_model, const reachability::Reachability& reachability,
                  const lifted::TupleTable& touched, lifted::TupleTable& numbers,
                  task::ExpressionPool& expressions, const pddl::Problem& problem, const std::string& file)
      : static_model_(static_model),
        reachability_(reachability),
        touched_(touched),
        numbers_(numbers),
        expressions_(expressions),
        problem_(problem),
        file_(file) {}

  /// Grounds the formula. Throws ModelFailure (unsupported) for more than kMaxAlternatives, and for products
  /// of numbers that change.
  Disjunction ground(const lifted::LiftedFormula& formula, lifted::Binding& binding);

  /// Appends the atoms and numbers in the formula that may change. Atoms that are false for ever count if
  /// some effect deletes them.
  void read(const lifted::LiftedFormula& formula, lifted::Binding& binding, bool at_end,
            std::vector<ReadVariable>& result);

  /// Returns the expression in linear form, or nothing if a constant in it is undefined or it divides by 0. A number
  /// that cancels, as in (- (f) (f)), is read all the same: if it has no initial value it stands there with weight 0,
  /// until simplification/defined_numbers.hpp has seen it.
  std::optional<task::LinearExpression> linear(const lifted::LiftedExpression& expression,
                                               const lifted::Binding& binding);

  std::optional<std::uint32_t> reached_atom(const lifted::LiftedAtom& atom,
                                            const lifted::Binding& binding) const;
  /// Returns the atom; also one that is false for ever, if some effect deletes it and some condition reads
  /// it.
  std::optional<std::uint32_t> known_atom(const lifted::LiftedAtom& atom,
                                          const lifted::Binding& binding) const;
  task::NumberId number(task::FunctionId function, std::span<const task::ObjectId> objects);
  task::ExpressionId intern(const task::LinearExpression& expression) {
    return expressions_.intern(expression);
  }

  [[noreturn]] void fail(pddl::SourceLocation where, const std::string& message,
                         const std::string& remedy) const;

  const lifted::StaticModel& static_model() const { return static_model_; }

 private:
  // What an atom, or its negation, is found to be: false, true, or a literal that may be either.
  enum class Truth { no, yes, open };
  Truth decide(const lifted::LiftedFormula& formula, const lifted::Binding& binding,
               GroundLiteral& literal) const;
  void conjoin_atom(const lifted::LiftedFormula& formula, const lifted::Binding& binding,
                    Disjunction& result) const;
  std::optional<task::LinearExpression> linear_form(const lifted::LiftedExpression& expression,
                                                    const lifted::Binding& binding,
                                                    std::vector<task::NumberId>& cancelled);
  // Returns what the operator of `expression` makes of two forms; nothing if it divides by zero.
  std::optional<task::LinearExpression> combined(const lifted::LiftedExpression& expression,
                                                 const task::LinearExpression& left,
                                                 const task::LinearExpression& right) const;
  bool begins_with_value(task::NumberId number);
  Disjunction ground_atom(const lifted::LiftedFormula& formula, const lifted::Binding& binding) const;
  void read(const lifted::LiftedExpression& expression, const lifted::Binding& binding, bool at_end,
            std::vector<ReadVariable>& result);
  Disjunction ground_comparison(const lifted::LiftedFormula& formula, const lifted::Binding& binding);

  const lifted::StaticModel& static_model_;
  const reachability::Reachability& reachability_;
  const lifted::TupleTable& touched_;
  lifted::TupleTable& numbers_;
  task::ExpressionPool& expressions_;
  const pddl::Problem& problem_;
  const std::string& file_;
  std::optional<lifted::TupleTable> valued_;  // numbers with an initial value; made when it is asked for
};

/// Returns whether it may be that not all parts of the formula that can change are in all alternatives.
bool has_choice(const lifted::LiftedFormula& formula);

/// Returns what is true: one empty alternative.
Disjunction always();
bool is_certain(const Disjunction& alternatives);
/// Returns all ways to satisfy both; contradictions and alternatives that another one implies are dropped.
Disjunction both(const Disjunction& a, const Disjunction& b);
Disjunction either(Disjunction a, const Disjunction& b);
/// Returns nothing if the two contradict each other.
std::optional<Conjunction> merged(const Conjunction& a, const Conjunction& b);

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
