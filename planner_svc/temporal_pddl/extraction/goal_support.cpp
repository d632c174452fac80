#include "planner_svc/temporal_pddl/extraction/goal_support.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "planner_svc/temporal_pddl/task/semantics.hpp"

namespace roci::planner::temporal_pddl::extraction {

using call::NamedGoal;
using search::PlanPrefix;
using task::FactId, task::LinearExpression, task::NumericCondition, task::NumericEffect, task::Semantics,
    task::SnapId, task::SnapKind, task::Task, task::Word;

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

// Something comes about by an action, and is used.
struct Use {
  std::size_t step = 0;  // start of the action that uses it
  bool undoes = false;
};
struct Effect {
  std::size_t step = 0;  // start of the action that brings it about
  std::vector<Use> uses{};
  std::vector<std::size_t> goals{};
};

// A fact that the plan or a goal asks for, as the plan goes on.
struct WatchedFact {
  FactId fact;
  bool holds = false;
  std::size_t effect = kNone;        // that brought it about; none: it held from the beginning
  std::size_t taken_by = kNone;      // step of the action that made it false
  std::size_t effect_taken = kNone;  // `effect` as it was then
};

struct Contribution {
  std::size_t effect = 0;
  bool raises = false;
};

class GoalSupport {
 public:
  GoalSupport(const Task& task, const PlanPrefix& plan, std::span<const NamedGoal> goals)
      : task_(task),
        semantics_(task),
        plan_(plan),
        goals_(goals),
        state_(task.initial_state),
        before_start_(plan.steps.size()),
        contributions_(task.number_names.size()) {}

  std::vector<std::vector<std::size_t>> run() {
    watch();
    for (std::size_t step = 0; step < plan_.steps.size(); ++step) take(step);
    use_for_goals();
    return served();
  }

 private:
  void watch(FactId fact) {
    if (watched_.emplace(fact, facts_.size()).second)
      facts_.push_back({fact, task_.layout.holds(state_, fact)});
  }

  void watch() {
    for (const SnapId snap : plan_.steps) {
      for (const FactId fact : task_.conditions[snap]) watch(fact);
      if (task_.snaps[snap].kind != SnapKind::start) continue;
      for (const FactId fact : task_.invariants[task_.snaps[snap].action]) watch(fact);
    }
    std::map<std::string, FactId> by_name;
    for (const task::Goal& goal : task_.goals)
      for (const FactId fact : goal.facts) by_name.emplace(name(task_, fact), fact);
    for (const NamedGoal& goal : goals_) {
      facts_of_.emplace_back();
      for (const std::string& fact : goal.facts) {
        const auto found = by_name.find(fact);
        if (found == by_name.end()) continue;  // it never changes
        watch(found->second);
        facts_of_.back().push_back(watched_.at(found->second));
      }
    }
  }

  void take(std::size_t step) {
    const SnapId snap = plan_.steps[step];
    const SnapKind kind = task_.snaps[snap].kind;
    const std::size_t start = kind == SnapKind::timed_literal ? kNone : plan_.start_of[step];
    if (start != kNone) {
      use(task_.conditions[snap], start);
      use(task_.comparisons[snap], start);
    }
    apply(step, start);
    if (kind == SnapKind::start) {
      use(task_.invariants[task_.snaps[snap].action], start);
      use(task_.numeric_invariants[task_.snaps[snap].action], start);
    } else if (start != kNone) {
      note_undone(start);
    }
  }

  void use(std::span<const FactId> facts, std::size_t start) {
    for (const FactId fact : facts) {
      const std::size_t effect = facts_[watched_.at(fact)].effect;
      if (effect == kNone || effects_[effect].step == start) continue;
      effects_[effect].uses.push_back({start});
      open_uses_.push_back({start, watched_.at(fact), effect, effects_[effect].uses.size() - 1});
    }
  }

  void use(std::span<const NumericCondition> conditions, std::size_t start) {
    for (const NumericCondition& condition : conditions) {
      for (const LinearExpression::Term& term : task_.expressions[condition.expression].terms) {
        for (const Contribution& made : contributions_[term.variable.index()]) {
          const bool helps =
              condition.comparator == task::Comparator::equal || made.raises == (term.weight > 0);
          if (helps && effects_[made.effect].step != start) effects_[made.effect].uses.push_back({start});
        }
      }
    }
  }

  void apply(std::size_t step, std::size_t start) {
    const SnapId snap = plan_.steps[step];
    const std::vector<Word> before = state_;
    semantics_.apply(snap, seconds(step, start), state_);
    if (start != kNone) note_numbers(snap, start, before);
    for (WatchedFact& watched : facts_) {
      const bool holds = task_.layout.holds(state_, watched.fact);
      if (holds == std::exchange(watched.holds, holds)) continue;
      if (!holds) {
        watched.taken_by = start;
        watched.effect_taken = watched.effect;
      } else if (start == kNone) {
        watched.effect = kNone;
      } else if (watched.taken_by == start) {
        watched.effect = watched.effect_taken;
      } else {
        watched.effect = effects_.size();
        effects_.push_back({start});
      }
    }
  }

  double seconds(std::size_t step, std::size_t start) {
    if (start == kNone) return 0;
    if (start == step) before_start_[start] = state_;
    const auto before_end = start == step ? std::nullopt : std::optional<task::StateView>(state_);
    const auto bounds =
        semantics_.duration(task_.snaps[plan_.steps[step]].action, before_start_[start], before_end);
    return bounds ? bounds->seconds : 0;
  }

  void note_numbers(SnapId snap, std::size_t start, const std::vector<Word>& before) {
    for (const NumericEffect& effect : task_.numeric_effects[snap]) {
      const double now = task_.layout.numbers(state_)[effect.variable];
      const double then = task_.layout.numbers(before)[effect.variable];
      if (now == then) continue;
      contributions_[effect.variable.index()].push_back({effects_.size(), now > then});
      effects_.push_back({start});
    }
  }

  // The action is over: which of the facts that it used it has made false for good.
  void note_undone(std::size_t start) {
    for (const OpenUse& open : open_uses_) {
      const WatchedFact& watched = facts_[open.watched];
      if (open.step == start && !watched.holds && watched.taken_by == start)
        effects_[open.effect].uses[open.use].undoes = true;
    }
    std::erase_if(open_uses_, [start](const OpenUse& open) { return open.step == start; });
  }

  void use_for_goals() {
    for (std::size_t goal = 0; goal < goals_.size(); ++goal)
      for (const std::size_t watched : facts_of_[goal])
        if (facts_[watched].effect != kNone) effects_[facts_[watched].effect].goals.push_back(goal);
  }

  // Uses lead forward in time but for actions that need each other while both run, hence until nothing
  // changes.
  std::vector<std::vector<std::size_t>> served() const {
    std::vector<std::vector<bool>> serves(plan_.steps.size(), std::vector<bool>(goals_.size(), false));
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = effects_.size(); i-- > 0;) {
        const Effect& effect = effects_[i];
        const auto add = [&](std::size_t goal) {
          changed |= !serves[effect.step][goal];
          serves[effect.step][goal] = true;
        };
        for (const std::size_t goal : effect.goals) add(goal);
        const bool kept = !effect.goals.empty() ||
                          !std::ranges::all_of(effect.uses, [](const Use& use) { return use.undoes; });
        for (const Use& use : effect.uses) {
          if (kept && use.undoes) continue;
          for (std::size_t goal = 0; goal < goals_.size(); ++goal)
            if (serves[use.step][goal]) add(goal);
        }
      }
    }
    std::vector<std::vector<std::size_t>> out(plan_.steps.size());
    for (std::size_t step = 0; step < out.size(); ++step)
      for (std::size_t goal = 0; goal < goals_.size(); ++goal)
        if (serves[step][goal]) out[step].push_back(goal);
    return out;
  }

  struct OpenUse {
    std::size_t step = 0;
    std::size_t watched = 0;
    std::size_t effect = 0;
    std::size_t use = 0;
  };

  const Task& task_;
  Semantics semantics_;
  const PlanPrefix& plan_;
  std::span<const NamedGoal> goals_;
  std::vector<Word> state_;
  std::vector<std::vector<Word>> before_start_;  // by step of a start
  std::map<FactId, std::size_t> watched_;        // index in facts_
  std::vector<WatchedFact> facts_;
  std::vector<std::vector<std::size_t>> facts_of_;        // by goal: indices in facts_
  std::vector<std::vector<Contribution>> contributions_;  // by number
  std::vector<Effect> effects_;
  std::vector<OpenUse> open_uses_;  // of actions that run
};

}  // namespace

std::vector<std::vector<std::size_t>> goals_served(const Task& task, const PlanPrefix& plan,
                                                   std::span<const NamedGoal> goals) {
  return GoalSupport(task, plan, goals).run();
}

}  // namespace roci::planner::temporal_pddl::extraction
