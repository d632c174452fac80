#include "planner_svc/temporal_pddl/grounding/goal_causes.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/fact_patterns.hpp"
#include "planner_svc/temporal_pddl/grounding/missing_values.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding {

using instantiation::GroundLiteral, instantiation::ImpossibleAction, instantiation::WindowMisfit;
using lifted::Argument, lifted::Binding, lifted::LiftedAction, lifted::LiftedEffect, lifted::LiftedFormula,
    lifted::objects_of;
using simplification::literal_index;
using task::ObjectId, task::PredicateId;

namespace {

constexpr std::size_t kMostCauses = 3;      // that are told
constexpr std::size_t kMostPatterns = 200;  // that are looked at

void collect_lifted_parts(const LiftedFormula& formula, std::vector<const LiftedFormula*>& parts) {
  if (formula.kind != LiftedFormula::Kind::conjunction) return parts.push_back(&formula);
  for (const LiftedFormula& part : formula.parts) collect_lifted_parts(part, parts);
}

class Diagnosis {
 public:
  explicit Diagnosis(const UnreachableGoal& known) : known_(known), patterns_(known) {}

  std::vector<std::string> causes() {
    want_goal();
    for (std::size_t i = 0; i < wanted_.size() && i < kMostPatterns && causes_.size() < kMostCauses; ++i) {
      const Wanted next = wanted_[i];
      explain(next);
    }
    return std::move(causes_);
  }

 private:
  struct Wanted {
    Pattern pattern;
    std::string by;  // "the goal", "(drive r ?)"
  };

  void want_goal() {
    std::vector<const pddl::Condition*> parts;
    collect_parts(known_.problem.goal, parts);
    for (const pddl::Condition* part : parts) {
      const auto* negation = std::get_if<pddl::Not>(&part->node);
      const auto* atom = std::get_if<pddl::Atom>(&(negation ? *negation->body : *part).node);
      if (atom == nullptr) continue;
      Pattern pattern{known_.symbols.predicate(atom->symbol), {}};
      for (const pddl::Term& term : atom->arguments)
        pattern.objects.push_back(known_.symbols.object(term.name));
      pattern.negated = negation != nullptr;
      want(std::move(pattern), "the goal");
    }
    for (const auto& alternative : known_.goal) {
      for (const GroundLiteral literal : alternative.literals) {
        if (!known_.reached[literal_index(literal)]) want(patterns_.of(literal), "the goal");
      }
    }
  }

  // Returns whether it is out of reach; then it is to be explained.
  bool want(Pattern pattern, const std::string& by) {
    if (patterns_.within_reach(pattern) || patterns_.comes_with_time(pattern)) return false;
    if (seen_.insert(pattern).second) wanted_.push_back({std::move(pattern), by});
    return true;
  }

  void explain(const Wanted& wanted) {
    if (wanted.pattern.negated) {
      return tell(wanted.by + " needs " + patterns_.text(wanted.pattern) +
                  ", but it is in :init and no effect deletes it");
    }
    for (const ImpossibleAction& note : known_.model.impossible_actions) {
      if (patterns_.any_fits(note.adds, wanted.pattern)) return tell(why(note));
    }
    for (const WindowMisfit& note : known_.model.window_misfits) {
      if (patterns_.any_fits(note.adds, wanted.pattern)) return;  // told at the end, see window_too_short()
    }
    bool any = false;
    for (const LiftedAction& action : known_.actions) {
      for (const auto* effects : {&action.start_effects, &action.end_effects}) {
        for (const LiftedEffect& effect : *effects) {
          Binding binding(action.slots);
          if (effect.kind != LiftedEffect::Kind::add || !unify(effect, action, wanted.pattern, binding))
            continue;
          any = true;
          explain(action, effect, binding);
        }
      }
    }
    if (!any) {
      tell(wanted.by + " needs " + patterns_.text(wanted.pattern) +
           ", which is never true: it is not in :init, and no effect adds it");
    }
  }

  static bool unify(const LiftedEffect& effect, const LiftedAction& action, const Pattern& pattern,
                    Binding& binding) {
    if (effect.atom.predicate != pattern.predicate) return false;
    for (std::size_t i = 0; i < pattern.objects.size(); ++i) {
      const ObjectId object = pattern.objects[i];
      const Argument argument = effect.atom.arguments[i];
      if (object.is_none()) continue;
      const ObjectId known = resolve(argument, binding);
      if (!known.is_none() && known != object) return false;
      if (!argument.is_slot) continue;
      if (argument.index < action.parameters.size() &&
          !std::ranges::binary_search(action.parameters[argument.index], object))
        return false;
      binding[argument.index] = object;
    }
    return true;
  }

  // Looks for the conditions of the action that nothing meets.
  void explain(const LiftedAction& action, const LiftedEffect& effect, const Binding& binding) {
    const std::string name = text(action, binding);
    std::vector<const LiftedFormula*> parts;
    for (const auto* condition :
         {&action.at_start, &action.over_all, &action.at_end, &effect.start_condition, &effect.end_condition})
      collect_lifted_parts(*condition, parts);
    bool blocked = false, has_windows = false;
    for (const LiftedFormula* part : parts) {
      const bool positive = part->kind == LiftedFormula::Kind::atom;
      if (!positive && part->kind != LiftedFormula::Kind::not_atom) continue;
      if (changes_at_start(action, part->atom.predicate)) continue;
      const auto objects = objects_of(part->atom.arguments, binding);
      Pattern pattern{part->atom.predicate, {objects.begin(), objects.end()}, !positive};
      has_windows = has_windows || patterns_.comes_with_time(pattern);
      blocked = want(std::move(pattern), name) || blocked;
    }
    for (const std::string& lack : MissingValues(known_).of(action, parts, binding, name)) {
      tell(lack);
      blocked = true;
    }
    if (!blocked && !action.layer && !has_instance(action, binding))
      tell("no choice of objects meets all conditions of " + name + " at once" +
           (action.durative ? ", those on its duration included" : "") +
           (has_windows ? ", while timed literals let it run" : ""));
  }

  static bool changes_at_start(const LiftedAction& action, PredicateId predicate) {
    return std::ranges::any_of(action.start_effects, [&](const LiftedEffect& effect) {
      return effect.kind != LiftedEffect::Kind::numeric && effect.atom.predicate == predicate;
    });
  }

  bool has_instance(const LiftedAction& action, const Binding& binding) const {
    return std::ranges::any_of(known_.model.actions, [&](const instantiation::GroundAction& ground) {
      if (&known_.actions[ground.schema.index()] != &action) return false;
      for (std::size_t i = 0; i < ground.arguments.size(); ++i)
        if (!binding[i].is_none() && binding[i] != ground.arguments[i]) return false;
      return true;
    });
  }

  std::string why(const ImpossibleAction& note) const {
    const std::string name = patterns_.text(known_.actions[note.schema.index()].name, note.arguments);
    if (note.broken) {
      return name + " can never run: its start makes its own condition over all false, " +
             patterns_.text(patterns_.of(*note.broken));
    }
    return name + " can never run: it takes at most " + in_seconds(note.longest) +
           ", but its start and its end change or read the same, so they are at least ε = " +
           in_seconds(known_.epsilon) + " apart";
  }

  std::string text(const LiftedAction& action, const Binding& binding) const {
    return patterns_.text(action.name, std::span(binding).first(action.parameters.size()));
  }

  void tell(const std::string& cause) {
    if (causes_.size() < kMostCauses && std::ranges::find(causes_, cause) == causes_.end())
      causes_.push_back(cause);
  }

  const UnreachableGoal& known_;
  Patterns patterns_;
  std::vector<Wanted> wanted_;
  std::set<Pattern> seen_;
  std::vector<std::string> causes_;
};

}  // namespace

void collect_parts(const pddl::Condition& condition, std::vector<const pddl::Condition*>& parts) {
  const auto* conjunction = std::get_if<pddl::And>(&condition.node);
  if (conjunction == nullptr) return parts.push_back(&condition);
  for (const pddl::Condition& part : conjunction->parts) collect_parts(part, parts);
}

std::vector<std::string> causes_of(const UnreachableGoal& unreachable) {
  return Diagnosis(unreachable).causes();
}

}  // namespace roci::planner::temporal_pddl::grounding
