// The validator executes a plan, one moment after the other.
#pragma once

#include <list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/validate/effects.hpp"
#include "planner_svc/temporal_pddl/validate/interference.hpp"
#include "planner_svc/temporal_pddl/validate/steps.hpp"
#include "planner_svc/temporal_pddl/validate/validator.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Goes on after a violation as if what failed had held, so that one run reports them all. It holds
/// references to all that it is given.
class Execution {
 public:
  Execution(const Model& model, const std::vector<pddl::PlanStep>& plan, const std::vector<Step>& steps,
            const Options& options, std::vector<Violation>& violations);

  /// Executes all events of one moment; they see the state before it. `crowded` says that there are several
  /// or that other events are less than epsilon away: only then can anything interfere.
  void happen(std::span<const Event> events, bool crowded);
  void check_goal(pddl::Microseconds now);

  const State& state() const { return state_; }

 private:
  // Is a durative action between its start and its end.
  struct Running {
    std::size_t step;
    std::optional<double> duration;  // seconds, exact where a constraint fixes it
    std::vector<PendingEffect> end_effects;
    bool broken = false;  // its invariant was reported
  };
  struct Occurrence {
    Event event;
    Footprint footprint;
  };

  Occurrence execute(const Event& event, bool crowded);
  void execute_instant(const Event& event, Evaluator& evaluator, Changes& changes);
  void execute_start(const Event& event, Evaluator& evaluator, Changes& changes);
  void execute_end(const Event& event, Evaluator& evaluator, Changes& changes);
  void collect_effects(const Event& event, const std::vector<PendingEffect>& effects,
                       const Specials& specials, Evaluator& evaluator, Changes& changes);
  // Reports a duration that breaks a constraint of that time. Returns the exact duration where an `=` of that
  // time fixes it.
  std::optional<double> check_duration(const Event& event, pddl::TimePoint at, Evaluator& evaluator);
  void check_interference(const Occurrence& occurrence);
  void check_invariants(pddl::Microseconds now);
  // Says what a violation is one of, should a condition not hold.
  struct Occasion {
    ViolationKind kind;
    std::optional<std::size_t> step;
    pddl::Microseconds time;
    const char* when;  // "condition at start"
  };
  // Reports each part of a conjunction that does not hold. Returns whether all hold.
  bool require(const pddl::Condition& condition, const Bindings& bindings, Evaluator& evaluator,
               const Occasion& occasion);
  bool require_part(const pddl::Condition& condition, Bindings& bindings, Evaluator& evaluator,
                    const Occasion& occasion);

  Violation violation(ViolationKind kind, std::optional<std::size_t> step, pddl::Microseconds time) const;
  std::string name(const Event& event) const;

  const Model& model_;
  const std::vector<pddl::PlanStep>& plan_;
  const std::vector<Step>& steps_;
  const Options& options_;
  std::vector<Violation>& violations_;
  State state_;
  std::list<Running> running_;
  std::vector<Occurrence> recent_;  // less than epsilon ago
};

}  // namespace roci::planner::temporal_pddl::validate
