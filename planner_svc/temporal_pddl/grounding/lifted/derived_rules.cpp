#include "planner_svc/temporal_pddl/grounding/lifted/derived_rules.hpp"

#include <algorithm>
#include <utility>

#include "core/pddl/stratify.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

namespace {

// Splits bodies into rules: all of `open` must still hold; what is settled stands in the rule's precondition.
class Splitter {
 public:
  explicit Splitter(std::vector<DerivedRule>& result) : result_(result) {}

  void split(DerivedRule rule, std::vector<pddl::Condition> open) {
    while (!open.empty()) {
      const pddl::Condition condition = std::move(open.back());
      open.pop_back();
      if (const auto* all = std::get_if<pddl::And>(&condition.node)) {
        open.insert(open.end(), all->parts.rbegin(), all->parts.rend());
      } else if (const auto* any = std::get_if<pddl::Or>(&condition.node)) {
        for (const auto& part : any->parts) {
          open.push_back(part);
          split(rule, open);
          open.pop_back();
        }
        return;
      } else if (const auto* exists = std::get_if<pddl::Exists>(&condition.node);
                 exists && can_take(rule, exists->variables)) {
        auto& parameters = rule.rule.parameters;
        parameters.insert(parameters.end(), exists->variables.begin(), exists->variables.end());
        open.push_back(*exists->body);
      } else {
        std::get<pddl::And>(rule.rule.precondition.node).parts.push_back(condition);
      }
    }
    result_.push_back(std::move(rule));
  }

 private:
  // Quantifiers side by side may use one name; the second of them stays where it is.
  static bool can_take(const DerivedRule& rule, const std::vector<pddl::TypedName>& variables) {
    return std::ranges::none_of(variables, [&](const pddl::TypedName& variable) {
      return std::ranges::count(rule.rule.parameters, variable.name, &pddl::TypedName::name) > 0;
    });
  }

  std::vector<DerivedRule>& result_;
};

DerivedRule without_body(const pddl::DerivedPredicate& source, int layer) {
  DerivedRule result;
  result.layer = layer;
  result.rule.name = source.head.name;
  result.rule.parameters = source.head.parameters;
  result.rule.precondition.node = pddl::And{};
  result.rule.precondition.where = source.body.where;
  result.rule.where = source.head.where;
  pddl::Literal head;
  head.atom.symbol = source.head.name;
  head.atom.where = source.head.where;
  for (const auto& parameter : source.head.parameters)
    head.atom.arguments.push_back({parameter.name, parameter.where});
  pddl::Effect effect;
  effect.node = std::move(head);
  effect.where = source.head.where;
  result.rule.effects.push_back(std::move(effect));
  return result;
}

}  // namespace

std::vector<DerivedRule> derived_rules(const pddl::Domain& domain) {
  const pddl::Strata strata = pddl::stratify(domain);
  std::vector<DerivedRule> result;
  Splitter splitter(result);
  for (const auto& derived : domain.derived)
    splitter.split(without_body(derived, strata.layer.at(derived.head.name)), {derived.body});
  std::ranges::stable_sort(result, {}, &DerivedRule::layer);
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
