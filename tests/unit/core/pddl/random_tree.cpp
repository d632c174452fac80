#include "tests/unit/core/pddl/random_tree.hpp"

namespace roci::pddl {

double RandomTree::number() {
  const double small = static_cast<double>(below(2001) - 1000) / 8;
  return chance(80) ? small : std::uniform_real_distribution<double>(-1e12, 1e12)(random_);
}

std::vector<std::string> RandomTree::types() {
  if (chance(30)) return {"object"};
  std::vector<std::string> all = {name()};
  while (chance(20)) all.push_back(name());
  return all;
}

std::vector<TypedName> RandomTree::names(std::string prefix) {
  return several(3, [&] { return TypedName{prefix + name(), types(), {}}; });
}

Atom RandomTree::atom() {
  return {name(), several(3, [&] { return term(); }), {}};
}

Expression RandomTree::expression(int depth, bool in_effect) {
  if (depth == 0 || chance(40)) {
    if (in_effect && chance(20)) return {DurationVariable{}, {}};
    if (chance(50)) return {Number{number()}, {}};
    return {atom(), {}};
  }
  Arithmetic arithmetic;
  arithmetic.op = static_cast<ArithmeticOperator>(below(4));
  const bool many = arithmetic.op == ArithmeticOperator::add || arithmetic.op == ArithmeticOperator::multiply;
  const bool negative = arithmetic.op == ArithmeticOperator::subtract && chance(30);
  const int count = negative ? 1 : (many ? 2 + below(2) : 2);
  for (int i = 0; i < count; ++i) arithmetic.operands.push_back(expression(depth - 1, in_effect));
  return {arithmetic, {}};
}

Condition RandomTree::condition(int depth) {
  const auto deeper = [&] { return condition(depth - 1); };
  switch (depth == 0 ? 6 + below(3) : below(9)) {
    case 0:
      return {And{several(3, deeper)}, {}};
    case 1:
      return {Or{several(3, deeper)}, {}};
    case 2:
      return {Not{deeper()}, {}};
    case 3:
      return {Imply{deeper(), deeper()}, {}};
    case 4:
      return {Forall{names("?"), deeper()}, {}};
    case 5:
      return {Exists{names("?"), deeper()}, {}};
    case 6:
      return {TermEquality{term(), term()}, {}};
    case 7:
      return {
          Comparison{
              static_cast<ComparisonOperator>(below(5)), expression(depth, false), {Number{number()}, {}}},
          {}};
    default:
      return {atom(), {}};
  }
}

Condition RandomTree::timed_part() { return chance(30) ? Condition{} : condition(3); }

Effect RandomTree::effect(int depth, Place place) {
  const int kind = place == Place::continuous ? 1 : below(2);
  if (depth > 0 && chance(40)) {
    if (chance(50)) {
      When when;
      if (place == Place::plain) {
        when.condition.at_start = condition(2);
      } else {
        when.condition = timed();
      }
      when.effects = effects(depth - 1, place, 1);
      return {when, {}};
    }
    return {ForallEffect{names("?"), effects(depth - 1, place, 1)}, {}};
  }
  if (kind == 0) return {Literal{atom(), chance(50)}, {}};
  Expression value = expression(2, place != Place::plain);
  if (place == Place::continuous)
    value = {Arithmetic{ArithmeticOperator::multiply, {{ContinuousTime{}, {}}, value}}, {}};
  return {Assignment{static_cast<AssignmentOperator>(below(5)), atom(), value}, {}};
}

std::vector<Effect> RandomTree::effects(int depth, Place place, int least) {
  std::vector<Effect> all;
  for (int i = least + below(3); i > 0; --i) all.push_back(effect(depth, place));
  return all;
}

Action RandomTree::action() { return {name(), names("?"), condition(4), effects(3, Place::plain, 0), {}}; }

DurativeAction RandomTree::durative_action() {
  static constexpr ComparisonOperator kOperators[] = {
      ComparisonOperator::less_equal, ComparisonOperator::equal, ComparisonOperator::greater_equal};
  DurativeAction action;
  action.name = name();
  action.parameters = names("?");
  action.duration = several(2, [&] {
    return DurationConstraint{
        kOperators[below(3)], expression(2, false), chance(80) ? TimePoint::start : TimePoint::end, {}};
  });
  action.condition = timed();
  action.start_effects = effects(2, Place::durative, 0);
  action.end_effects = effects(2, Place::durative, 0);
  if (chance(20)) action.continuous_effects = effects(2, Place::continuous, 1);
  return action;
}

Domain RandomTree::domain() {
  Domain d;
  d.name = name();
  if (chance(50)) d.requirements = {{":typing", {}}, {":durative-actions", {}}};
  d.types = names("");
  d.constants = names("");
  d.predicates = several(4, [&] { return signature(); });
  d.functions = several(4, [&] { return signature(); });
  d.modules = several(2, [&] { return Module{name(), several(3, [&] { return signature(); }), {}, {}}; });
  d.derived = several(2, [&] { return DerivedPredicate{signature(), condition(3)}; });
  d.actions = several(3, [&] { return action(); });
  d.durative_actions = several(3, [&] { return durative_action(); });
  return d;
}

Problem RandomTree::problem() {
  const auto time = [&] { return static_cast<double>(below(100000)) / 1000; };
  Problem p;
  p.name = name();
  p.domain_name = name();
  p.objects = names("");
  p.facts = several(5, [&] { return Atom{name(), several(2, [&] { return Term{name(), {}}; }), {}}; });
  p.false_facts = several(2, [&] { return atom(); });
  p.values = several(4, [&] { return InitialValue{atom(), number()}; });
  p.timed_literals = several(3, [&] { return TimedLiteral{time(), {atom(), chance(50)}, {}}; });
  p.timed_values = several(3, [&] { return TimedValue{time(), atom(), number(), {}}; });
  p.goal = condition(4);
  if (chance(50)) {
    p.metric = Metric{chance(50) ? Metric::Sense::minimize : Metric::Sense::maximize,
                      {Arithmetic{ArithmeticOperator::add, {{TotalTime{}, {}}, expression(2, false)}}, {}},
                      {}};
  }
  return p;
}

}  // namespace roci::pddl
