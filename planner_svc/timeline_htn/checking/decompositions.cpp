#include <algorithm>
#include <cmath>
#include <functional>

#include "planner_svc/timeline_htn/checking/parts.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"

namespace roci::planner::timeline_htn::checking {

using model::Behaviour, model::StateKind;

namespace {

/// Finds all ways in which one activity is one behaviour's.
class Matching {
 public:
  Matching(const Version& version, Index part, Index behaviour)
      : version_(version),
        part_(version.parts[part]),
        index_(behaviour),
        behaviour_(version.model.behaviours[behaviour]),
        used_(part_.parts.size(), false),
        beside_(behaviour_.subgoals.size(), false) {
    way_.behaviour = behaviour;
    way_.part_of.assign(behaviour_.subgoals.size(), kNone);
    for (const model::Decision& decision : behaviour_.decisions)
      for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
        for (const Index subgoal : decision.choices[choice].subgoals) beside_[subgoal] = true;
  }

  void run(Binding binding) { subgoal(0, std::move(binding)); }

  const std::vector<Decomposition>& found() const { return found_; }
  /// Says why there is none, of the try that came farthest.
  const std::string& why_not() const { return why_not_; }
  std::size_t farthest() const { return farthest_; }

 private:
  StateKind kind(Index subgoal) const {
    const model::Pattern& pattern = behaviour_.subgoals[subgoal].state;
    return version_.model.components[pattern.component].states[pattern.state].kind;
  }
  std::string in_words(Index subgoal) const {
    return "'" + behaviour_.subgoals[subgoal].name + "', " +
           to_text(version_.model, behaviour_.subgoals[subgoal].state, behaviour_.variables);
  }
  void fail(std::size_t reached, const std::string& why) {
    if (!why_not_.empty() && reached <= farthest_) return;
    farthest_ = reached;
    why_not_ = "behaviour '" + behaviour_.name + "': " + why;
  }

  void subgoal(Index next, Binding binding) {
    if (tries_++ > kMostTries) return fail(next, "too many ways to look at; name its parts apart");
    if (next == behaviour_.subgoals.size()) return variables(0, std::move(binding));
    bool any = false;
    for (std::size_t i = 0; i < part_.parts.size(); ++i) {
      const Part& child = version_.parts[part_.parts[i]];
      Binding with = binding;
      if (used_[i] || !child.state || child.aside != beside_[next] ||
          !unify(behaviour_.subgoals[next].state, *child.state, with))
        continue;
      any = used_[i] = true;
      way_.part_of[next] = part_.parts[i];
      subgoal(next + 1, std::move(with));
      way_.part_of[next] = kNone;
      used_[i] = false;
    }
    if (any) return;
    if (kind(next) == StateKind::resting) return subgoal(next + 1, std::move(binding));
    fail(next, "its subgoal " + in_words(next) + " is not among the parts of the activity");
  }

  // Variables that no part binds stand for any object.
  void variables(Index next, Binding binding) {
    if (tries_++ > kMostTries) return;
    if (next == binding.size()) return whole(binding);
    if (binding[next] != kNone) return variables(next + 1, std::move(binding));
    for (Index object = 0; object < version_.model.objects.size(); ++object) {
      if (version_.model.objects[object].type != behaviour_.variables[next].type) continue;
      binding[next] = object;
      variables(next + 1, binding);
    }
  }

  void whole(const Binding& binding) {
    const std::size_t reached = behaviour_.subgoals.size() + 1;
    for (std::size_t i = 0; i < behaviour_.where.size(); ++i)
      if (!holds(version_.model, behaviour_.where[i], binding))
        return fail(reached, "the " + std::to_string(i + 1) + ". of its tests ('where') does not hold for " +
                                 objects(binding));
    for (std::size_t i = 0; i < part_.parts.size(); ++i) {
      const Part& child = version_.parts[part_.parts[i]];
      if (!used_[i] && !child.value &&
          (!child.state || version_.definition(*child.state).kind != StateKind::simple))
        return fail(reached + 1,
                    version_.text(child) + " is none of its subgoals, and no step on the way to one");
    }
    if (const std::string wrong = constraint_fault(binding); !wrong.empty()) return fail(reached + 2, wrong);
    way_.binding = binding;
    found_.push_back(way_);
  }

  std::string objects(const Binding& binding) const {
    std::string out;
    for (std::size_t i = 0; i < binding.size(); ++i)
      out += (i == 0 ? "" : ", ") + behaviour_.variables[i].name + " = " +
             version_.model.objects[binding[i]].name;
    return out;
  }

  // The first constraint between points of activities that the network does not imply; empty if there is none.
  std::string constraint_fault(const Binding& binding) const {
    const auto no_later = [&](TimePoint a, TimePoint b) {
      return version_.network.implies(a, b, Duration{0}, temporal::no_bound);
    };
    for (Index i = 0; i < way_.part_of.size(); ++i) {
      if (way_.part_of[i] == kNone) continue;
      const Part& child = version_.parts[way_.part_of[i]];
      if (!no_later(part_.start(), child.start()) || !no_later(child.end(), part_.end()))
        return "its subgoal " + in_words(i) + " may lie outside of the activity";
    }
    for (std::size_t i = 0; i < behaviour_.constraints.size(); ++i) {
      const model::SubgoalConstraint& constraint = behaviour_.constraints[i];
      const auto from = point(constraint.from), to = point(constraint.to);
      if (!from || !to) continue;  // schedules tell
      const auto range = bounds_of_constraint(version_.model, constraint, binding);
      if (!range || !version_.network.implies(*from, *to, range->lower, range->upper))
        return "the network does not imply its " + std::to_string(i + 1) + ". constraint, between " +
               in_words(constraint.from) + " and " + in_words(constraint.to);
    }
    return {};
  }

  std::optional<TimePoint> point(const model::Point& one) const {
    if (one.subgoal && way_.part_of[*one.subgoal] == kNone) return std::nullopt;
    const Part& part = one.subgoal ? version_.parts[way_.part_of[*one.subgoal]] : part_;
    return one.end ? part.end() : part.start();
  }
  std::string in_words(const model::Point& one) const {
    return (one.subgoal ? behaviour_.subgoals[*one.subgoal].name : std::string("self")) +
           (one.end ? ".end" : ".start");
  }

  static constexpr std::size_t kMostTries = 100'000;

  const Version& version_;
  const Part& part_;
  Index index_;
  const Behaviour& behaviour_;
  std::vector<bool> used_, beside_;
  Decomposition way_;
  std::vector<Decomposition> found_;
  std::string why_not_;
  std::size_t farthest_ = 0;
  std::size_t tries_ = 0;
};

// The bindings that a behaviour begins with: of the state that it achieves, or of what triggers it.
std::vector<Binding> beginnings(const Version& version, const Part& part, const Behaviour& behaviour) {
  std::vector<Binding> out;
  const auto add = [&](const model::Pattern* pattern, const GroundState* state) {
    Binding binding(behaviour.variables.size(), kNone);
    if (pattern == nullptr || unify(*pattern, *state, binding)) out.push_back(std::move(binding));
  };
  if (part.state) {
    if (behaviour.achieves) add(&*behaviour.achieves, &*part.state);
    return out;
  }
  for (const model::Pattern& trigger : behaviour.triggers)
    if (!version.timelines[trigger.component].empty())
      add(&trigger, &version.timelines[trigger.component].front().state);
  if (behaviour.on_goal_change && version.model.problem->goals_changed) add(nullptr, nullptr);
  return out;
}

}  // namespace

std::optional<temporal::Window> bounds_of_constraint(const model::Model& model,
                                                     const model::SubgoalConstraint& constraint,
                                                     const Binding& binding) {
  temporal::Window out;
  const auto read = [&](const model::Expression& expression, Duration& bound) {
    if (expression.empty()) return true;
    const auto number = evaluate(model, expression, binding);
    if (!number || std::abs(*number) > temporal::to_seconds(model::kLongestDuration)) return false;
    bound = temporal::seconds(*number);
    return true;
  };
  if (!read(constraint.lower, out.lower) || !read(constraint.upper, out.upper)) return std::nullopt;
  return out;
}

Decompositions decompose(const Version& version, Faults& out) {
  Decompositions all(version.parts.size());
  for (Index i = 0; i < version.parts.size(); ++i) {
    const Part& part = version.parts[i];
    const bool complex = part.state && version.definition(*part.state).kind == StateKind::complex;
    if (part.state && !complex) {
      if (!part.parts.empty()) out.push_back(version.text(part) + " is no complex state, and has parts");
      continue;
    }
    std::string why_not = part.state ? "no behaviour achieves it" : "nothing triggers it";
    std::size_t farthest = 0;
    for (Index b = 0; b < version.model.behaviours.size(); ++b) {
      if (!part.state && b != part.behaviour) continue;
      Matching matching(version, i, b);
      for (Binding& binding : beginnings(version, part, version.model.behaviours[b]))
        matching.run(std::move(binding));
      all[i].insert(all[i].end(), matching.found().begin(), matching.found().end());
      if (!matching.why_not().empty() && matching.farthest() >= farthest) {
        farthest = matching.farthest();
        why_not = matching.why_not();
      }
    }
    if (all[i].empty()) out.push_back(version.text(part) + " is decomposed by no behaviour; " + why_not);
  }
  return all;
}

void check_triggers(const Version& version, const Decompositions& decompositions, Faults& out) {
  const model::Model& model = version.model;
  const auto begun_by = [&](const auto& triggered) {
    for (const auto& ways : decompositions)
      for (const Decomposition& way : ways)
        if (triggered(model.behaviours[way.behaviour])) return true;
    return false;
  };
  const auto fulfils_tests = [&](const Behaviour& behaviour, Binding binding) {
    return std::ranges::all_of(behaviour.where, [&](const model::Test& test) {
      const auto bound = [&](const model::Term& term) { return term.object || binding[term.index] != kNone; };
      return test.kind == model::Test::Kind::numbers || !std::ranges::all_of(test.terms, bound) ||
             holds(model, test, binding);
    });
  };
  for (const std::vector<Value>& timeline : version.timelines) {
    if (timeline.empty()) continue;
    const auto triggered = [&](const Behaviour& behaviour) {
      return std::ranges::any_of(behaviour.triggers, [&](const model::Pattern& trigger) {
        Binding binding(behaviour.variables.size(), kNone);
        return unify(trigger, timeline.front().state, binding) && fulfils_tests(behaviour, binding);
      });
    };
    if (std::ranges::any_of(model.behaviours, triggered) && !begun_by(triggered))
      out.push_back("the plan begins in " + version.text(timeline.front().state) +
                    ", and none of the behaviours that this triggers is in it");
  }
  const auto changed = [&](const Behaviour& behaviour) { return behaviour.on_goal_change; };
  if (model.problem->goals_changed && std::ranges::any_of(model.behaviours, changed) && !begun_by(changed))
    out.push_back("the goals have changed, and none of the behaviours that this triggers is in the plan");
}

}  // namespace roci::planner::timeline_htn::checking
