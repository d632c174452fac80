// Random small cases, and what they look like as PDDL.
#include <algorithm>

#include "tests/unit/planner_svc/temporal_pddl/validate/oracle.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

class Generator {
 public:
  explicit Generator(std::mt19937_64& random) : random_(random) {}

  SmallCase make() {
    SmallCase small;
    for (int i = 1 + below(3); i > 0; --i) small.actions.push_back(action());
    small.initial = static_cast<FactSet>(below(1 << kFacts));
    for (int i = below(3); i > 0; --i) add_timed_fact(small);
    small.goal = clauses(40);
    for (int i = 1 + below(4); i > 0; --i) {
      const int which = below(static_cast<int>(small.actions.size()));
      const SmallAction& chosen = small.actions[which];
      const int slack = chance(10) ? 1 : 0;
      const int duration = chosen.least - slack + below(chosen.most - chosen.least + 1 + 2 * slack);
      small.plan.push_back({below(15), which, std::max(duration, 0)});
    }
    return small;
  }

 private:
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(random_); }
  bool chance(int percent) { return below(100) < percent; }
  FactSet one_fact() { return FactSet{1} << below(kFacts); }

  std::vector<Clause> clauses(int percent) {
    std::vector<Clause> all;
    while (chance(percent)) {
      Clause clause;
      for (int literals = 1 + below(2); literals > 0; --literals)
        (chance(60) ? clause.yes : clause.no) |= one_fact();
      all.push_back(clause);
    }
    return all;
  }

  SnapAction snap() {
    SnapAction snap;
    snap.conditions = clauses(30);
    snap.needs_number = chance(10);
    if (chance(50)) snap.adds = one_fact();
    if (chance(40)) snap.deletes = one_fact();
    if (chance(20)) {
      snap.trigger = one_fact();
      snap.triggered_adds = one_fact();
    }
    if (chance(15)) {
      snap.number = chance(70) ? NumberEffect::increase : NumberEffect::assign;
      snap.operand = below(5) - 2;
    }
    return snap;
  }

  SmallAction action() {
    SmallAction action;
    action.durative = chance(80);
    action.least = below(5);
    action.most = action.least + below(4);
    action.start = snap();
    action.over_all = clauses(25);
    action.end = snap();
    return action;
  }

  void add_timed_fact(SmallCase& small) {
    const SmallTimedFact fact = {below(15), below(kFacts), chance(50)};
    const bool taken = std::any_of(
        small.timed_facts.begin(), small.timed_facts.end(),
        [&](const SmallTimedFact& other) { return other.time == fact.time && other.fact == fact.fact; });
    if (!taken) small.timed_facts.push_back(fact);
  }

  std::mt19937_64& random_;
};

std::string milliseconds(int time) { return std::to_string(time) + "e-3"; }

std::string fact_text(int fact) { return "(f" + std::to_string(fact) + ")"; }

std::string all_facts(FactSet facts, const std::string& before, const std::string& after) {
  std::string text;
  for (int fact = 0; fact < kFacts; ++fact) {
    if ((facts >> fact & 1) != 0) text += " " + before + fact_text(fact) + after;
  }
  return text;
}

std::string clauses_text(const std::vector<Clause>& clauses) {
  std::string text = "(and";
  for (const Clause& clause : clauses) {
    text += " (or" + all_facts(clause.yes, "", "") + all_facts(clause.no, "(not ", ")") + ")";
  }
  return text + ")";
}

std::string conditions_text(const SnapAction& snap) {
  return "(and " + clauses_text(snap.conditions) + (snap.needs_number ? " (>= (x) 0))" : ")");
}

std::string effects_text(const SnapAction& snap) {
  std::string text = "(and" + all_facts(snap.adds, "", "") + all_facts(snap.deletes, "(not ", ")");
  if (snap.trigger != 0) {
    text += " (when (and" + all_facts(snap.trigger, "", "") + ") (and" +
            all_facts(snap.triggered_adds, "", "") + "))";
  }
  if (snap.number != NumberEffect::none) {
    text += snap.number == NumberEffect::assign ? " (assign (x) " : " (increase (x) ";
    text += std::to_string(snap.operand) + ")";
  }
  return text + ")";
}

std::string action_text(const SmallAction& action, int number) {
  const std::string head = "action a" + std::to_string(number) + " :parameters () ";
  if (!action.durative) {
    return "(:" + head + ":precondition " + conditions_text(action.start) + " :effect " +
           effects_text(action.start) + ")";
  }
  return "(:durative-" + head + ":duration (and (>= ?duration " + milliseconds(action.least) +
         ") (<= ?duration " + milliseconds(action.most) + ")) :condition (and (at start " +
         conditions_text(action.start) + ") (over all " + clauses_text(action.over_all) + ") (at end " +
         conditions_text(action.end) + ")) :effect (and (at start " + effects_text(action.start) +
         ") (at end " + effects_text(action.end) + ")))";
}

}  // namespace

SmallCase random_case(std::mt19937_64& random) { return Generator(random).make(); }

std::string domain_sections(const SmallCase& small) {
  const FactSet all = (FactSet{1} << kFacts) - 1;
  std::string text = "(:predicates" + all_facts(all, "", "") + ") (:functions (x))";
  // Never in a plan, but makes every fact one that might change.
  text += "(:action touch :effect (and" + all_facts(all, "", "") + " (increase (x) 1)))";
  for (std::size_t i = 0; i < small.actions.size(); ++i)
    text += action_text(small.actions[i], static_cast<int>(i));
  return text;
}

std::string problem_sections(const SmallCase& small) {
  std::string text = "(:init (= (x) 0)" + all_facts(small.initial, "", "");
  for (const SmallTimedFact& fact : small.timed_facts) {
    text += " (at " + milliseconds(fact.time) + (fact.value ? " " : " (not ") + fact_text(fact.fact) +
            (fact.value ? ")" : "))");
  }
  return text + ") (:goal " + clauses_text(small.goal) + ")";
}

std::string plan_text(const SmallCase& small) {
  std::string text;
  for (const SmallStep& step : small.plan) {
    text += milliseconds(step.start) + ": (a" + std::to_string(step.action) + ")";
    if (small.actions[step.action].durative) text += " [" + milliseconds(step.duration) + "]";
    text += "\n";
  }
  return text;
}

}  // namespace roci::planner::temporal_pddl::validate
