#include "tests/unit/planner_svc/temporal_pddl/random_derived.hpp"

#include <set>
#include <string>
#include <utility>

#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl::testing {

namespace {

constexpr int kDerived = 3;

class Deriver {
 public:
  explicit Deriver(std::mt19937_64& random) : random_(random) {}

  void run(pddl::Domain& domain, pddl::Problem& problem) {
    const std::vector<pddl::Signature> facts = domain.predicates;
    for (int i = 0; i < kDerived; ++i) {
      const std::string name = "d" + std::to_string(i);
      for (int rules = 1 + below(2); rules > 0; --rules) {
        pddl::DerivedPredicate derived;
        derived.head.name = name;
        derived.body = body(facts, i);
        domain.derived.push_back(std::move(derived));
      }
      domain.predicates.push_back({name, {}, {}});
    }
    for (auto& action : domain.actions) replace(action.precondition);
    for (auto& action : domain.durative_actions) {
      for (auto* condition :
           {&action.condition.at_start, &action.condition.over_all, &action.condition.at_end})
        replace(*condition);
    }
    replace(problem.goal);
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }

  static pddl::Condition atom(const std::string& name) {
    pddl::Condition result;
    result.node = pddl::Atom{name, {}, {}};
    return result;
  }

  // Of facts and of derived predicates before number `known`; no name twice in one body.
  pddl::Condition literal(const std::vector<pddl::Signature>& facts, int known, std::set<std::string>& used) {
    if (below(6) == 0) {
      pddl::Comparison comparison;
      comparison.op = pddl::ComparisonOperator::greater_equal;
      comparison.left.node = pddl::Atom{"x", {}, {}};
      comparison.right.node = pddl::Number{static_cast<double>(below(3))};
      pddl::Condition result;
      result.node = std::move(comparison);
      return result;
    }
    std::string name;
    do {
      const bool derived = known > 0 && below(3) == 0;
      name = derived ? "d" + std::to_string(below(known))
                     : facts[static_cast<std::size_t>(below(static_cast<int>(facts.size())))].name;
    } while (!used.insert(name).second);
    if (below(3) > 0) return atom(name);
    pddl::Condition result;
    result.node = pddl::Not{atom(name)};
    return result;
  }

  pddl::Condition body(const std::vector<pddl::Signature>& facts, int known) {
    std::vector<pddl::Condition> parts;
    std::set<std::string> used;
    for (int n = 1 + below(2); n >= 0; --n) parts.push_back(literal(facts, known, used));
    pddl::Condition result;
    if (below(2) == 0) {
      result.node = pddl::Or{std::move(parts)};
    } else {
      result.node = pddl::And{std::move(parts)};
    }
    return result;
  }

  void replace(pddl::Condition& condition) {
    if (auto* all = std::get_if<pddl::And>(&condition.node)) {
      for (auto& part : all->parts) replace(part);
    } else if (auto* negation = std::get_if<pddl::Not>(&condition.node)) {
      replace(*negation->body);
    } else if (auto* fact = std::get_if<pddl::Atom>(&condition.node); fact && below(2) == 0) {
      fact->symbol = "d" + std::to_string(below(kDerived));
    }
  }

  std::mt19937_64& random_;
};

}  // namespace

Model random_derived_task(std::mt19937_64& random) {
  // Without durations of 0: what rules that can never fire are made of is no condition for the planner, but
  // is one for the validator.
  Model result = random_task(random, 1);
  Deriver(random).run(result.domain, result.problem);
  result.domain.requirements.push_back({":derived-predicates", {}});
  result.domain.requirements.push_back({":disjunctive-preconditions", {}});
  return result;
}

}  // namespace roci::planner::temporal_pddl::testing
