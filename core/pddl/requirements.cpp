#include "core/pddl/requirements.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <vector>

#include "core/pddl/overloaded.hpp"

namespace roci::pddl {

namespace {

// Each flag with those that are as good.
struct Flag {
  std::string_view name;
  std::vector<std::string_view> implied_by;
};

const std::vector<Flag>& flags() {
  static const std::vector<Flag> all = {
      {":typing", {":adl"}},
      {":equality", {":adl"}},
      {":negative-preconditions", {":adl", ":disjunctive-preconditions"}},
      {":disjunctive-preconditions", {":adl"}},
      {":existential-preconditions", {":adl", ":quantified-preconditions"}},
      {":universal-preconditions", {":adl", ":quantified-preconditions"}},
      {":conditional-effects", {":adl"}},
      {":numeric-fluents", {":fluents", ":action-costs", ":continuous-effects", ":modules"}},
      {":durative-actions", {":duration-inequalities", ":continuous-effects", ":timed-initial-literals"}},
      {":duration-inequalities", {}},
      {":continuous-effects", {}},
      {":timed-initial-literals", {":timed-initial-fluents"}},
      {":timed-initial-fluents", {":timed-initial-literals"}},
      {":derived-predicates", {}}};
  return all;
}

// Walks a tree and keeps the first place at which each flag is needed.
class Needs {
 public:
  void need(std::string_view flag, SourceLocation where) { first_.try_emplace(flag, where); }

  void types_of(const std::vector<TypedName>& names) {
    for (const TypedName& name : names)
      if (name.types.size() != 1 || name.types.front() != "object") need(":typing", name.where);
  }

  void condition(const Condition& condition) {
    const auto parts = [&](const std::vector<Condition>& all) {
      for (const Condition& part : all) this->condition(part);
    };
    const auto quantified = [&](const auto& quantifier, std::string_view flag) {
      need(flag, condition.where);
      types_of(quantifier.variables);
      this->condition(*quantifier.body);
    };
    std::visit(
        Overloaded{[&](const And& all) { parts(all.parts); },
                   [&](const Or& any) {
                     need(":disjunctive-preconditions", condition.where);
                     parts(any.parts);
                   },
                   [&](const Not& negation) {
                     if (std::holds_alternative<Atom>(negation.body->node))
                       need(":negative-preconditions", condition.where);
                     this->condition(*negation.body);
                   },
                   [&](const Imply& imply) {
                     need(":disjunctive-preconditions", condition.where);
                     this->condition(*imply.premise);
                     this->condition(*imply.conclusion);
                   },
                   [&](const Forall& forall) { quantified(forall, ":universal-preconditions"); },
                   [&](const Exists& exists) { quantified(exists, ":existential-preconditions"); },
                   [](const Atom&) {}, [&](const TermEquality&) { need(":equality", condition.where); },
                   [&](const Comparison&) { need(":numeric-fluents", condition.where); }},
        condition.node);
  }

  void timed(const TimedCondition& condition) {
    this->condition(condition.at_start);
    this->condition(condition.over_all);
    this->condition(condition.at_end);
  }

  void effects(const std::vector<Effect>& effects) {
    for (const Effect& effect : effects) {
      std::visit(Overloaded{[](const Literal&) {},
                            [&](const Assignment&) { need(":numeric-fluents", effect.where); },
                            [&](const When& when) {
                              need(":conditional-effects", effect.where);
                              timed(when.condition);
                              this->effects(when.effects);
                            },
                            [&](const ForallEffect& forall) {
                              if (!first_.contains(":universal-preconditions"))
                                need(":conditional-effects", effect.where);
                              types_of(forall.variables);
                              this->effects(forall.effects);
                            }},
                 effect.node);
    }
  }

  void signatures(const std::vector<Signature>& signatures) {
    for (const Signature& signature : signatures) types_of(signature.parameters);
  }

  void domain(const Domain& domain) {
    for (const TypedName& type : domain.types) need(":typing", type.where);
    types_of(domain.constants);
    signatures(domain.predicates);
    signatures(domain.functions);
    for (const Signature& function : domain.functions) need(":numeric-fluents", function.where);
    for (const Module& module : domain.modules) signatures(module.functions);
    for (const DerivedPredicate& derived : domain.derived) {
      need(":derived-predicates", derived.head.where);
      condition(derived.body);
    }
    for (const Action& action : domain.actions) {
      types_of(action.parameters);
      condition(action.precondition);
      effects(action.effects);
    }
    for (const DurativeAction& action : domain.durative_actions) durative(action);
  }

  void problem(const Problem& problem) {
    types_of(problem.objects);
    for (const InitialValue& value : problem.values) need(":numeric-fluents", value.fluent.where);
    for (const TimedLiteral& timed : problem.timed_literals) need(":timed-initial-literals", timed.where);
    for (const TimedValue& timed : problem.timed_values) need(":timed-initial-fluents", timed.where);
    condition(problem.goal);
  }

  std::map<std::string, SourceLocation> lacking(const std::set<std::string_view>& given) const {
    std::map<std::string, SourceLocation> out;
    for (const Flag& flag : flags()) {
      const auto first = first_.find(flag.name);
      if (first == first_.end() || given.contains(flag.name)) continue;
      const bool implied =
          std::ranges::any_of(flag.implied_by, [&](std::string_view other) { return given.contains(other); });
      if (!implied) out.emplace(first->first, first->second);
    }
    return out;
  }

 private:
  void durative(const DurativeAction& action) {
    need(":durative-actions", action.where);
    types_of(action.parameters);
    for (const DurationConstraint& constraint : action.duration)
      if (constraint.op != ComparisonOperator::equal) need(":duration-inequalities", constraint.where);
    timed(action.condition);
    effects(action.start_effects);
    effects(action.end_effects);
    effects(action.continuous_effects);
    for (const Effect& effect : action.continuous_effects) need(":continuous-effects", effect.where);
  }

  std::map<std::string_view, SourceLocation> first_;  // flags are literals
};

void add_flags(const std::vector<Requirement>& requirements, std::set<std::string_view>& given) {
  for (const Requirement& requirement : requirements) given.insert(requirement.keyword);
}

}  // namespace

std::map<std::string, SourceLocation> lacking_requirements(const Domain& domain) {
  std::set<std::string_view> given;
  add_flags(domain.requirements, given);
  Needs needs;
  needs.domain(domain);
  return needs.lacking(given);
}

std::map<std::string, SourceLocation> lacking_requirements(const Problem& problem, const Domain& domain) {
  std::set<std::string_view> given;
  add_flags(domain.requirements, given);
  add_flags(problem.requirements, given);
  Needs needs;
  needs.problem(problem);
  auto lacking = needs.lacking(given);
  if (lacking.empty()) return lacking;
  Needs in_domain;  // told with the domain
  in_domain.domain(domain);
  for (const auto& [flag, ignored] : in_domain.lacking(given)) lacking.erase(flag);
  return lacking;
}

}  // namespace roci::pddl
