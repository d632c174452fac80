#include "planner_svc/temporal_pddl/grounding/lifted/derived_rules.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/pddl/stratify.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/model_failure.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

namespace {

constexpr std::size_t kMaxCopied = 250'000;  // conditions, for the alternatives of one body

// Splits bodies into rules.
class Splitter {
 public:
  Splitter(const pddl::Domain& domain, std::vector<DerivedRule>& result) : domain_(domain), result_(result) {}

  void split(DerivedRule whole, pddl::Condition body) {
    copied_ = 0;
    std::vector<Draft> drafts;  // the next one last
    drafts.push_back({std::move(whole), {std::move(body)}});
    while (!drafts.empty()) {
      Draft draft = std::move(drafts.back());
      drafts.pop_back();
      settle(std::move(draft), drafts);
    }
  }

 private:
  // All of `open` must still hold; what is settled stands in the rule's precondition.
  struct Draft {
    DerivedRule rule;
    std::vector<pddl::Condition> open;
  };

  // Ends with a rule, or with one more draft for each alternative of a disjunction.
  void settle(Draft draft, std::vector<Draft>& drafts) {
    auto& [rule, open] = draft;
    while (!open.empty()) {
      const pddl::Condition condition = std::move(open.back());
      open.pop_back();
      if (const auto* all = std::get_if<pddl::And>(&condition.node)) {
        open.insert(open.end(), all->parts.rbegin(), all->parts.rend());
      } else if (const auto* any = std::get_if<pddl::Or>(&condition.node)) {
        if (any->parts.size() == 1) {
          open.push_back(any->parts.front());
          continue;
        }
        for (std::size_t i = any->parts.size(); i-- > 0;) {
          copied_ += open.size() + std::get<pddl::And>(rule.rule.precondition.node).parts.size() + 1;
          if (copied_ > kMaxCopied) refuse(rule);
          drafts.push_back(draft);
          drafts.back().open.push_back(any->parts[i]);
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

  [[noreturn]] void refuse(const DerivedRule& rule) const {
    throw ModelFailure(
        temporal::Verdict::unsupported,
        pddl::Diagnostic{domain_.file, rule.rule.where,
                         "derived predicate " + rule.rule.name + " has too many combinations of alternatives",
                         "give a part of its body a derived predicate of its own"});
  }

  // Quantifiers side by side may use one name; the second of them stays where it is.
  static bool can_take(const DerivedRule& rule, const std::vector<pddl::TypedName>& variables) {
    return std::ranges::none_of(variables, [&](const pddl::TypedName& variable) {
      return std::ranges::count(rule.rule.parameters, variable.name, &pddl::TypedName::name) > 0;
    });
  }

  const pddl::Domain& domain_;
  std::vector<DerivedRule>& result_;
  std::size_t copied_ = 0;
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
  Splitter splitter(domain, result);
  for (const auto& derived : domain.derived)
    splitter.split(without_body(derived, strata.layer.at(derived.head.name)), derived.body);
  std::ranges::stable_sort(result, {}, &DerivedRule::layer);
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::lifted
