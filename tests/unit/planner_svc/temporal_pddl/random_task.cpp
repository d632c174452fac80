#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl::testing {

namespace {

constexpr int kFacts = 5;

class Writer {
 public:
  Writer(std::mt19937_64& random, int shortest) : random_(random), shortest_(shortest) {}

  Model run() {
    std::string domain =
        "(:requirements :durative-actions :duration-inequalities :negative-preconditions :numeric-fluents "
        ":timed-initial-literals)\n(:predicates";
    for (int i = 0; i < kFacts; ++i) domain += " (p" + std::to_string(i) + ")";
    domain += ")\n(:functions (x))\n";
    const int actions = 2 + below(3);
    only_decreases_ = below(2) == 0;
    for (int i = 0; i < actions; ++i) domain += below(6) == 0 ? plain_action(i) : durative_action(i);
    return model(domain, problem());
  }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::string fact() { return "(p" + std::to_string(below(kFacts)) + ")"; }
  std::string literal() { return below(4) == 0 ? "(not " + fact() + ")" : fact(); }
  std::string condition() {
    if (below(6) > 0) return literal();
    return below(2) == 0 ? "(>= (x) " + std::to_string(below(3)) + ")"
                         : "(<= (x) " + std::to_string(below(3)) + ")";
  }
  std::string effect() {
    if (below(only_decreases_ ? 3 : 6) > 0) return below(3) == 0 ? "(not " + fact() + ")" : fact();
    if (only_decreases_) return "(decrease (x) " + std::to_string(1 + below(2)) + ")";
    const char* const ops[] = {"(increase (x) 1)", "(decrease (x) 1)", "(assign (x) 1)"};
    return ops[below(3)];
  }

  // Where x only falls, what takes of it mostly asks for it, so that it is a resource.
  std::string asked_for(const std::string& effect) {
    if (!only_decreases_ || !effect.starts_with("(decrease") || below(10) == 0) return "";
    return "(>= (x) " + std::to_string(below(3)) + ")";
  }

  std::string plain_action(int i) {
    const std::string does = effect();
    return "(:action a" + std::to_string(i) + " :parameters () :precondition (and " + condition() +
           asked_for(does) + ") :effect " + does + ")\n";
  }

  std::string durative_action(int i) {
    const int least = shortest_ + below(5 - shortest_);
    const std::string duration = below(3) == 0
                                     ? "(and (>= ?duration " + std::to_string(least) + ") (<= ?duration " +
                                           std::to_string(least + below(3)) + "))"
                                     : "(= ?duration " + std::to_string(least) + ")";
    std::string conditions, effects;
    const auto add = [&](std::string& list, const char* when, const std::string& what) {
      list += " (" + std::string(when) + " " + what + ")";
    };
    if (below(2) == 0) add(conditions, "at start", condition());
    if (below(2) == 0) add(conditions, "over all", condition());
    if (below(3) == 0) add(conditions, "at end", condition());
    if (below(3) == 0) {  // an envelope: something holds just while the action runs
      const std::string held = fact();
      add(effects, "at start", held);
      add(effects, "at end", "(not " + held + ")");
    }
    for (const char* when : {"at start", "at end"}) {
      if (when[3] == 's' && below(2) == 0) continue;
      const std::string does = effect();
      add(effects, when, does);
      if (const std::string asked = asked_for(does); !asked.empty()) add(conditions, when, asked);
    }
    return "(:durative-action a" + std::to_string(i) + " :parameters () :duration " + duration +
           " :condition (and" + conditions + ") :effect (and" + effects + "))\n";
  }

  std::string problem() {
    std::string init = "(:init (= (x) " + std::to_string(below(only_decreases_ ? 5 : 2)) + ")";
    for (int i = 0; i < kFacts; ++i) {
      if (below(4) == 0) init += " (p" + std::to_string(i) + ")";
    }
    int time = 0;
    for (int n = below(4); n > 0; --n) {
      time += 1 + below(4);
      init += " (at " + std::to_string(time) + " " + literal() + ")";
    }
    std::string goal = "(:goal (and " + fact() + " " + literal();
    if (below(5) == 0) goal += " (>= (x) 2)";
    return init + ")\n" + goal + "))";
  }

  std::mt19937_64& random_;
  int shortest_;
  bool only_decreases_ = false;  // x
};

}  // namespace

Model random_task(std::mt19937_64& random, int shortest) { return Writer(random, shortest).run(); }

}  // namespace roci::planner::temporal_pddl::testing
