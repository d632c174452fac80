#include "planner_svc/temporal_pddl/grounding/fact_patterns.hpp"

#include <chrono>

#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding {

using instantiation::GroundLiteral;
using simplification::literal_index;
using task::ObjectId, task::PredicateId;
using temporal::Duration;

Pattern Patterns::of(GroundLiteral literal) const {
  const auto objects = known_.model.atoms.objects(literal.atom);
  return {PredicateId(std::size_t{known_.model.atoms.symbol(literal.atom)}),
          {objects.begin(), objects.end()},
          literal.negated};
}

bool Patterns::within_reach(const Pattern& pattern) const {
  if (pattern.negated) {
    if (!pattern.is_ground()) return true;
    const auto atom = known_.model.atoms.find(pattern.predicate.value, pattern.objects);
    if (known_.static_model.is_static(pattern.predicate))
      return !known_.static_model.holds_initially(pattern.predicate, pattern.objects);
    return !atom || known_.reached[literal_index({*atom, true})];
  }
  const auto& initial = known_.static_model.initial_atoms();
  for (std::uint32_t i = 0; i < initial.size(); ++i) {
    if (initial.symbol(i) == pattern.predicate.value && pattern.fits(initial.objects(i))) return true;
  }
  for (std::uint32_t i = 0; i < known_.model.atoms.size(); ++i) {
    if (known_.model.atoms.symbol(i) == pattern.predicate.value &&
        pattern.fits(known_.model.atoms.objects(i)) && known_.reached[literal_index({i, false})])
      return true;
  }
  return false;
}

bool Patterns::comes_with_time(const Pattern& pattern) const {
  return std::ranges::any_of(known_.static_model.timed_atoms(), [&](const lifted::TimedAtom& timed) {
    return timed.predicate == pattern.predicate && timed.negated == pattern.negated &&
           pattern.fits(timed.objects);
  });
}

bool Patterns::any_fits(const std::vector<std::uint32_t>& atoms, const Pattern& pattern) const {
  return std::ranges::any_of(atoms, [&](std::uint32_t atom) {
    return known_.model.atoms.symbol(atom) == pattern.predicate.value &&
           pattern.fits(known_.model.atoms.objects(atom));
  });
}

std::string Patterns::text(const std::string& name, std::span<const ObjectId> objects) const {
  std::string result = "(" + name;
  for (const ObjectId object : objects)
    result += " " + (object.is_none() ? "?" : known_.symbols.name(object));
  return result + ")";
}

std::string Patterns::text(const Pattern& pattern) const {
  const std::string atom = text(known_.symbols.name(pattern.predicate), pattern.objects);
  return pattern.negated ? "(not " + atom + ")" : atom;
}

std::string in_seconds(Duration duration) {
  const std::string text = std::to_string(std::chrono::duration<double>(duration).count());
  return (text.ends_with("000") ? text.substr(0, text.size() - 3) : text) + " s";
}

}  // namespace roci::planner::temporal_pddl::grounding
