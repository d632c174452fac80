#include "planner_svc/temporal_pddl/grounding/unreachable_goal.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding {

using call::BlockedFact, call::PlanningFailure;
using instantiation::GroundLiteral, instantiation::GroundModel, instantiation::ImpossibleAction,
    instantiation::WindowMisfit;
using lifted::Argument, lifted::Binding, lifted::LiftedAction, lifted::LiftedEffect, lifted::LiftedExpression,
    lifted::LiftedFormula;
using simplification::literal_index;
using task::FunctionId, task::NumberId, task::ObjectId, task::PredicateId;
using temporal::Duration, temporal::Verdict;

namespace {

constexpr std::size_t kMostCauses = 3;      // that are told
constexpr std::size_t kMostPatterns = 200;  // that are looked at

std::string seconds(Duration duration) {
  const std::string text = std::to_string(std::chrono::duration<double>(duration).count());
  return (text.ends_with("000") ? text.substr(0, text.size() - 3) : text) + " s";
}

// The parts of a conjunction, those of conjunctions in it among them.
void collect_parts(const pddl::Condition& condition, std::vector<const pddl::Condition*>& parts) {
  const auto* conjunction = std::get_if<pddl::And>(&condition.node);
  if (conjunction == nullptr) return parts.push_back(&condition);
  for (const pddl::Condition& part : conjunction->parts) collect_parts(part, parts);
}

void collect_parts(const LiftedFormula& formula, std::vector<const LiftedFormula*>& parts) {
  if (formula.kind != LiftedFormula::Kind::conjunction) return parts.push_back(&formula);
  for (const LiftedFormula& part : formula.parts) collect_parts(part, parts);
}

// Is an atom, or its negation, some of whose objects do not matter (none).
struct Pattern {
  PredicateId predicate;
  std::vector<ObjectId> objects;
  bool negated = false;
  auto operator<=>(const Pattern&) const = default;

  bool fits(std::span<const ObjectId> given) const {
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (!objects[i].is_none() && objects[i] != given[i]) return false;
    return true;
  }
  bool is_ground() const {
    return std::ranges::none_of(objects, [](ObjectId object) { return object.is_none(); });
  }
};

class Diagnosis {
 public:
  explicit Diagnosis(const UnreachableGoal& known)
      : known_(known), model_(known.model), static_model_(known.static_model), symbols_(known.symbols) {}

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
      Pattern pattern{symbols_.predicate(atom->symbol), {}};
      for (const pddl::Term& term : atom->arguments) pattern.objects.push_back(symbols_.object(term.name));
      pattern.negated = negation != nullptr;
      want(std::move(pattern), "the goal");
    }
    for (const auto& alternative : known_.goal) {
      for (const GroundLiteral literal : alternative.literals) {
        if (!known_.reached[literal_index(literal)]) want(pattern_of(literal), "the goal");
      }
    }
  }

  Pattern pattern_of(GroundLiteral literal) const {
    const auto objects = model_.atoms.objects(literal.atom);
    return {PredicateId(std::size_t{model_.atoms.symbol(literal.atom)}),
            {objects.begin(), objects.end()},
            literal.negated};
  }

  // Returns whether it is out of reach; then it is to be explained.
  bool want(Pattern pattern, const std::string& by) {
    if (within_reach(pattern)) return false;
    if (seen_.insert(pattern).second) wanted_.push_back({std::move(pattern), by});
    return true;
  }

  bool within_reach(const Pattern& pattern) const {
    if (pattern.negated) {
      if (!pattern.is_ground()) return true;
      const auto atom = model_.atoms.find(pattern.predicate.value, pattern.objects);
      if (static_model_.is_static(pattern.predicate))
        return !static_model_.holds_initially(pattern.predicate, pattern.objects);
      return !atom || known_.reached[literal_index({*atom, true})];
    }
    const auto& initial = static_model_.initial_atoms();
    for (std::uint32_t i = 0; i < initial.size(); ++i) {
      if (initial.symbol(i) == pattern.predicate.value && pattern.fits(initial.objects(i))) return true;
    }
    for (std::uint32_t i = 0; i < model_.atoms.size(); ++i) {
      if (model_.atoms.symbol(i) == pattern.predicate.value && pattern.fits(model_.atoms.objects(i)) &&
          known_.reached[literal_index({i, false})])
        return true;
    }
    return false;
  }

  void explain(const Wanted& wanted) {
    if (wanted.pattern.negated) {
      return tell(wanted.by + " needs " + text(wanted.pattern) +
                  ", but it is in :init and no effect deletes it");
    }
    for (const ImpossibleAction& note : model_.impossible_actions) {
      if (brings(note.adds, wanted.pattern)) return tell(why(note));
    }
    for (const WindowMisfit& note : model_.window_misfits) {
      if (brings(note.adds, wanted.pattern)) return;  // told at the end, see window_too_short()
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
      tell(wanted.by + " needs " + text(wanted.pattern) +
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
      collect_parts(*condition, parts);
    bool blocked = false;
    for (const LiftedFormula* part : parts) {
      if (part->kind == LiftedFormula::Kind::comparison) {
        for (const LiftedExpression& side : part->sides)
          blocked = lacks_value(side, name, binding) || blocked;
      }
      const bool positive = part->kind == LiftedFormula::Kind::atom;
      if (!positive && part->kind != LiftedFormula::Kind::not_atom) continue;
      if (changes_at_start(action, part->atom.predicate)) continue;
      blocked =
          want({part->atom.predicate, objects_of(part->atom.arguments, binding), !positive}, name) || blocked;
    }
    for (const auto& rule : action.duration) blocked = lacks_value(rule.bound, name, binding) || blocked;
    for (const auto* effects : {&action.start_effects, &action.end_effects}) {
      for (const LiftedEffect& other : *effects) {
        if (other.kind != LiftedEffect::Kind::numeric || other.conditional()) continue;
        blocked = lacks_value(other.value, name, binding) || blocked;
        if (other.op != pddl::AssignmentOperator::assign)
          blocked = lacks_value(other.function, other.atom.arguments, name, binding) || blocked;
      }
    }
    if (!blocked && !action.layer && !has_instance(action, binding))
      tell("no choice of objects meets all conditions of " + name + " at once");
  }

  static bool changes_at_start(const LiftedAction& action, PredicateId predicate) {
    return std::ranges::any_of(action.start_effects, [&](const LiftedEffect& effect) {
      return effect.kind != LiftedEffect::Kind::numeric && effect.atom.predicate == predicate;
    });
  }

  bool has_instance(const LiftedAction& action, const Binding& binding) const {
    return std::ranges::any_of(model_.actions, [&](const instantiation::GroundAction& ground) {
      if (&known_.actions[ground.schema.index()] != &action) return false;
      for (std::size_t i = 0; i < ground.arguments.size(); ++i)
        if (!binding[i].is_none() && binding[i] != ground.arguments[i]) return false;
      return true;
    });
  }

  bool lacks_value(const LiftedExpression& expression, const std::string& by, const Binding& binding) {
    bool lacks = false;
    if (expression.kind == LiftedExpression::Kind::function)
      lacks = lacks_value(expression.function, expression.arguments, by, binding);
    for (const LiftedExpression& operand : expression.operands)
      lacks = lacks_value(operand, by, binding) || lacks;
    return lacks;
  }

  bool lacks_value(FunctionId function, const std::vector<Argument>& arguments, const std::string& by,
                   const Binding& binding) {
    const Pattern pattern{PredicateId(), objects_of(arguments, binding)};
    const std::string fluent = text(symbols_[function].name, pattern.objects);
    const std::string told = by + " reads " + fluent + ", which has no value: ";
    const std::string remedy = "give it one in :init, (= " + fluent + " …)";
    if (static_model_.constants().is_constant(function)) {
      if (!pattern.is_ground() || static_model_.constants().value(function, pattern.objects)) return false;
      tell(symbols_[function].module.empty() ? told + remedy
                                             : by + " reads " + fluent + ", which is unreachable");
      return true;
    }
    bool assigned = false;
    for (std::uint32_t i = 0; i < model_.numbers.size(); ++i) {
      if (model_.numbers.symbol(i) != function.value || !pattern.fits(model_.numbers.objects(i))) continue;
      assigned = assigned || !std::isnan(model_.initial_numbers[i]) || is_assigned(i);
    }
    if (assigned) return false;
    tell(told + remedy);
    return true;
  }

  // The atom that says that the number has a value was made by simplification/defined_numbers.
  bool is_assigned(std::uint32_t number) const {
    const std::string name =
        "has-value:" + symbols_[FunctionId(std::size_t{model_.numbers.symbol(number)})].name;
    for (std::uint32_t i = 0; i < model_.atoms.size(); ++i) {
      const PredicateId predicate(std::size_t{model_.atoms.symbol(i)});
      if (predicate.index() < known_.symbols.predicates() && symbols_.name(predicate) == name &&
          std::ranges::equal(model_.atoms.objects(i), model_.numbers.objects(number)))
        return known_.reached[literal_index({i, false})];
    }
    return true;  // nothing reads it
  }

  bool brings(const std::vector<std::uint32_t>& adds, const Pattern& pattern) const {
    return std::ranges::any_of(adds, [&](std::uint32_t atom) {
      return model_.atoms.symbol(atom) == pattern.predicate.value && pattern.fits(model_.atoms.objects(atom));
    });
  }

  std::string why(const ImpossibleAction& note) const {
    const std::string name = text(known_.actions[note.schema.index()].name, note.arguments);
    if (note.broken) {
      return name + " can never run: its start makes its own condition over all false, " +
             text(pattern_of(*note.broken));
    }
    return name + " can never run: it takes at most " + seconds(note.longest) +
           ", but its start and its end change or read the same, so they are at least ε = " +
           seconds(known_.epsilon) + " apart";
  }

  std::string text(const std::string& name, std::span<const ObjectId> objects) const {
    std::string result = "(" + name;
    for (const ObjectId object : objects) result += " " + (object.is_none() ? "?" : symbols_.name(object));
    return result + ")";
  }

  std::string text(const Pattern& pattern) const {
    const std::string atom = text(symbols_.name(pattern.predicate), pattern.objects);
    return pattern.negated ? "(not " + atom + ")" : atom;
  }

  std::string text(const LiftedAction& action, const Binding& binding) const {
    return text(action.name, std::span(binding).first(action.parameters.size()));
  }

  void tell(const std::string& cause) {
    if (causes_.size() < kMostCauses && std::ranges::find(causes_, cause) == causes_.end())
      causes_.push_back(cause);
  }

  const UnreachableGoal& known_;
  const GroundModel& model_;
  const lifted::StaticModel& static_model_;
  const lifted::Symbols& symbols_;
  std::vector<Wanted> wanted_;
  std::set<Pattern> seen_;
  std::vector<std::string> causes_;
};

std::string literal_text(const UnreachableGoal& known, GroundLiteral literal) {
  std::string text =
      "(" + known.symbols.name(PredicateId(std::size_t{known.model.atoms.symbol(literal.atom)}));
  for (const ObjectId object : known.model.atoms.objects(literal.atom))
    text += " " + known.symbols.name(object);
  text += ")";
  return literal.negated ? "(not " + text + ")" : text;
}

// Names, of the actions that are longer than their windows and would bring about what nothing else does, the
// one that lacks least; the text is empty if there is none.
std::string window_too_short(const UnreachableGoal& known) {
  const WindowMisfit* nearest = nullptr;
  for (const WindowMisfit& note : known.model.window_misfits) {
    const bool missed = std::ranges::any_of(note.adds, [&](std::uint32_t atom) {
      return !known.reached[literal_index({atom, false})];
    });
    const auto lack = [](const WindowMisfit& action) { return action.duration - action.window; };
    if (missed && (!nearest || lack(note) < lack(*nearest))) nearest = &note;
  }
  if (!nearest) return {};
  std::string name = "(" + known.actions[nearest->schema.index()].name;
  for (const ObjectId object : nearest->arguments) name += " " + known.symbols.name(object);
  return "; " + name + ") takes " + seconds(nearest->duration) + ", its longest window is " +
         seconds(nearest->window) + ": " + seconds(nearest->duration - nearest->window) + " too short";
}

}  // namespace

void refuse(const UnreachableGoal& known) {
  std::vector<std::string> facts = known.model.unreachable_goals;
  for (const auto& goal : known.goal) {
    for (const auto literal : goal.literals) {
      if (!known.reached[literal_index(literal)]) facts.push_back(literal_text(known, literal));
    }
  }
  std::string text;
  for (const std::string& fact : facts) text += " " + fact;
  if (facts.empty()) {
    text = " " + pddl::print(known.problem.goal);
    std::vector<const pddl::Condition*> parts;
    collect_parts(known.problem.goal, parts);
    for (const pddl::Condition* part : parts) facts.push_back(pddl::print(*part));
  }
  std::string causes;
  for (const std::string& cause : Diagnosis(known).causes()) causes += cause + "; ";
  const std::string misfit = window_too_short(known);
  std::vector<BlockedFact> blocked;
  for (std::string& fact : facts)
    blocked.push_back({std::move(fact), "no sequence of actions reaches it" + misfit});
  throw PlanningFailure(
      Verdict::unsolvable,
      causes +
          "no sequence of actions reaches, even if nothing were ever deleted and numbers did not count:" +
          text + misfit,
      std::move(blocked));
}

}  // namespace roci::planner::temporal_pddl::grounding
