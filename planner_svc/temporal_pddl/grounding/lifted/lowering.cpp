#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/pddl/overloaded.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/derived_rules.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/model_failure.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

using task::PredicateId;
using temporal::Verdict;

namespace {

using Kind = LiftedFormula::Kind;

pddl::ComparisonOperator opposite(pddl::ComparisonOperator op) {
  switch (op) {
    case pddl::ComparisonOperator::less:
      return pddl::ComparisonOperator::greater_equal;
    case pddl::ComparisonOperator::less_equal:
      return pddl::ComparisonOperator::greater;
    case pddl::ComparisonOperator::greater_equal:
      return pddl::ComparisonOperator::less;
    default:
      return pddl::ComparisonOperator::less_equal;
  }
}

// Lowers one action or goal; knows which variable stands in which slot.
class Lowering {
 public:
  Lowering(const Symbols& symbols, const std::string& file, std::uint32_t slots)
      : symbols_(symbols), file_(file), slots_(slots) {}

  void bind_parameters(const std::vector<pddl::TypedName>& parameters, LiftedAction& action) {
    for (auto& slot : open(parameters)) action.parameters.push_back(std::move(slot.domain));
  }

  // Refuses what has too many of them.
  std::uint32_t slots(pddl::SourceLocation where) const {
    if (slots_ > kMaxSlots) fail(where, "over " + std::to_string(kMaxSlots) + " variables are not supported");
    return slots_;
  }

  LiftedAtom atom(PredicateId predicate, const std::vector<pddl::Term>& terms) const {
    LiftedAtom result{predicate, {}};
    for (const auto& term : terms) result.arguments.push_back(argument(term));
    return result;
  }

  LiftedExpression expression(const pddl::Expression& source) const {
    LiftedExpression result;
    result.where = source.where;
    std::visit(pddl::Overloaded{
                   [&](const pddl::Number& number) { result.number = number.value; },
                   [&](const pddl::Atom& call) {
                     result.kind = LiftedExpression::Kind::function;
                     result.function = symbols_.function(call.symbol);
                     for (const auto& term : call.arguments) result.arguments.push_back(argument(term));
                   },
                   [&](const pddl::DurationVariable&) { result.kind = LiftedExpression::Kind::duration; },
                   [&](const pddl::TotalTime&) { result.kind = LiftedExpression::Kind::duration; },
                   [&](const pddl::Arithmetic& arithmetic) {
                     result.kind = LiftedExpression::Kind::arithmetic;
                     result.op = arithmetic.op;
                     for (const auto& operand : arithmetic.operands)
                       result.operands.push_back(expression(operand));
                   },
                   [&](const auto&) { fail(source.where, "time as a number is not supported here"); },
               },
               source.node);
    return result;
  }

  LiftedFormula formula(const pddl::Condition& source, bool positive) {
    LiftedFormula result;
    result.where = source.where;
    std::visit(
        pddl::Overloaded{
            [&](const pddl::And& a) {
              junction(a.parts, positive ? Kind::conjunction : Kind::disjunction, positive, result);
            },
            [&](const pddl::Or& o) {
              junction(o.parts, positive ? Kind::disjunction : Kind::conjunction, positive, result);
            },
            [&](const pddl::Not& n) { result = formula(*n.body, !positive); },
            [&](const pddl::Imply& i) {
              result.kind = positive ? Kind::disjunction : Kind::conjunction;
              result.parts.push_back(formula(*i.premise, !positive));
              result.parts.push_back(formula(*i.conclusion, positive));
            },
            [&](const pddl::Forall& f) {
              quantifier(f.variables, *f.body, positive ? Kind::forall : Kind::exists, positive, result);
            },
            [&](const pddl::Exists& e) {
              quantifier(e.variables, *e.body, positive ? Kind::exists : Kind::forall, positive, result);
            },
            [&](const pddl::Atom& a) {
              result.kind = positive ? Kind::atom : Kind::not_atom;
              result.atom = atom(symbols_.predicate(a.symbol), a.arguments);
            },
            [&](const pddl::TermEquality& e) {
              result.kind = positive ? Kind::equal : Kind::not_equal;
              result.atom.arguments = {argument(e.left), argument(e.right)};
            },
            [&](const pddl::Comparison& c) { comparison(c, positive, result); },
        },
        source.node);
    return result;
  }

  // Appends to `result` what `source` says under the quantifiers and conditions collected in `frame`.
  void effect(const pddl::Effect& source, LiftedEffect frame, std::vector<LiftedEffect>& result) {
    frame.where = source.where;
    std::visit(pddl::Overloaded{
                   [&](const pddl::Literal& literal) {
                     frame.kind = literal.negated ? LiftedEffect::Kind::remove : LiftedEffect::Kind::add;
                     frame.atom = atom(symbols_.predicate(literal.atom.symbol), literal.atom.arguments);
                     result.push_back(std::move(frame));
                   },
                   [&](const pddl::Assignment& assignment) {
                     frame.kind = LiftedEffect::Kind::numeric;
                     frame.function = symbols_.function(assignment.fluent.symbol);
                     frame.atom = atom(PredicateId(), assignment.fluent.arguments);
                     frame.op = assignment.op;
                     frame.value = expression(assignment.value);
                     result.push_back(std::move(frame));
                   },
                   [&](const pddl::When& when) {
                     if (!is_true(when.condition.over_all)) {
                       fail(source.where, "conditional effects on an `over all` condition are not supported");
                     }
                     restrict(when.condition.at_start, frame.start_condition, frame.start_otherwise);
                     restrict(when.condition.at_end, frame.end_condition, frame.end_otherwise);
                     for (const auto& part : when.effects) effect(part, frame, result);
                   },
                   [&](const pddl::ForallEffect& forall) {
                     const auto outer = variables_.size();
                     for (auto& slot : open(forall.variables)) frame.quantified.push_back(std::move(slot));
                     for (const auto& part : forall.effects) effect(part, frame, result);
                     variables_.resize(outer);
                   },
               },
               source.node);
  }

  [[noreturn]] void fail(pddl::SourceLocation where, std::string message) const {
    throw ModelFailure(Verdict::unsupported,
                       pddl::Diagnostic{file_, where, std::move(message), "reformulate the action"});
  }

 private:
  static bool is_true(const pddl::Condition& condition) {
    const auto* conjunction = std::get_if<pddl::And>(&condition.node);
    return conjunction && conjunction->parts.empty();
  }

  Argument argument(const pddl::Term& term) const {
    if (!term.is_variable()) return {false, static_cast<std::uint32_t>(symbols_.object(term.name).value)};
    const auto found = std::find_if(variables_.rbegin(), variables_.rend(),
                                    [&](const auto& variable) { return variable.first == term.name; });
    return {true, found->second};
  }

  std::vector<QuantifiedSlot> open(const std::vector<pddl::TypedName>& variables) {
    std::vector<QuantifiedSlot> result;
    for (const auto& variable : variables) {
      variables_.emplace_back(variable.name, slots_);
      result.push_back({slots_++, symbols_.of_types(variable.types)});
    }
    return result;
  }

  void junction(const std::vector<pddl::Condition>& parts, Kind kind, bool positive, LiftedFormula& result) {
    result.kind = kind;
    for (const auto& part : parts) result.parts.push_back(formula(part, positive));
  }

  void quantifier(const std::vector<pddl::TypedName>& variables, const pddl::Condition& body, Kind kind,
                  bool positive, LiftedFormula& result) {
    const auto outer = variables_.size();
    result.kind = kind;
    result.quantified = open(variables);
    result.parts.push_back(formula(body, positive));
    variables_.resize(outer);
  }

  void comparison(const pddl::Comparison& source, bool positive, LiftedFormula& result) {
    const auto compare = [&](pddl::ComparisonOperator op) {
      LiftedFormula part;
      part.kind = Kind::comparison;
      part.comparison = op;
      part.sides = {expression(source.left), expression(source.right)};
      part.where = result.where;
      return part;
    };
    if (positive || source.op != pddl::ComparisonOperator::equal) {
      result = compare(positive ? source.op : opposite(source.op));
    } else {
      result.kind = Kind::disjunction;
      result.parts = {compare(pddl::ComparisonOperator::less), compare(pddl::ComparisonOperator::greater)};
    }
  }

  // Sets condition := condition ∧ more and otherwise := otherwise ∨ ¬more.
  void restrict(const pddl::Condition& more, LiftedFormula& condition, LiftedFormula& otherwise) {
    if (is_true(more)) return;
    if (condition.is_true()) otherwise.kind = Kind::disjunction;  // without parts: false
    LiftedFormula both;
    both.parts.push_back(std::move(condition));
    both.parts.push_back(formula(more, true));
    condition = std::move(both);
    otherwise.parts.push_back(formula(more, false));
  }

  const Symbols& symbols_;
  const std::string& file_;
  std::uint32_t slots_;
  std::vector<std::pair<std::string, std::uint32_t>> variables_;  // innermost last
};

void lower_effects(const std::vector<pddl::Effect>& effects, Lowering& lowering,
                   std::vector<LiftedEffect>& result) {
  for (const auto& effect : effects) lowering.effect(effect, {}, result);
}

LiftedAction lower(const pddl::Action& source, const Symbols& symbols, const std::string& file) {
  LiftedAction action;
  action.name = source.name;
  action.durative = false;
  action.where = source.where;
  Lowering lowering(symbols, file, 0);
  lowering.bind_parameters(source.parameters, action);
  action.at_start = lowering.formula(source.precondition, true);
  lower_effects(source.effects, lowering, action.start_effects);
  action.slots = lowering.slots(source.where);
  return action;
}

LiftedAction lower(const pddl::DurativeAction& source, const Symbols& symbols, const std::string& file) {
  LiftedAction action;
  action.name = source.name;
  action.where = source.where;
  Lowering lowering(symbols, file, 0);
  lowering.bind_parameters(source.parameters, action);
  for (const auto& constraint : source.duration) {
    action.duration.push_back({constraint.op, lowering.expression(constraint.bound), constraint.at});
  }
  action.at_start = lowering.formula(source.condition.at_start, true);
  action.over_all = lowering.formula(source.condition.over_all, true);
  action.at_end = lowering.formula(source.condition.at_end, true);
  lower_effects(source.start_effects, lowering, action.start_effects);
  lower_effects(source.end_effects, lowering, action.end_effects);
  for (const auto& effect : action.start_effects) {
    if (!effect.end_condition.is_true())
      lowering.fail(effect.where, "a start effect cannot depend on the end");
  }
  action.slots = lowering.slots(source.where);
  return action;
}

}  // namespace

std::vector<LiftedAction> lower_actions(const pddl::Domain& domain, const Symbols& symbols) {
  std::vector<LiftedAction> result;
  for (const auto& action : domain.actions) result.push_back(lower(action, symbols, domain.file));
  for (const auto& action : domain.durative_actions) result.push_back(lower(action, symbols, domain.file));
  for (const auto& derived : derived_rules(domain)) {
    result.push_back(lower(derived.rule, symbols, domain.file));
    result.back().layer = derived.layer;
  }
  return result;
}

LiftedExpression lower_metric(const pddl::Expression& metric, const std::string& file,
                              const Symbols& symbols) {
  return Lowering(symbols, file, 0).expression(metric);
}

LiftedFormula lower_goal(const pddl::Condition& goal, const std::string& file, const Symbols& symbols,
                         std::uint32_t& slots) {
  Lowering lowering(symbols, file, 0);
  LiftedFormula result = lowering.formula(goal, true);
  slots = lowering.slots(goal.where);
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
