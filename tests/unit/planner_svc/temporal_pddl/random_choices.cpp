#include "tests/unit/planner_svc/temporal_pddl/random_choices.hpp"

#include <utility>
#include <vector>

#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl::testing {

namespace {

template <typename Node>
pddl::Condition condition(Node node) {
  pddl::Condition result;
  result.node = std::move(node);
  return result;
}

class Chooser {
 public:
  Chooser(std::mt19937_64& random, bool conditional) : random_(random), conditional_(conditional) {}

  void run(pddl::Domain& domain, pddl::Problem& problem) {
    facts_ = domain.predicates.size();
    for (const char* name : {"always", "never"}) domain.predicates.push_back({name, {}, {}});
    problem.facts.push_back({"always", {}, {}});
    for (auto& action : domain.actions) {
      widen(action.precondition);
      for (auto& effect : action.effects) depend(effect, {pddl::TimePoint::start});
    }
    for (auto& action : domain.durative_actions) {
      widen(action.condition.at_start);
      widen(action.condition.at_end);
      for (auto& effect : action.start_effects) depend(effect, {pddl::TimePoint::start});
      for (auto& effect : action.end_effects) depend(effect, {pddl::TimePoint::start, pddl::TimePoint::end});
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }

  pddl::Condition literal() {
    const std::size_t what = below(facts_ + 3);
    const std::string name = what < facts_        ? "p" + std::to_string(what)
                             : what == facts_ + 1 ? "always"
                                                  : "never";
    pddl::Condition atom = condition(pddl::Atom{name, {}, {}});
    return below(3) == 0 ? condition(pddl::Not{std::move(atom)}) : atom;
  }

  // One literal, or two and a way to join them.
  pddl::Condition small() {
    if (below(2) == 0) return literal();
    std::vector<pddl::Condition> parts{literal(), literal()};
    return below(2) == 0 ? condition(pddl::And{std::move(parts)}) : condition(pddl::Or{std::move(parts)});
  }

  void widen(pddl::Condition& asked) {
    if (below(3) == 0) return;
    std::vector<pddl::Condition> either{small(), small()};
    std::vector<pddl::Condition> both{std::move(asked), condition(pddl::Or{std::move(either)})};
    asked = condition(pddl::And{std::move(both)});
  }

  void depend(pddl::Effect& effect, const std::vector<pddl::TimePoint>& times) {
    if (!conditional_ || below(3) > 0) return;
    pddl::When when;
    pddl::TimedCondition& asked = when.condition;
    (times[below(times.size())] == pddl::TimePoint::start ? asked.at_start : asked.at_end) = small();
    when.effects.push_back(std::move(effect));
    effect.node = std::move(when);
  }

  std::mt19937_64& random_;
  bool conditional_;
  std::size_t facts_ = 0;
};

}  // namespace

Model random_choices_task(std::mt19937_64& random, bool conditional) {
  Model result = random_task(random);
  Chooser(random, conditional).run(result.domain, result.problem);
  for (const char* name : {":disjunctive-preconditions", ":conditional-effects"})
    result.domain.requirements.push_back({name, {}});
  return result;
}

}  // namespace roci::planner::temporal_pddl::testing
